"""Meshes, and that files give back what was put into them."""

from __future__ import annotations

import dataclasses
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given

from alphamesh.errors import (
    LossyFormatWarning,
    ParameterError,
)
from alphamesh.io._mesh import CELL_CORNERS
from alphamesh.io.meshes import MESH_FORMATS, Mesh, compact, read_mesh, write_mesh
from mesh_samples import (
    EXTENSIONS,
    FULL,
    KEPT,
    POINTS,
    SQUARE,
    TRIANGLES,
    in_space,
    meshes,
    names,
    same,
    written,
)


class TestMesh:
    def test_arrays_are_closed_to_writing_and_not_copied(self) -> None:
        points, triangles = np.zeros((3, 2)), np.array([[0, 1, 2]], dtype=np.int32)
        mesh = Mesh(points, {"triangle": triangles})
        assert np.shares_memory(mesh.points, points)
        assert np.shares_memory(mesh.cells["triangle"], triangles)
        assert not mesh.points.flags.writeable
        assert not mesh.cells["triangle"].flags.writeable
        assert points.flags.writeable

    def test_single_vertices_may_be_a_plain_list(self) -> None:
        assert np.array_equal(SQUARE.cells["vertex"], [[6]])

    def test_it_shows_what_it_holds(self) -> None:
        assert repr(SQUARE) == "Mesh(8 points; cells: 1 vertex, 1 line, 2 triangle)"
        assert repr(Mesh(POINTS)) == "Mesh(8 points; cells: none)"

    @pytest.mark.parametrize(
        ("change", "message"),
        [
            ({"points": np.zeros(8)}, r"\(n, 2\) or \(n, 3\) array .*; got shape \(8,\)"),
            ({"points": np.zeros((8, 4))}, r"got shape \(8, 4\)"),
            ({"points": np.zeros((8, 2), complex)}, "got shape .* of complex128"),
            ({"points": np.full((8, 2), np.nan)}, r"finite: rows 0, 1, .* \(8 in all\)"),
            ({"cells": {"quad": [[0, 1, 2, 3]]}}, "no cells are called 'quad'"),
            ({"cells": {"triangle": [[0, 1]]}}, r"an \(m, 3\) array .* shape \(1, 2\)"),
            ({"cells": {"triangle": [[0.0, 1.0, 2.0]]}}, "row numbers; got .* of float64"),
            ({"cells": {"line": [[0, 1], [1, 8]]}}, r"row 1 name points outside of 0 \.\.\. 7"),
            ({"cells": {"line": [[-1, 1]]}}, "count the points from 0"),
            ({"point_data": {"height": [1.0]}}, r"data\['height'\] must be 8 real numbers"),
            ({"point_data": {"name": ["a"] * 8}}, "must be 8 real numbers"),
            ({"point_data": {"a b<c": np.zeros(8)}}, "rename it to 'a_b_c'"),
            ({"cell_data": {"radius": {"line": [0.7]}}}, "line, triangle; got them for line"),
            ({"cell_data": {"radius": {"tetra": []}}}, "must have numbers for"),
            (
                {"cell_data": {"radius": {"vertex": [0], "line": [0], "triangle": [0]}}},
                r"cell_data\['radius'\]\['triangle'\] must be 2 real numbers",
            ),
        ],
    )  # fmt: skip
    def test_mistakes_are_named(self, change: dict[str, Any], message: str) -> None:
        with pytest.raises(ParameterError, match=message):
            dataclasses.replace(SQUARE, **change)


class TestCompact:
    def test_points_without_a_cell_go(self) -> None:
        small = compact(SQUARE)
        assert np.array_equal(small.point_data["input_row"], KEPT)
        assert same(small.points, POINTS[KEPT])
        assert np.array_equal(small.cells["triangle"], [[0, 1, 2], [0, 2, 3]])
        assert np.array_equal(small.cells["line"], [[1, 4]])
        assert np.array_equal(small.cells["vertex"], [[5]])
        assert np.array_equal(small.point_data["label"], [7, 5, 4, 3, 2, 1])

    def test_rows_that_are_given_are_kept(self) -> None:
        rows = np.arange(100, 108)
        small = compact(dataclasses.replace(SQUARE, point_data={"input_row": rows}))
        assert np.array_equal(small.point_data["input_row"], rows[KEPT])

    @given(meshes())
    def test_nothing_changes_but_the_numbers_of_points(self, mesh: Mesh) -> None:
        small = compact(mesh)
        rows = small.point_data["input_row"]
        assert (np.diff(rows) > 0).all()
        assert same(small.points, mesh.points[rows])
        assert np.array_equal(small.point_data["label"], mesh.point_data["label"][rows])
        for kind, cells in mesh.cells.items():
            assert np.array_equal(rows[small.cells[kind]], cells)
        used = np.concatenate([cells.ravel() for cells in mesh.cells.values()])
        assert np.array_equal(rows, np.unique(used))
        again = compact(small)
        assert same(again.points, small.points)
        assert np.array_equal(again.point_data["input_row"], rows)


