"""The complex live under a slider: one HTML page, or a widget in a notebook."""

from alphamesh.view.page import page_text, write_page
from alphamesh.view.payload import payload
from alphamesh.view.widget import make_widget

__all__ = ["make_widget", "page_text", "payload", "write_page"]
