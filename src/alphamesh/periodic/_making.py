"""From points to the filtration of their periodic box."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import read_only
from alphamesh._kernels.periodic import Layer, Star, periodic_complex, periodic_star
from alphamesh._weights import equal_weight, nothing_hidden, shifted_radii
from alphamesh.periodic._box import as_periods, box_cloud
from alphamesh.periodic._filtration import PeriodicFiltration
from alphamesh.points import Cloud, as_cloud, refuse_overflow, warn_of_degrees

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray
    from alphamesh._kernels import Progress
    from alphamesh.periodic._box import BoxCloud, Copies

__all__ = ["periodic_filtration"]

# Of random points few spheres reach further, in mean distances; what fails is done again.
_HALO = 3.0


def periodic_filtration(
    points: Any,
    periods: Any,
    *,
    weights: Any = None,
    threads: int | None = None,
    progress: Progress | None = None,
) -> PeriodicFiltration:
    """Compute the alpha filtration of a periodic box; every decision is exact.

    Parameters
    ----------
    points : array-like of shape (n, 2) or (n, 3)
        See :func:`alphamesh.points.as_cloud`. Points outside of the box stand for their
        copies inside. Points at the same place of the box are merged.
    periods : sequence of float or None
        The side length of the box in each direction, in the units of the points; None where
        it is open.
    weights : array-like of shape (n,), optional
        Squared radii of balls at radius zero; see :func:`alphamesh.filtration`.
    threads : int, optional
        Threads to use; by default one for each usable CPU. The result does not depend
        on it.
    progress : callable, optional
        Called with the fraction that is done, from 0 to 1, about ten times a second.

    Returns
    -------
    PeriodicFiltration

    Raises
    ------
    PeriodsError
        If `periods` are not the sides of a box that has a periodic direction.
    CloudShapeError, NonFiniteError, CoordinateRangeError, CloudTooLargeError
        If there is no exact filtration of such points; the message names the rows.
    WeightsError
        If there is not one finite weight for each point.
    ParameterError
        If `threads` or `progress` is not what it must be.

    Notes
    -----
    A copy of a point lies whole periods away, which float64 cannot hold in general: the
    kernel works with sums of two float64, which hold it exactly. Points are triangulated
    with the copies in a margin around the box. No copy of a vertex v lies in a circumsphere
    through v, so that its centre is at most half a period away from v in each direction:
    a margin of one period always suffices. A narrower one does if no sphere of a cell at a
    point in the box reaches beyond it, as then no further copy lies in one; otherwise all
    is done again, with a wider margin.
    """
    cloud = as_cloud(points, weights=weights)
    warn_of_degrees(cloud)
    d = cloud.points.shape[1]
    sides = as_periods(periods, d)
    if len(cloud) == 0:
        return _empty(cloud, sides)
    # Equal weights change no simplex, and values by a formula.
    weight = 0.0 if cloud.weights is None else equal_weight(cloud.weights)
    box = box_cloud(cloud.points, sides, cloud.weights if weight is None else None)
    copies, star = _certain_star(box, _forward(progress))
    layers, cofaces = periodic_complex(
        copies.rows,
        copies.offsets,
        len(box.rows),
        star.cells,
        box.anchors,
        box.shifts,
        box.weights,
        box.periods,
        box.exponent,
        threads,
    )
    refuse_overflow(layers[-1].rows, layers[-1].radii)
    layers = _padded(layers, d)
    positions = np.ldexp(box.anchors + box.shifts * box.periods, -box.exponent)
    return PeriodicFiltration(
        cloud.points,
        read_only(np.ascontiguousarray(positions[:, :d])),
        sides,
        box.representative,
        tuple(layer.rows for layer in layers),
        tuple(read_only(layer.offsets[:, :, :d]) for layer in layers),
        tuple(shifted_radii(layer.radii, weight or 0.0) for layer in layers),
        tuple(layer.faces for layer in layers),
        cofaces if star.dimension == d else _none(2),
        cloud.crs,
        cloud.weights,
        _hidden(box, layers[0].rows),
    )


def _hidden(box: BoxCloud, vertices: IntArray) -> IntArray:
    """Return the rows that are in no simplex for their weight."""
    if box.weights is None:
        return nothing_hidden()
    seen = np.zeros(len(box.anchors), dtype=bool)
    seen[vertices] = True
    # Those as heavy as the one that stands for them are duplicates, no more.
    twins = box.weights == box.weights[box.representative]
    return read_only(
        np.flatnonzero(~(seen | (twins & seen[box.representative]))).astype(np.int32)
    )


def _forward(progress: Progress | None) -> Progress | None:
    """Return `progress` as of work that may be done again: it never goes back."""
    if not callable(progress):
        return progress  # refused, or none
    told = 0.0

    def forward(share: float) -> object:
        nonlocal told
        told = max(told, share)
        return progress(told)

    return forward


def _certain_star(box: BoxCloud, progress: Progress | None) -> tuple[Copies, Star]:
    """Return all cells at points in the box, of a margin that is wide enough."""
    periods, halo = box.periods, _first_halo(box)
    for _ in range(2):
        copies, star = _star(box, halo, progress)
        if (halo >= periods).all():
            return copies, star
        # In a narrow margin there may be no copy across some border at all.
        unsure = star.open or star.dimension < np.count_nonzero(periods)
        # Beyond what has been rounded in saying who is in the margin.
        reached = np.maximum(-star.lo, star.hi - periods) + np.ldexp(periods, -50)
        if not unsure and ((reached <= halo) | (halo >= periods)).all():
            return copies, star
        # Where points are added, spheres of cells at a point in the box shrink together:
        # these reaches will do.
        wider = np.maximum(halo, reached * (1 + 2.0**-40))
        halo = periods if unsure else np.minimum(wider, periods)
    return _star(box, periods, progress)


def _first_halo(box: BoxCloud) -> FloatArray:
    """Return a margin that is likely to do; one period where nothing else is sure to."""
    rows, periods = box.rows, box.periods
    used = periods > 0
    flat = np.ptp(box.anchors, axis=0) == 0
    if not (used | flat).all():  # cells at an open border are as long as the box
        return periods
    spacing = (np.prod(periods[used]) / len(rows)) ** (1 / used.sum())
    return np.where(used, np.minimum(_HALO * spacing, periods), 0.0)


def _star(box: BoxCloud, halo: FloatArray, progress: Progress | None) -> tuple[Copies, Star]:
    copies = box.copies(halo)
    own = np.zeros(len(box.anchors)) if box.weights is None else box.weights
    weights = own.take(copies.rows)
    star = periodic_star(copies.high, copies.low, weights, box.unit, len(box.rows), progress)
    return copies, star


def _padded(layers: list[Layer], dimension: int) -> list[Layer]:
    """Return layers of all dimensions, empty ones if the cloud has fewer."""
    missing = range(len(layers), dimension + 1)
    return layers + [
        Layer(
            _none(k + 1),
            read_only(np.empty((0, k + 1, 3), dtype=np.int8)),
            _none(k + 1),
            read_only(np.empty(0)),
        )
        for k in missing
    ]


def _none(columns: int) -> IntArray:
    return read_only(np.empty((0, columns), dtype=np.int32))


def _empty(cloud: Cloud, sides: tuple[float | None, ...]) -> PeriodicFiltration:
    d = cloud.points.shape[1]
    layers = _padded([], d)
    return PeriodicFiltration(
        cloud.points,
        cloud.points,
        sides,
        read_only(np.empty(0, dtype=np.int32)),
        tuple(layer.rows for layer in layers),
        tuple(read_only(layer.offsets[:, :, :d]) for layer in layers),
        tuple(layer.radii for layer in layers),
        tuple(layer.faces for layer in layers),
        _none(2),
        cloud.crs,
        cloud.weights,
        nothing_hidden(),
    )
