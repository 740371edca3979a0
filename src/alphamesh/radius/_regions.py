"""The smallest radius that leaves no point out and gives few pieces."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from alphamesh import _kernels
from alphamesh.filtration import Filtration
from alphamesh.radius._all_points import covered_from
from alphamesh.radius._choice import RadiusChoice
from alphamesh.radius._options import whole_number
from alphamesh.radius._registry import radius_rule
from alphamesh.radius._words import CELLS, flat_text

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray
    from alphamesh.filtration import AnyFiltration

__all__ = ["region_events"]


@radius_rule("one-region", balls="any")
def _one_region(filtration: AnyFiltration) -> RadiusChoice:
    """Choose the smallest radius at which all points are in one piece."""
    return _few_regions(filtration, 1, "one-region")


@radius_rule("regions", balls="any")
def _regions(filtration: AnyFiltration, *, regions: int = 1) -> RadiusChoice:
    """Choose the smallest radius at which all points are in at most `regions` pieces."""
    return _few_regions(filtration, whole_number("regions", regions, 1), "regions")


def _few_regions(filtration: AnyFiltration, most: int, rule: str) -> RadiusChoice:
    if filtration.dimension == 0:
        there = float(filtration.radii[0].max())
        when = "at any radius" if filtration.weights is None else "from here on"
        return RadiusChoice(there, rule, f"All points are at one place: one piece {when}.")
    begins, ends = region_events(filtration)
    covered = float(covered_from(filtration).max())
    # The number of pieces changes only where one begins or two meet.
    radii = np.unique(np.append(ends, covered))
    radii = radii[radii >= covered]
    count = np.searchsorted(begins, radii, side="right") - np.searchsorted(
        ends, radii, side="right"
    )
    first = int(np.argmax(count <= most))
    pieces = "one piece" if most == 1 else f"at most {most:,} pieces"
    dimension, columns = filtration.dimension, filtration.points.shape[1]
    found = f" ({count[first]:,} here)" if count[first] != 1 and most > 1 else ""
    reason = (
        f"{flat_text('The points', dimension, columns)}This is the smallest radius at which no "
        f"point is left out and the {CELLS[dimension][1]} form {pieces}{found}."
    )
    return RadiusChoice(float(radii[first]), rule, reason)


def region_events(filtration: AnyFiltration) -> tuple[FloatArray, FloatArray]:
    """Return the radii at which pieces begin and at which two of them meet, each ascending.

    Pieces are sets of cells connected across facets; on a line, of points.
    """
    dimension = filtration.dimension
    if dimension == 1:
        return np.sort(filtration.radii[0]), np.sort(filtration.radii[1])
    radii = filtration.radii[dimension]
    cofaces = _cofaces(filtration)
    inner = cofaces.compress(cofaces[:, 1] >= 0, axis=0)
    joined_from = radii.take(inner).max(axis=1)
    # The pieces meet along a shortest spanning tree of the cells: what the core finds for
    # the components of any graph.
    meets, _ = _kernels.persistence2(
        np.zeros((len(radii), 2)),
        np.empty((0, 3), dtype=np.int32),
        radii[:0],
        inner,
        joined_from,
        np.full(inner.shape, -1, dtype=np.int32),
    )
    return np.sort(radii), np.sort(joined_from.take(meets[:, 1]))


def _cofaces(filtration: AnyFiltration) -> IntArray:
    """Return the one or two cells that each facet belongs to, ``(m, 2)`` int32; -1 for none."""
    if isinstance(filtration, Filtration):
        return filtration.edge_triangles
    if filtration.dimension == 3:
        return filtration.triangle_tetrahedra
    # In a plane in space, an edge comes up in its first triangle, then in its second one.
    edges = filtration.triangle_edges.ravel()
    order = np.argsort(edges, kind="stable")
    edges, triangles = edges.take(order), (order // 3).astype(np.int32)
    again = np.append(False, edges[1:] == edges[:-1])
    cofaces = np.full((len(filtration.simplices[1]), 2), -1, dtype=np.int32)
    cofaces[edges, again.view(np.int8)] = triangles
    return cofaces
