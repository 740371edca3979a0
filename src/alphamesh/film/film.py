"""The film of a growing radius: from the cloud to a mesh, and beyond."""

from __future__ import annotations

from dataclasses import dataclass
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.errors import (
    DimensionError,
    FileWriteError,
    MissingLibraryError,
    ParameterError,
)
from alphamesh.film.radii import film_radii
from alphamesh.film.writers import WRITERS, Reel, need_writer
from alphamesh.filtration import Filtration
from alphamesh.filtration3d import Filtration3D
from alphamesh.io._atomic import atomic_path
from alphamesh.persistence import Persistence, persistence

if TYPE_CHECKING:
    import os

    from alphamesh._arrays import CountArray, FloatArray
    from alphamesh._kernels import Progress

__all__ = ["FILM_FORMATS", "Film", "animate"]

FILM_FORMATS = tuple(WRITERS)

_NARROWEST, _WIDEST = 200, 4000


@dataclass(frozen=True, eq=False)
class Film:
    """A film that has been written.

    Attributes
    ----------
    path : pathlib.Path
    radii : (k,) float64
        The radius of each frame.
    betti : (k, 2) int64
        Components and holes in each frame.
    size : (width, height)
        In pixels.
    """

    path: Path
    radii: FloatArray
    betti: CountArray
    size: tuple[int, int]


def animate(  # noqa: PLR0913 (all but two are options)
    source: Any,
    path: str | os.PathLike[str],
    *,
    radii: Any = None,
    frames: int = 100,
    fps: float = 10,
    hold: float = 1.5,
    width: int = 960,
    progress: Progress | None = None,
) -> Film:
    """Make a film of a growing radius: restricted Voronoi cells beside the alpha complex.

    Each frame also tells its radius, how many components and holes there are, and where
    on the Betti curves it stands.

    Parameters
    ----------
    source : AlphaComplex, Filtration or Persistence
    path : path-like
        A ``.gif`` or ``.webp``, written with Pillow, or an ``.mp4``, for which the program
        ffmpeg must be installed. Written whole or not at all.
    radii : {"even", "quantiles", "log"} or sequence of float, optional
        How the radii of the frames are chosen, see :func:`alphamesh.film.film_radii`; or
        the radii themselves.
    frames : int, default 100
        How many, unless `radii` lists them.
    fps : float, default 10
        Frames a second, from 0.1 to 50.
    hold : float, default 1.5
        Seconds that the last frame stays.
    width : int, default 960
        Width in pixels, from 200 to 4000; the height follows the cloud's proportions.
    progress : callable, optional
        Called with the fraction that is done, from 0 to 1, after each frame.

    Returns
    -------
    Film
        Where it is, its radii and Betti numbers.

    Raises
    ------
    ParameterError
        If a parameter is not what it must be.
    FileWriteError
        If the extension is unknown, the file cannot be written, or ffmpeg is missing.
    MissingLibraryError
        If matplotlib or Pillow is not installed.

    Notes
    -----
    Frames are drawn and written one by one: memory does not grow with their number, but
    for the compressed film in the case of WebP.
    """
    target = Path(path)
    suffix = target.suffix.lower()
    if suffix not in WRITERS:
        raise FileWriteError(
            f"a film ends in one of {', '.join(FILM_FORMATS)}; got {str(target)!r}"
        )
    _check_numbers(fps, hold, width)
    need_writer(suffix)
    pairs = _persistence_of(source)
    chosen = film_radii(pairs, radii, frames)
    reel = _reel(pairs, chosen, (fps, hold, width), progress)
    with atomic_path(target) as temporary:
        WRITERS[suffix](reel, temporary)
    return Film(target, chosen, pairs.betti_numbers(chosen), reel.size)


def _reel(
    pairs: Persistence,
    radii: FloatArray,
    look: tuple[float, float, int],
    progress: Progress | None,
) -> Reel:
    """Return what draws the frames, and tells of the progress."""
    try:
        from alphamesh.plot import GrowthView
    except MissingLibraryError:
        raise MissingLibraryError.of("matplotlib", "plot", "Drawing a film") from None
    fps, hold, width = look
    view = GrowthView(pairs, _shown(radii), width=int(width))
    return Reel(
        view.size,
        len(radii),
        float(fps),
        float(hold),
        lambda number: view.picture(float(radii[number])),
        progress,
    )


def _shown(radii: FloatArray) -> tuple[float, float]:
    """Return the range of radii for the Betti curves, both positive."""
    positive = radii[radii > 0]
    if len(positive) == 0:
        return 0.1, 1.0
    low, high = float(np.min(positive)), float(np.max(positive))
    # A first pair of points very close together would stretch the axis for nothing.
    low = max(low, float(np.quantile(positive, 0.05)) / 3)
    return (low, 1.02 * high) if low < high else (high / 10, 1.02 * high)


def _persistence_of(source: Any) -> Persistence:
    given = source if isinstance(source, Filtration | Filtration3D) else None
    filtration = getattr(source, "filtration", given)
    if isinstance(filtration, Filtration3D):
        raise DimensionError("films are made of clouds in the plane alone")
    if not isinstance(filtration, Filtration):
        raise ParameterError(
            "a film needs an AlphaComplex, a Filtration or a Persistence, not "
            f"{type(source).__name__}; make one with alphamesh.AlphaComplex(points)"
        )
    return source if isinstance(source, Persistence) else persistence(filtration)


def _check_numbers(fps: Any, hold: Any, width: Any) -> None:
    for name, value, low, high, unit in (
        ("fps", fps, 0.1, 50, "frames a second"),
        ("hold", hold, 0, 60, "seconds"),
        ("width", width, _NARROWEST, _WIDEST, "pixels"),
    ):
        if not isinstance(value, Real) or not low <= float(value) <= high:
            raise ParameterError(
                f"{name} must be a number of {unit} from {low} to {high}; got {value!r}"
            )
