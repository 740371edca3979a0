"""The invariants of a filtration: every simplex, and the right value for each."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._kernels import dot2
from alphamesh.check._mesh import Mesh, check_edges, check_representative, proved_mesh
from alphamesh.check._periodic import check_periodic
from alphamesh.check._space_filtration import check_filtration3d
from alphamesh.check._tools import LongArray, check_radii, check_table, require, signs
from alphamesh.check._weighted import check_power_values, check_rows, standing_rows
from alphamesh.errors import InvalidResultError
from alphamesh.filtration3d import Filtration3D
from alphamesh.periodic import PeriodicFiltration

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray
    from alphamesh.filtration import AnyFiltration

#: Relative error up to which `check_filtration` accepts a radius.
RADIUS_ERROR = 1e-14

# Above this doubt about the check's own rounding, a triangle is measured in fractions.
_THIN = 2e-13
_ULP = 2.0**-52
_NAMES = ("vertex radii", "edge radii", "triangle radii")


def check_filtration(result: AnyFiltration | PeriodicFiltration) -> None:
    """Prove that `result` holds every simplex of its points with the right value.

    Combinatorial claims (the triangulation, which edges are Gabriel, which values are
    equal) are checked exactly; a radius itself may be off by a factor of
    1 ± :data:`RADIUS_ERROR`, in space 1 ± :data:`RADIUS_ERROR_IN_SPACE`, and for thin
    simplices by the rounding of the check: 2e-13 in the plane, 1e-11 in space. With
    weights, 1 ± :data:`RADIUS_ERROR_WITH_WEIGHTS`, and hidden points are proved hidden.

    Parameters
    ----------
    result : Filtration, Filtration3D or PeriodicFiltration
        The last is proved by :func:`check_periodic`.

    Raises
    ------
    InvalidResultError
        If an invariant fails; the message and ``rows`` name the rows of the array that
        breaks it.
    """
    if isinstance(result, PeriodicFiltration):
        check_periodic(result)
        return
    if isinstance(result, Filtration3D):
        check_filtration3d(result)
        return
    if not len(result.simplices) == len(result.radii) == 3:
        raise InvalidResultError("simplices and radii: not one array for each dimension")
    vertices, edges, triangles = result.simplices
    weighted = result.weights is not None
    standing = result.representative
    if weighted:
        check_rows(result)
        standing = standing_rows(standing, result.hidden)
    else:
        check_representative(result.points, standing)
    mesh = proved_mesh(result.points, standing, triangles, result.weights)
    _check_vertices(vertices, mesh)
    order = check_edges(edges, mesh)
    _check_cofaces(result.edge_triangles, mesh, order)
    for name, simplices, radii in zip(_NAMES, result.simplices, result.radii, strict=True):
        check_radii(radii, len(simplices), name, signed=weighted)
    if weighted:
        check_power_values(result)
        return
    require(result.radii[0] == 0, "vertex radii: not zero")
    _check_triangle_radii(mesh, result.radii[2])
    _check_edge_radii(mesh, edges, result.edge_triangles, *result.radii[1:])


def _check_vertices(vertices: IntArray, mesh: Mesh) -> None:
    check_table(vertices, (len(mesh.vertices), 1), "vertices")
    same = vertices[:, 0] == mesh.vertices
    require(same, "vertices: not the representatives in ascending order")


def _check_cofaces(edge_triangles: IntArray, mesh: Mesh, rows: LongArray) -> None:
    """Check `edge_triangles`; `rows` tells the row of each edge of the mesh."""
    check_table(edge_triangles, (len(rows), 2), "edge_triangles")
    expected = np.full((len(rows), 2), -1, dtype=np.int64)
    if len(mesh.triangles):
        beyond = mesh.partner[mesh.first]
        expected[rows, 0] = mesh.first // 3
        expected[rows, 1] = np.where(beyond < 0, -1, beyond // 3)
    # Either order of two cofaces will do, but a missing one comes last.
    same = (edge_triangles == expected).all(axis=1)
    swapped = (edge_triangles == expected[:, ::-1]).all(axis=1) & (expected[:, 1] >= 0)
    require(same | swapped, "edge_triangles: not the cofaces")


def _check_triangle_radii(mesh: Mesh, radii: FloatArray) -> None:
    """Check radii against the circumradius: in floats where they do, else in fractions."""
    a, b, c = (mesh.points[mesh.triangles[:, k]] for k in range(3))
    u, v, w = b - a, c - a, c - b
    left, right = u[:, 0] * v[:, 1], u[:, 1] * v[:, 0]
    area = np.abs(left - right)  # twice the area
    lengths = [np.hypot(side[:, 0], side[:, 1]) for side in (u, v, w)]
    claimed, slack = _in_mesh_units(radii, mesh)
    with np.errstate(all="ignore"):  # flat triangles, which are looked at again
        # What rounding may have done to the area, and to the rest of the formula.
        doubt = 4 * _ULP * ((np.abs(left) + np.abs(right)) / area) + 8 * _ULP
        expected = lengths[0] * (lengths[1] / area) * lengths[2] / 2
        good = np.abs(claimed - expected) - slack <= (RADIUS_ERROR + doubt) * expected
    for row in np.flatnonzero(~(doubt < _THIN)):
        corners = mesh.points[mesh.triangles[row]].tolist()
        good[row] = _is_circumradius(claimed[row], slack, *corners)
    require(good, "triangle radii: not the circumradius")


def _in_mesh_units(radii: FloatArray, mesh: Mesh) -> tuple[FloatArray, float]:
    """Return radii in the units of ``mesh.points``, and what rounding to subnormals costs."""
    return np.ldexp(radii, -mesh.exponent), float(np.ldexp(1.0, -1074 - mesh.exponent))


def _is_circumradius(radius: float, slack: float, *corners: list[float]) -> bool:
    """Tell exactly whether `radius` is within the allowed error of the circumradius."""
    (ax, ay), (bx, by), (cx, cy) = ((Fraction(x), Fraction(y)) for x, y in corners)
    sides = (
        ((ax - bx) ** 2 + (ay - by) ** 2)
        * ((bx - cx) ** 2 + (by - cy) ** 2)
        * ((cx - ax) ** 2 + (cy - ay) ** 2)
    )
    doubled_area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    square = sides / (4 * doubled_area**2)
    low = max(Fraction(radius) - Fraction(slack), Fraction(0))
    high = Fraction(radius) + Fraction(slack)
    error = Fraction(RADIUS_ERROR)
    return low**2 <= square * (1 + error) ** 2 and square * (1 - error) ** 2 <= high**2


def _check_edge_radii(
    mesh: Mesh, edges: IntArray, edge_triangles: IntArray, radii: FloatArray, above: FloatArray
) -> None:
    """Check radii of edges, given those of the triangles `above` them.

    Gabriel edges have half their length, the others the least of their triangles.
    """
    least = np.full(len(edges), np.inf)
    gabriel = np.ones(len(edges), dtype=bool)
    for column in (0, 1):
        there = np.flatnonzero(edge_triangles[:, column] >= 0)
        coface = edge_triangles[there, column]
        # The vertex that is left of the triangle without the edge, by sums of ids.
        corners, ends = mesh.triangles[coface], edges[there]
        apex = corners.sum(axis=1, dtype=np.int64) - ends.sum(axis=1, dtype=np.int64)
        angle = signs(dot2, mesh.points, np.column_stack((ends, apex)))
        least[there] = np.minimum(least[there], above[coface])
        gabriel[there] &= angle >= 0
        # The same circle; a leg that rounds to more than the edge may add to the triangle.
        own = radii[there]
        same = (angle != 0) | (own == above[coface]) | (above[coface] - own == np.spacing(own))
        require(same, "edge radii: not that of the triangle whose right angle they face", there)
    require(radii <= least, "edge radii: greater than that of a triangle")
    require(
        gabriel | (radii == least), "edge radii: not Gabriel, so the least of the triangles"
    )
    claimed, slack = _in_mesh_units(radii, mesh)
    half = np.hypot(*(mesh.points[edges[:, 0]] - mesh.points[edges[:, 1]]).T) / 2
    good = np.abs(claimed - half) - slack <= RADIUS_ERROR * half
    require(~gabriel | good, "edge radii: Gabriel, so half of the length")