class TestRoundTrip:
    @pytest.mark.parametrize("extension", FULL)
    @given(mesh=meshes(least=1))
    def test_formats_that_hold_all(
        self, extension: str, mesh: Mesh, tmp_path_factory: pytest.TempPathFactory
    ) -> None:
        path = tmp_path_factory.mktemp("mesh") / f"mesh{extension}"
        write_mesh(mesh, path)
        expected, found = compact(mesh), read_mesh(path)
        points = expected.points if extension == ".npz" else in_space(expected.points)
        assert same(found.points, points)
        assert list(found.cells) == list(CELL_CORNERS)
        for kind, rows in expected.cells.items():
            assert np.array_equal(found.cells[kind], rows)
            assert same(found.cell_data["radius"][kind], expected.cell_data["radius"][kind])
        assert set(found.point_data) == {"input_row", "label"}
        for name, values in expected.point_data.items():
            assert np.array_equal(found.point_data[name], values)

    @pytest.mark.parametrize("extension", [".ply", ".obj", ".off"])
    @given(mesh=meshes(kinds=("vertex", "triangle"), least=1))
    def test_triangles_by_meshio(
        self, extension: str, mesh: Mesh, tmp_path_factory: pytest.TempPathFactory
    ) -> None:
        path = tmp_path_factory.mktemp("mesh") / f"mesh{extension}"
        write_mesh(mesh, path)
        expected, found = compact(mesh), read_mesh(path)
        assert same(found.points, in_space(expected.points))
        assert np.array_equal(found.cells["triangle"], expected.cells["triangle"])
        if extension == ".ply":
            for name, values in expected.point_data.items():
                assert np.array_equal(found.point_data[name], values)

    @pytest.mark.parametrize("extension", FULL)
    def test_numbers_keep_their_values(self, tmp_path: Path, extension: str) -> None:
        data = {
            "truth": np.arange(8) % 3 == 0,
            "byte": np.arange(8, dtype=np.uint8),
            "short": np.arange(-4, 4, dtype=np.int16),
            "count": np.arange(8, dtype=np.uint32) + 2**31,
            "large": np.arange(8) + 2**52,
            "half": np.arange(8, dtype=np.float16) / 4,
            "single": np.arange(8, dtype=np.float32) / 3,
            "missing": np.array([np.nan, np.inf, -np.inf, -0.0, 5e-324, 1e308, 1 / 3, 2.0]),
        }
        mesh = dataclasses.replace(SQUARE, point_data=data)
        found = read_mesh(written(mesh, tmp_path / f"mesh{extension}"))
        for name, values in data.items():
            assert same(found.point_data[name], values[KEPT]), name

    @pytest.mark.parametrize("extension", EXTENSIONS)
    def test_the_same_mesh_gives_the_same_bytes(self, tmp_path: Path, extension: str) -> None:
        first = written(SQUARE, tmp_path / f"first{extension}").read_bytes()
        assert first == written(SQUARE, tmp_path / f"second{extension}").read_bytes()

    @pytest.mark.parametrize("extension", [".npz", ".ply", ".off", ".obj", ".vtu", ".msh"])
    def test_all_points_on_request(self, tmp_path: Path, extension: str) -> None:
        found = read_mesh(written(TRIANGLES, tmp_path / f"mesh{extension}", keep_all=True))
        assert same(found.points[:, :2], POINTS)
        assert np.array_equal(found.cells["triangle"], TRIANGLES.cells["triangle"])
        if MESH_FORMATS[extension].point_data:
            assert np.array_equal(found.point_data["input_row"], np.arange(8))

    def test_large_text_is_written_in_parts(self, tmp_path: Path) -> None:
        points = np.random.default_rng(0).random((70_000, 3))
        triangles = np.arange(69_999).reshape(-1, 3)
        mesh = Mesh(points, {"triangle": triangles})
        found = read_mesh(written(mesh, tmp_path / "mesh.off", keep_all=True))
        assert same(found.points, points)
        assert np.array_equal(found.cells["triangle"], triangles)


