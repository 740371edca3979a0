"""The film of a growing radius: from the cloud to a mesh, and beyond."""

from __future__ import annotations

from dataclasses import dataclass
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.errors import (
    FileWriteError,
    MissingLibraryError,
    ParameterError,
)
from alphamesh.film.radii import film_radii
from alphamesh.film.writers import WRITERS, Reel, need_writer
from alphamesh.filtration import Filtration
from alphamesh.filtration3d import Filtration3D
from alphamesh.io._atomic import atomic_path
from alphamesh.periodic import PeriodicFiltration, PeriodicPersistence, periodic_persistence
from alphamesh.persistence import Persistence, persistence

if TYPE_CHECKING:
    import os

    from alphamesh._arrays import CountArray, FloatArray
    from alphamesh._kernels import Progress
    from alphamesh.plot.growth import FilmView

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
    betti : (k, 2), (k, 3) or (k, 4) int64
        Components and holes in each frame; in space components, loops and voids; in a
        periodic box, besides, 1 where all of it is filled.
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
    turn: float | None = None,
    progress: Progress | None = None,
) -> Film:
    """Make a film of a growing radius.

    In the plane it shows restricted Voronoi cells beside the alpha complex, in space the
    complex, slowly turning, beside the same cut open; of a periodic box what is in it and,
    in the plane, around it. Each frame also tells its radius,
    how many components and holes there are, and where on the Betti curves it stands.

    Parameters
    ----------
    source : AlphaComplex, PeriodicComplex, or a filtration or persistence
        In the plane or in space.
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
    turn : float, optional
        Degrees that the camera turns around the z-axis in the course of the film, 60 by
        default; for clouds in space alone.
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
    degrees = _checked_turn(turn, pairs.filtration)
    chosen = film_radii(pairs, radii, frames)
    view = _view(pairs, chosen, int(width), degrees)
    last = max(len(chosen) - 1, 1)
    reel = Reel(
        view.size,
        len(chosen),
        float(fps),
        float(hold),
        lambda number: view.picture(float(chosen[number]), number / last),
        progress,
    )
    with atomic_path(target) as temporary:
        WRITERS[suffix](reel, temporary)
    return Film(target, chosen, pairs.betti_numbers(chosen), reel.size)


def _view(pairs: Persistence, radii: FloatArray, width: int, turn: float) -> FilmView:
    """Return what draws the frames."""
    try:
        from alphamesh.plot import GrowthView, GrowthView3D, GrowthViewBox, GrowthViewBox3D
    except MissingLibraryError:
        raise MissingLibraryError.of("matplotlib", "plot", "Drawing a film") from None
    shown = _shown(pairs, radii)
    space = pairs.filtration.points.shape[1] == 3
    if isinstance(pairs, PeriodicPersistence):
        if space:
            return GrowthViewBox3D(pairs, shown, width=width, turn=turn)
        return GrowthViewBox(pairs, shown, width=width)
    if space:
        return GrowthView3D(pairs, shown, width=width, turn=turn)
    return GrowthView(pairs, shown, width=width)


def _shown(pairs: Persistence, radii: FloatArray) -> tuple[float, float]:
    """Return the range of radii for the Betti curves: without weights, both positive."""
    if pairs.filtration.weights is not None:
        low, high = float(np.min(radii)), float(np.max(radii))
        around = 0.02 * (high - low) or 1.0
        return low - around, high + around
    positive = radii[radii > 0]
    if len(positive) == 0:
        return 0.1, 1.0
    low, high = float(np.min(positive)), float(np.max(positive))
    # A first pair of points very close together would stretch the axis for nothing.
    low = max(low, float(np.quantile(positive, 0.05)) / 3)
    return (low, 1.02 * high) if low < high else (high / 10, 1.02 * high)


def _persistence_of(source: Any) -> Persistence:
    kinds = Filtration | Filtration3D | PeriodicFiltration
    given = source if isinstance(source, kinds) else None
    filtration = getattr(source, "filtration", given)
    if not isinstance(filtration, kinds):
        raise ParameterError(
            "a film needs an AlphaComplex, a Filtration or a Persistence, not "
            f"{type(source).__name__}; make one with alphamesh.AlphaComplex(points)"
        )
    if isinstance(source, Persistence):
        return source
    if isinstance(filtration, PeriodicFiltration):
        return periodic_persistence(filtration)
    return persistence(filtration)


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


def _checked_turn(turn: Any, filtration: Any) -> float:
    if turn is None:
        return 60.0
    if filtration.points.shape[1] != 3:
        raise ParameterError("only films of clouds in space turn; leave turn out")
    if not isinstance(turn, Real) or not abs(float(turn)) <= 3600:
        raise ParameterError(f"turn must be degrees from -3600 to 3600; got {turn!r}")
    return float(turn)
