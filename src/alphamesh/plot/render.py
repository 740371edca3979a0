"""A figure as the bytes of a file: whoever writes them decides where and how safely."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

from alphamesh.errors import ParameterError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["FIGURE_FORMATS", "figure_bytes"]

# For each format, what must be left out for equal figures to give equal bytes.
_DATES: dict[str, dict[str, Any]] = {
    "png": {"Software": None},
    "pdf": {"CreationDate": None},
    "svg": {"Date": None},
}

FIGURE_FORMATS = tuple(_DATES)


def figure_bytes(figure: Figure, format: str = "png", *, dpi: float | None = None) -> bytes:  # noqa: A002
    """Return `figure` as the content of a file; equal figures give equal bytes.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    format : {"png", "pdf", "svg"}
    dpi : float, optional
        Pixels per inch; the figure's own if None. In PDF and SVG, of the parts
        that hold too many simplices to be drawn as lines.

    Raises
    ------
    ParameterError
        If `format` is not one of the above.
    """
    import matplotlib as mpl

    if format not in _DATES:
        raise ParameterError(
            f"no figure format {format!r}; choose one of: {', '.join(FIGURE_FORMATS)}"
        )
    target = io.BytesIO()
    with mpl.rc_context({"svg.hashsalt": "alphamesh", "savefig.bbox": None}):
        figure.savefig(
            target,
            format=format,
            dpi=figure.dpi if dpi is None else dpi,
            metadata=_DATES[format],
        )
    return target.getvalue()
