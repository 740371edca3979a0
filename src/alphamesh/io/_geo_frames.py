"""Tables of geometries, made ready for files."""

from __future__ import annotations

from typing import Any

__all__ = ["with_named_index"]


def with_named_index(frame: Any) -> Any:
    """Return a table with its index as columns, if it has names."""
    if any(name is not None for name in frame.index.names):
        return frame.reset_index()
    return frame
