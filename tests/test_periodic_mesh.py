"""Meshes of periodic boxes: one box, oriented, with what reaches beyond its border."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

import alphamesh as am
from alphamesh.errors import DimensionError
from alphamesh.io.meshes import read_mesh

_CYCLES = ((0, 1, 2), (1, 2, 0), (2, 0, 1))


def boxed(dimension: int, n: int, seed: int = 0) -> am.periodic_complex.PeriodicComplex:
    points = np.random.default_rng(seed).random((n, dimension))
    return am.AlphaComplex(points, periods=(1,) * dimension)


@pytest.mark.parametrize(("dimension", "n"), [(2, 1), (2, 2), (2, 60), (3, 1), (3, 80)])
@pytest.mark.parametrize("radius", [0.0, 0.15, np.inf])
def test_cells_are_positive_and_as_large_as_the_shape(dimension, n, radius):
    shape = boxed(dimension, n).at(radius)
    mesh = shape.mesh()
    kind, size = ("triangle", 2) if dimension == 2 else ("tetra", 6)
    corners = mesh.points[mesh.cells[kind]]
    sizes = np.linalg.det(corners[:, 1:] - corners[:, :1]) / size
    assert (sizes > 0).all()
    assert sizes.sum() == pytest.approx(shape.filled_share)
    assert len(mesh.cells[kind]) == len(shape.numbers(dimension))


def test_points_of_the_mesh_tell_where_they_come_from():
    shape = boxed(3, 80).at(0.2)
    mesh = shape.mesh()
    offsets = np.column_stack([mesh.point_data[f"offset_{axis}"] for axis in "xyz"])
    expected = shape.filtration.positions[mesh.point_data["input_row"]] + offsets
    assert np.array_equal(mesh.points, expected)
    assert len(np.unique(mesh.points, axis=0)) == len(mesh.points)
    assert offsets.any()


def test_what_is_a_face_of_nothing_is_there_beside_the_cells():
    shape = boxed(3, 80).at(0.2)
    mesh, filtration = shape.mesh(), shape.filtration
    for kind, k in (("line", 1), ("triangle", 2)):
        numbers = set(shape.numbers(k).tolist())
        numbers -= set(filtration.faces[k + 1][shape.numbers(k + 1)].ravel().tolist())
        expected = sorted(filtration.radii[k][sorted(numbers)].tolist())
        assert sorted(mesh.cell_data["radius"][kind].tolist()) == expected
        assert len(expected) > 0


def test_far_from_the_border_it_is_the_mesh_of_the_open_cloud():
    rng = np.random.default_rng(1)
    points = 0.5 + 0.3 * rng.normal(size=(300, 3)) / 3
    boxes = am.AlphaComplex(points, periods=(8, 8, 8)).at(0.05)
    opened = am.AlphaComplex(points).at(0.05)
    for surface in (False, True):
        found, expected = boxes.mesh(surface=surface), opened.mesh(surface=surface)
        rows = found.point_data["input_row"]
        for kind in expected.cells:
            ours, theirs = rows[found.cells[kind]], expected.cells[kind]
            assert sorted(map(tuple, _turned(ours))) == sorted(map(tuple, _turned(theirs)))


def _turned(rows: np.ndarray) -> list[list[int]]:
    """Begin triangles with their least row, to compare their sense; sort other cells."""
    if rows.shape[1] != 3:
        return np.sort(rows, axis=1).tolist()
    least = np.argmin(rows, axis=1)[:, None]
    return np.take_along_axis(rows, (least + np.arange(3)) % 3, axis=1).tolist()


def test_the_surface_of_a_box_closes_across_its_border():
    shape = boxed(3, 400, seed=4).at(0.12)
    mesh = shape.mesh(surface=True)
    triangles = mesh.cells["triangle"][: len(shape.boundary_triangles)]
    rows = mesh.point_data["input_row"]
    ends = np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)])
    step = np.rint(np.diff(_offsets(mesh)[ends], axis=1)[:, 0]).astype(int)
    there = np.column_stack([rows[ends], step])
    back = np.column_stack([rows[ends[:, ::-1]], -step])
    assert sorted(there.tolist()) == sorted(back.tolist())
    assert len(there) > 500


def _offsets(mesh: am.Mesh) -> np.ndarray:
    return np.column_stack([mesh.point_data[f"offset_{axis}"] for axis in "xyz"])


def test_slivers_are_oriented_exactly():
    # Nearly in one plane: determinants of float64 tell nothing.
    grid = np.stack(np.meshgrid(*[np.arange(4.0)] * 3), axis=-1).reshape(-1, 3)
    points = grid + np.random.default_rng(2).choice([-1, 0, 1], grid.shape) * 2.0**-50
    shape = am.AlphaComplex(points + 0.5, periods=(4, 4, 4)).at(np.inf)
    mesh = shape.mesh()
    assert len(mesh.cells["tetra"]) == len(shape.tetrahedra)
    # These coordinates are exact in the box, too.
    for cell in mesh.points[mesh.cells["tetra"]].tolist():
        exact = [[Fraction(x) for x in corner] for corner in cell]
        a, b, c = ([x - x0 for x, x0 in zip(v, exact[0], strict=True)] for v in exact[1:])
        turns = (a[i] * (b[j] * c[k] - b[k] * c[j]) for i, j, k in _CYCLES)
        assert sum(turns) > 0


def test_files(tmp_path: Path):
    shape = boxed(3, 60).at(0.25)
    shape.save(tmp_path / "box.npz")
    read = read_mesh(tmp_path / "box.npz")
    assert len(read.cells["tetra"]) == len(shape.tetrahedra)
    assert set(read.point_data) == {"input_row", "offset_x", "offset_y", "offset_z"}
    shape.save(tmp_path / "box.ply")
    assert len(read_mesh(tmp_path / "box.ply").cells["triangle"]) >= len(
        shape.boundary_triangles
    )
    with pytest.raises(DimensionError, match="in space alone"):
        boxed(2, 5).at(0.2).mesh(surface=True)


def test_for_other_libraries():
    pytest.importorskip("meshio")
    shape = boxed(3, 60).at(0.25)
    mesh = shape.to_meshio()
    assert len(mesh.cells_dict["tetra"]) == len(shape.tetrahedra)
    assert mesh.point_data["offset_x"].tolist() == shape.mesh().point_data["offset_x"].tolist()
