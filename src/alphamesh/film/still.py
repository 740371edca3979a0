"""A figure as a small PNG: 255 colours are plenty, and a third of the bytes."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

import numpy as np

from alphamesh.errors import MissingLibraryError
from alphamesh.film.gif import Palette
from alphamesh.plot import figure_bytes

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["small_png"]


def small_png(figure: Figure, *, dpi: float | None = None) -> bytes:
    """Return `figure` as a PNG of at most 255 colours.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
    dpi : float, optional
        Pixels per inch; the figure's own if None.

    Raises
    ------
    MissingLibraryError
        If Pillow is not installed.
    """
    try:
        from PIL import Image
    except ImportError as missing:
        raise MissingLibraryError.of("Pillow", "plot", "Making a small picture") from missing
    with Image.open(io.BytesIO(figure_bytes(figure, "png", dpi=dpi))) as drawn:
        pixels = np.asarray(drawn.convert("RGB"))
    palette = Palette([pixels])
    image = Image.fromarray(palette.indices(pixels)).convert("P")
    image.putpalette(palette.colors.ravel().tolist())
    target = io.BytesIO()
    image.save(target, format="png", optimize=True)
    return target.getvalue()
