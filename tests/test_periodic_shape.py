"""What a periodic complex holds at one radius, and what it says of what it has not."""

from __future__ import annotations

import numpy as np
import pytest

import alphamesh as am
from alphamesh.errors import DimensionError, ParameterError, PeriodicError


def test_counts_and_measures_of_one_square():
    made = am.AlphaComplex([[0.5, 0.5]], periods=(1, 1))
    points = made.at(0.4)
    assert points.counts == {"vertices": 1, "edges": 0, "triangles": 0}
    assert points.isolated_vertices.tolist() == [0]
    assert (points.area, points.perimeter, points.filled_share) == (0, 0, 0)
    cross = made.at(0.6)
    assert cross.counts == {"vertices": 1, "edges": 2, "triangles": 0}
    assert cross.betti == (1, 2, 0)
    assert cross.euler == -1
    assert len(cross.isolated_vertices) == 0
    whole = made.at(1)
    assert whole.betti == (1, 2, 1)
    assert (whole.area, whole.perimeter, whole.filled_share) == (1, 0, 1)


def test_measures_are_those_of_a_tiling():
    points = np.random.default_rng(1).random((150, 2))
    made = am.AlphaComplex(points, periods=(1, 1))
    larger = made.tiled((3, 2))
    for radius in (0.02, 0.05, 0.06, 0.08):
        one, six = made.at(radius), larger.at(radius)
        assert six.area == pytest.approx(6 * one.area, rel=1e-12)
        assert six.perimeter == pytest.approx(6 * one.perimeter, rel=1e-12)
        assert six.euler == 6 * one.euler
        assert six.filled_share == pytest.approx(one.filled_share, rel=1e-12)


def test_measures_of_a_slab_in_space():
    points = np.random.default_rng(2).random((300, 3))
    made = am.AlphaComplex(points, periods=(1, 1, None))
    shape = made.at(0.1)
    assert 0 < shape.volume < 1
    # By the triangles of each tetrahedron that no other has.
    triangles = made.filtration.tetrahedron_triangles[shape.numbers(3)]
    counts = np.bincount(triangles.ravel(), minlength=len(made.simplices[2]))
    assert shape.boundary_triangles.tolist() == np.flatnonzero(counts == 1).tolist()
    assert shape.surface_area == pytest.approx(
        made.filtration.facet_sizes[counts == 1].sum(), rel=1e-12
    )
    assert shape.filled_share == 0


def test_corners_are_in_one_piece_across_the_border():
    made = am.AlphaComplex(np.random.default_rng(3).random((50, 3)), periods=(1, 1, 1))
    shape = made.at(0.3)
    for k in (1, 2, 3):
        corners = shape.corners(k)
        assert corners.shape == (len(shape.numbers(k)), k + 1, 3)
        lengths = np.linalg.norm(corners[:, 1:] - corners[:, :1], axis=2)
        assert lengths.max() <= 0.6 + 1e-12
        rows = made.simplices[k][shape.numbers(k)]
        assert np.array_equal(corners[:, 0], made.positions[rows[:, 0]])
        assert np.array_equal(
            corners, made.positions[rows] + shape.offsets(k) * np.array(made.periods)
        )
    assert np.array_equal(shape.tetrahedra, made.simplices[3][shape.numbers(3)])
    assert np.array_equal(shape.vertices, made.simplices[0])


def test_what_has_no_meaning_says_so():
    flat = am.AlphaComplex([[0.1, 0.2]], periods=(1, 1))
    solid = am.AlphaComplex([[0.1, 0.2, 0.3]], periods=(1, 1, 1))
    for name in ("delaunay", "convex_hull", "voronoi", "restricted_voronoi", "measure_curves"):
        with pytest.raises(PeriodicError, match=f"no '{name}'"):
            getattr(flat, name)
        assert not hasattr(solid, name)
    for name in ("polygons", "regions", "contains", "to_trimesh"):
        with pytest.raises(PeriodicError, match="corners"):
            getattr(flat.at(1), name)
    with pytest.raises(AttributeError, match="nonsense"):
        flat.nonsense  # noqa: B018
    with pytest.raises(AttributeError, match="nonsense"):
        flat.at(1).nonsense  # noqa: B018
    for shape, names in (
        (flat.at(1), ("volume", "surface_area", "tetrahedra", "boundary_triangles")),
        (solid.at(1), ("area", "perimeter", "boundary_edges")),
    ):
        for name in names:
            with pytest.raises(DimensionError, match="see"):
                getattr(shape, name)
    with pytest.raises(DimensionError):
        flat.filtration.tetrahedron_triangles  # noqa: B018
    with pytest.raises(ParameterError):
        flat.at(-1)


def test_arrays_leave_as_they_are(tmp_path):
    made = am.AlphaComplex(np.random.default_rng(4).random((30, 3)), periods=(1, None, 2.5))
    arrays = made.to_numpy()
    assert arrays["periods"].tolist() == [1, np.inf, 2.5]
    for k, name in enumerate(("edge", "triangle", "tetrahedron"), 1):
        assert arrays[f"{name}_offsets"].shape == (len(made.simplices[k]), k + 1, 3)
        assert arrays[f"{name}_radii"] is made.radii[k]
    made.save_npz(tmp_path / "box.npz")
    with np.load(tmp_path / "box.npz") as saved:
        assert set(saved.files) == set(arrays)
        for name, array in arrays.items():
            assert np.array_equal(saved[name], array)
    critical = made.critical_radii()
    assert critical[0] == 0
    assert set(critical.tolist()) == {r for part in made.radii for r in part.tolist()}