class TestLosses:
    @pytest.mark.parametrize(
        ("extension", "message"),
        [
            (".stl", "STL files cannot hold 1 isolated vertex and 1 singular edge, left out"),
            (".off", "OFF files cannot hold 1 singular edge, left out"),
        ],
    )
    def test_cells_that_are_left_out_are_told(
        self, tmp_path: Path, extension: str, message: str
    ) -> None:
        with pytest.warns(LossyFormatWarning) as caught:
            write_mesh(SQUARE, tmp_path / f"mesh{extension}")
        assert len(caught) == 1
        assert message in str(caught[0].message)
        assert ".vtu, .vtk, .msh, .npz, .ply, .obj" in str(caught[0].message)
        assert caught[0].filename == __file__
        assert len(read_mesh(tmp_path / f"mesh{extension}").cells["triangle"]) == 2

    def test_points_of_what_is_left_out_go_too(self, tmp_path: Path) -> None:
        path = written(SQUARE, tmp_path / "mesh.off")
        assert same(read_mesh(path).points, in_space(POINTS[[0, 2, 3, 4, 6]]))

    @pytest.mark.parametrize("extension", [".ply", ".obj", ".off", ".stl"])
    def test_tetrahedra_too(self, tmp_path: Path, extension: str) -> None:
        solid = Mesh(np.eye(4, 3), {"tetra": [[0, 1, 2, 3]] * 2, "triangle": [[0, 1, 2]]})
        with pytest.warns(
            LossyFormatWarning, match=r"2 tetrahedra, .* \.vtu, \.vtk, \.msh, \.npz$"
        ):
            write_mesh(solid, tmp_path / f"mesh{extension}")

    def test_a_warning_that_is_an_error_comes_before_the_file(self, tmp_path: Path) -> None:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with pytest.raises(LossyFormatWarning):
                write_mesh(SQUARE, tmp_path / "mesh.stl")
        assert names(tmp_path) == []

    @pytest.mark.parametrize("extension", EXTENSIONS)
    def test_the_table_tells_the_truth(self, tmp_path: Path, extension: str) -> None:
        chosen = MESH_FORMATS[extension]
        held = SQUARE.only(chosen.cells)
        write_mesh(held, tmp_path / f"mesh{extension}")  # without a warning
        content = (tmp_path / f"mesh{extension}").read_bytes()
        assert chosen.point_data == (b"input_row" in content)
        assert chosen.cell_data == (b"radius" in content)
        assert set(chosen.cells) <= set(CELL_CORNERS)


class TestEmpty:
    """Nothing to write is written validly; headers are read here, as meshio fails on them."""

    @pytest.mark.parametrize(
        "mesh", [Mesh(POINTS), Mesh(POINTS[:0]), Mesh(POINTS, {"line": []})]
    )
    @pytest.mark.parametrize("extension", EXTENSIONS)
    @pytest.mark.parametrize("keep_all", [False, True])
    def test_a_mesh_without_cells(
        self, tmp_path: Path, extension: str, mesh: Mesh, keep_all: bool
    ) -> None:
        path = tmp_path / f"mesh{extension}"
        write_mesh(mesh, path, keep_all=keep_all)
        count = len(mesh.points) if keep_all else 0
        content = path.read_bytes()
        signs = {
            ".vtu": f'NumberOfPoints="{count}" NumberOfCells="0"',
            ".vtk": f"POINTS {count} double",
            ".ply": f"element vertex {count}\n",
            ".off": f"OFF\n{count} 0 0\n",
        }
        assert signs.get(extension, "").encode() in content
        if extension == ".vtu":
            assert all(word in content for word in (b"connectivity", b"offsets", b"types"))
        elif extension == ".vtk":
            assert b"CELLS 1 0\n" in content
        elif extension == ".obj":
            assert content.count(b"v ") == count
        elif extension == ".stl":
            assert len(content) == 84
        elif extension == ".npz":
            assert len(read_mesh(path).points) == count
        elif extension == ".msh":
            assert np.frombuffer(content.split(b"$Nodes\n")[1][:16], np.uint64)[1] == count

    def test_points_alone(self, tmp_path: Path) -> None:
        cloud = Mesh(POINTS, {"vertex": np.arange(8)})
        for extension in (*FULL, ".ply", ".off", ".obj"):
            write_mesh(cloud, tmp_path / f"cloud{extension}")
            assert same(read_mesh(tmp_path / f"cloud{extension}").points[:, :2], POINTS)
