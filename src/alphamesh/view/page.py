"""One HTML file with all in it: no network, opens from disk."""

from __future__ import annotations

import base64
import html
from typing import TYPE_CHECKING

from alphamesh.io._atomic import atomic_path
from alphamesh.view.bundle import bundle, style
from alphamesh.view.payload import payload

if TYPE_CHECKING:
    import os

    from alphamesh.persistence import Persistence
    from alphamesh.radius import RadiusChoice

__all__ = ["page_text", "write_page"]

# The browser itself refuses any request of this page.
_POLICY = (
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
    "img-src data: blob:; base-uri 'none'; form-action 'none'"
)
_PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="generator" content="alphamesh">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<link rel="icon" href="data:,">
<title>{title}</title>
<style>
html, body {{ height: 100%; margin: 0; }}
@media (prefers-color-scheme: dark) {{ html {{ background: #14181f; color: #e6e9ee; }} }}
{style}
</style>
</head>
<body>
<main id="alphamesh-view" aria-busy="true">
<noscript>This page needs JavaScript to show the complex.</noscript>
</main>
<script id="alphamesh-data" type="text/plain">{data}</script>
<script type="module">
{script}
modules["page.js"].main();
</script>
</body>
</html>
"""


def page_text(
    persistence: Persistence,
    choice: RadiusChoice | None,
    *,
    radius: float | None = None,
    title: str | None = None,
) -> str:
    """Return the page as text.

    Parameters and errors are those of :func:`alphamesh.view.payload`.
    """
    packed = payload(persistence, choice, radius=radius, title=title)
    return _PAGE.format(
        policy=_POLICY,
        title=html.escape(title or "Alpha complex"),
        style=style(),
        data=base64.b64encode(packed).decode("ascii"),
        script=bundle("page.js"),
    )


def write_page(
    path: str | os.PathLike[str],
    persistence: Persistence,
    choice: RadiusChoice | None,
    *,
    radius: float | None = None,
    title: str | None = None,
) -> None:
    """Write the page, whole or not at all.

    Parameters
    ----------
    path : path-like
        An existing file is replaced once the new one is complete.
    persistence, choice, radius, title
        See :func:`alphamesh.view.payload`, also for the errors.

    Raises
    ------
    FileWriteError
        If it cannot be written.
    """
    text = page_text(persistence, choice, radius=radius, title=title)
    with atomic_path(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
