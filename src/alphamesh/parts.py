"""Connected parts of a set of cells and of the rest: regions, what they enclose, outside."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh.errors import ParameterError
from alphamesh.measures import scaled_points

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, FloatArray, IntArray
    from alphamesh.filtration import AnyFiltration

__all__ = [
    "Parts",
    "as_cell_mask",
    "centroids",
    "chosen_regions",
    "labelled",
    "large_regions",
    "ranked_parts",
    "ranks",
    "require_size",
    "totals",
]

_FIRST_ENCLOSED = -2

# Cells worked on at a time: bounds the extra memory.
_CHUNK = 1 << 18


@dataclass(frozen=True, eq=False, repr=False)
class Parts(Record):
    """The plane or space, divided by a set of cells into regions, holes and the outside.

    Cells are triangles, in space tetrahedra; sizes are areas, in space volumes.

    Attributes
    ----------
    filtration : Filtration or Filtration3D
    labels : (T,) int32
        Of each cell of the filtration: the number of its region, the largest first; -1
        outside, where a way leads to infinity; ``-2 - h`` in the enclosed part h.
    """

    filtration: AnyFiltration
    labels: IntArray

    @cached_property
    def region_sizes(self) -> FloatArray:
        """Of each region, ``(r,)`` float64, descending."""
        return read_only(_sums(self.labels, self.filtration.cell_sizes))

    @cached_property
    def enclosed_sizes(self) -> FloatArray:
        """Of each enclosed part, ``(h,)`` float64, in no particular order."""
        return read_only(_sums(self.enclosed, self.filtration.cell_sizes))

    @cached_property
    def enclosed(self) -> IntArray:
        """Number of the enclosed part that each cell lies in, below zero for none, int32."""
        return read_only(np.maximum(_FIRST_ENCLOSED - self.labels, -1))


def ranked_parts(filtration: AnyFiltration, found: IntArray) -> Parts:
    """Return parts from the numbers that the core gave; regions get new ones by size."""
    parts = Parts(filtration, found)
    if found.max(initial=-1) <= 0:
        return parts
    # Those below zero stay.
    by_size = ranks(parts.region_sizes)
    known = found >= 0
    labels = found.copy()
    labels[known] = by_size.take(found.compress(known))
    return Parts(filtration, read_only(labels))


def ranks(sizes: FloatArray) -> IntArray:
    """Return the place of each size in descending order; equal ones keep their order."""
    places = np.empty(len(sizes), dtype=np.int32)
    places[np.argsort(-sizes, kind="stable")] = np.arange(len(sizes))
    return places


def _sums(labels: IntArray, values: FloatArray) -> FloatArray:
    """Return the sum of the values of each label; those below zero do not count."""
    used = labels >= 0
    return totals(labels.compress(used), values.compress(used), 0)


def totals(labels: IntArray, values: FloatArray, count: int) -> FloatArray:
    """Return the sum of the values of each label, of which there are `count` or more."""
    with np.errstate(over="ignore"):
        return np.asarray(np.bincount(labels, values, count), dtype=np.float64)


def centroids(
    points: FloatArray,
    cells: IntArray,
    labels: IntArray,
    sizes: FloatArray,
    measure: Callable[[FloatArray, IntArray], FloatArray],
) -> FloatArray:
    """Return the centre of area or volume of each region, ``(r, d)`` float64.

    Parameters
    ----------
    points : (n, d) float64
    cells : (k, d + 1) int32
    labels : (k,) int32
        The region of each cell; none is missing.
    sizes : (k,) float64
    measure : callable
        What computes the sizes of cells: again, where they lie beyond float64.
    """
    count = int(labels.max(initial=-1)) + 1
    points, exponent = scaled_points(points)
    weights = sizes if exponent == 0 else measure(points, cells)
    if not np.isfinite(weights).all():
        shrink = int(np.frexp(np.abs(points).max(initial=0.0))[1])
        points, exponent = np.ldexp(points, -shrink), exponent + shrink
        weights = measure(points, cells)
    total = totals(labels, weights, count)
    flat = total == 0  # too thin for float64: any inner point is as good
    if flat.any():
        weights = np.where(flat.take(labels), 1.0, weights)
        total = totals(labels, weights, count)
    # Seen from a corner of the region, little cancels far from the origin.
    origin = np.empty(count, dtype=np.int32)
    origin[labels] = cells[:, 0]
    centres = points.take(origin, axis=0)
    offsets = np.zeros(centres.shape)
    for begin in range(0, len(cells), _CHUNK):
        part = slice(begin, begin + _CHUNK)
        chosen = labels[part]
        shares = weights[part] / (total.take(chosen) * cells.shape[1])
        for axis, column in enumerate(points.T):
            away = column.take(cells[part]) - centres[:, axis].take(chosen)[:, np.newaxis]
            offsets[:, axis] += totals(chosen, shares * away.sum(axis=1), count)
    centres += offsets
    return read_only(np.ldexp(centres, exponent))


# ---------------------------------------------------------------------- choosing


def labelled(labels: IntArray, kept: BoolArray) -> BoolArray:
    """Return which cells have a label that is kept; those below zero never are."""
    # Row -1 reads the last entry.
    return read_only(np.append(kept, False).take(np.maximum(labels, -1), mode="wrap"))


def large_regions(sizes: FloatArray, name: str, least: float, most: int | None) -> BoolArray:
    """Return the regions of at least the size `least`, at most so many, ``(r,)`` bool.

    Parameters
    ----------
    sizes : (r,) float64
        Descending.
    name : str
        Of the parameter `least`.
    least : float
    most : int or None

    Raises
    ------
    ParameterError
        If `least` is negative or NaN, or `most` not a whole number of 0 or more.
    """
    require_size(name, least)
    given: Any = most
    if given is not None and (
        not isinstance(given, int | np.integer) or isinstance(given, bool) or given < 0
    ):
        raise ParameterError(
            f"keep_largest must be a whole number of 0 or more, or None; got {most!r}"
        )
    large = sizes >= least
    if most is not None:
        large[most:] = False
    return large


def require_size(name: str, size: float) -> None:
    """Raise ParameterError if a size is negative or NaN."""
    if not size >= 0:
        units = "cubed" if "volume" in name else "squared"
        raise ParameterError(
            f"{name} must be 0 or more, in {units} units of the points; got {size!r}"
        )


def chosen_regions(regions: Any, count: int) -> BoolArray:
    """Return which of `count` regions are meant by numbers or truth values, ``(count,)`` bool.

    Raises
    ------
    ParameterError
        If there are no such regions.
    """
    chosen = np.asarray(regions)
    if chosen.dtype == bool and chosen.shape == (count,):
        return chosen
    if chosen.size == 0 or (
        chosen.dtype.kind in "iu" and 0 <= chosen.min() <= chosen.max() < count
    ):
        kept = np.zeros(count, dtype=bool)
        kept[chosen.astype(np.intp)] = True
        return kept
    raise ParameterError(
        f"regions must be numbers from 0 to {count - 1}, or {count} truth values; "
        f"got {regions!r}"
    )


def as_cell_mask(name: str, given: Any, count: int) -> BoolArray:
    """Return truth values of cells, read-only and nobody else's.

    Raises
    ------
    ParameterError
        If there is not one for each cell.
    """
    mask = np.asarray(given)
    if mask.dtype != bool or mask.shape != (count,):
        cells = name.removeprefix("has_")
        raise ParameterError(
            f"{name} must be {count:,} truth values, one for each {cells} of the filtration; "
            f"got {mask.dtype} of shape {mask.shape}"
        )
    return read_only(mask.copy()) if mask.flags.writeable else mask
