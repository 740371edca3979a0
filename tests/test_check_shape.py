"""The validator of shapes names whatever part of a shape is changed."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np
import pytest

from alphamesh.check import check_shape
from alphamesh.errors import InvalidResultError
from alphamesh.filtration import filtration
from alphamesh.shape import AlphaShape


def edited(array, index, value):
    copy = array.copy()
    copy[index] = value
    return copy


@dataclass
class Loose:
    """An alpha shape whose parts can be changed."""

    filtration: object
    radius: float
    points: np.ndarray
    triangles: np.ndarray
    edges: np.ndarray
    singular_edges: np.ndarray
    regular_edges: np.ndarray
    interior_edges: np.ndarray
    boundary_edges: np.ndarray
    isolated_vertices: np.ndarray
    singular_vertices: np.ndarray
    regular_vertices: np.ndarray
    interior_vertices: np.ndarray
    counts: dict
    area: float
    perimeter: float


def loose(radius):
    points = np.concatenate((np.random.default_rng(1).uniform(size=(200, 2)), [[5.0, 5.0]]))
    shape = AlphaShape(filtration(points), radius)
    return Loose(**{field.name: getattr(shape, field.name) for field in fields(Loose)})


ARRAYS = [field.name for field in fields(Loose) if field.name.endswith(("s", "es"))]
ARRAYS = [name for name in ARRAYS if name not in ("radius", "points", "counts")]


def test_a_loose_shape_passes():
    shape = loose(0.06)
    check_shape(shape)
    assert min(len(getattr(shape, name)) for name in ARRAYS) > 0


@pytest.mark.parametrize("name", ARRAYS)
def test_any_other_row_is_found(name):
    array = getattr(loose(0.06), name)
    breaks = [array[1:], array.astype(np.int64), edited(array, 0, array[-1] + 1)]
    if len(array) > 1:
        breaks.append(array[::-1])
    for broken in breaks:
        with pytest.raises(InvalidResultError, match=name.replace("_", " ")):
            check_shape(replace(loose(0.06), **{name: broken}))


def test_another_radius_is_found():
    for radius in (0.0, 0.059, 0.061, np.inf):
        with pytest.raises(InvalidResultError, match="up to the radius"):
            check_shape(replace(loose(0.06), radius=radius))


def test_clockwise_triangles_are_found():
    shape = loose(0.06)
    broken = edited(shape.triangles, 3, shape.triangles[3, [0, 2, 1]])
    with pytest.raises(InvalidResultError, match=r"not counter-clockwise \(row 3\)"):
        check_shape(replace(shape, triangles=broken))


def test_a_boundary_turned_round_is_found():
    shape = loose(0.06)
    broken = edited(shape.boundary_edges, 2, shape.boundary_edges[2, ::-1])
    with pytest.raises(InvalidResultError, match=r"not on their left \(row 2\)"):
        check_shape(replace(shape, boundary_edges=broken))


def test_a_filtration_that_is_none_is_found():
    """A triangle that comes before its edge leaves the complex open."""
    shape = loose(0.06)
    result = shape.filtration
    edge = np.flatnonzero(np.isin(result.radii[1], result.radii[2]) & (result.radii[1] < 0.05))[
        0
    ]
    late = edited(result.radii[1], edge, 1.0)
    late_edge = AlphaShape(
        replace(result, radii=(result.radii[0], late, result.radii[2])), 0.06
    )
    with pytest.raises(InvalidResultError, match="an edge of them is not in the complex"):
        check_shape(late_edge)


def test_wrong_measures_and_counts():
    shape = loose(0.06)
    for name in ("area", "perimeter"):
        for factor in (1 + 1e-9, 0.0, -1.0, np.nan):
            with pytest.raises(InvalidResultError, match=name):
                check_shape(replace(shape, **{name: getattr(shape, name) * factor}))
    for name, count in shape.counts.items():
        with pytest.raises(InvalidResultError, match=f"counts: .*{name}"):
            check_shape(replace(shape, counts={**shape.counts, name: count + 1}))
