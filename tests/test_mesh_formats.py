"""Mesh files as their descriptions have them, taken apart without a library."""

from __future__ import annotations

import dataclasses
import re
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest
from hypothesis import given

from alphamesh.errors import (
    FileWriteError,
    LossyFormatWarning,
)
from alphamesh.io.meshes import Mesh, read_mesh, write_mesh
from mesh_samples import (
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


class TestText:
    """OBJ and OFF, read as their descriptions say, without meshio."""

    def test_obj(self, tmp_path: Path) -> None:
        path = tmp_path / "mesh.obj"
        write_mesh(SQUARE, path)
        lines = path.read_bytes().decode("ascii").splitlines()
        vertices = [line.split()[1:] for line in lines if line.startswith("v ")]
        assert same([[float(x) for x in row] for row in vertices], in_space(POINTS[KEPT]))
        assert lines[6:] == ["p 6", "l 2 5", "f 1 2 3", "f 1 3 4"]

    def test_off(self, tmp_path: Path) -> None:
        path = tmp_path / "mesh.off"
        write_mesh(SQUARE.only(("vertex", "triangle")), path)
        lines = path.read_bytes().decode("ascii").splitlines()
        kept = [0, 2, 3, 4, 6]
        assert lines[:2] == ["OFF", "5 2 0"]
        assert same(
            [[float(x) for x in row.split()] for row in lines[2:7]], in_space(POINTS[kept])
        )
        assert lines[7:] == ["3 0 1 2", "3 0 2 3"]

    @given(mesh=meshes(kinds=("triangle",), least=1))
    def test_every_float_survives(
        self, mesh: Mesh, tmp_path_factory: pytest.TempPathFactory
    ) -> None:
        path = tmp_path_factory.mktemp("mesh") / "mesh.obj"
        write_mesh(mesh, path, keep_all=True)
        rows = [line.split() for line in path.read_text().splitlines()]
        found = [[float(x) for x in row[1:]] for row in rows if row[0] == "v"]
        assert same(found, in_space(mesh.points))


class TestPly:
    """PLY, taken apart by its own header, without meshio."""

    NUMBERS: ClassVar = {"uchar": "u1", "int": "<i4", "float": "<f4", "double": "<f8"}

    def parse(self, path: Path) -> dict[str, np.ndarray]:
        header, body = path.read_bytes().split(b"end_header\n", 1)
        lines = header.decode("ascii").splitlines()
        assert lines[:2] == ["ply", "format binary_little_endian 1.0"]
        tables: dict[str, tuple[int, list[Any]]] = {}
        for word, *rest in (line.split() for line in lines[2:]):
            if word == "element":
                tables[rest[0]] = (int(rest[1]), [])
            elif word == "property" and rest[0] == "list":
                assert rest[1:] == ["uchar", "int", "vertex_indices"]
                tables["face"][1].extend([("count", "u1"), ("vertex_indices", "<i4", 3)])
            elif word == "property":
                [*tables.values()][-1][1].append((rest[1], self.NUMBERS[rest[0]]))
        found = {}
        for name, (count, fields) in tables.items():
            size = count * np.dtype(fields).itemsize
            found[name] = np.frombuffer(body[:size], dtype=fields)
            body = body[size:]
        assert body == b""
        return found

    def test_vertices_faces_and_edges(self, tmp_path: Path) -> None:
        path = tmp_path / "mesh.ply"
        write_mesh(SQUARE, path)
        found = self.parse(path)
        assert list(found) == ["vertex", "face", "edge"]
        vertices = found["vertex"]
        assert same(np.column_stack([vertices[axis] for axis in "xyz"]), in_space(POINTS[KEPT]))
        assert np.array_equal(vertices["input_row"], KEPT)
        assert same(vertices["height"], SQUARE.point_data["height"][KEPT])
        assert found["face"]["count"].tolist() == [3, 3]
        assert found["face"]["vertex_indices"].tolist() == [[0, 1, 2], [0, 2, 3]]
        assert found["edge"].tolist() == [(1, 4)]

    def test_edges_only_where_there_are_some(self, tmp_path: Path) -> None:
        write_mesh(TRIANGLES, tmp_path / "mesh.ply")
        assert list(self.parse(tmp_path / "mesh.ply")) == ["vertex", "face"]

    def test_integers_beyond_32_bits_become_floats(self, tmp_path: Path) -> None:
        data = {
            "large": np.arange(8) + 2**40,
            "bytes": np.arange(8, dtype="u1"),
            "ok": POINTS[:, 0] > 0,
        }
        write_mesh(Mesh(POINTS, TRIANGLES.cells, data), tmp_path / "mesh.ply")
        vertices = self.parse(tmp_path / "mesh.ply")["vertex"]
        assert vertices.dtype["large"] == np.float64
        for name, values in data.items():
            assert np.array_equal(vertices[name], values[[0, 2, 3, 4]])

    def test_names_of_coordinates_are_taken(self, tmp_path: Path) -> None:
        mesh = Mesh(POINTS, TRIANGLES.cells, {"z": np.zeros(8)})
        with pytest.raises(FileWriteError, match=r"mesh\.ply': .*rename point_data\['z'\]"):
            write_mesh(mesh, tmp_path / "mesh.ply")
        assert names(tmp_path) == []


class TestStl:
    FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("extra", "<u2")])

    def parse(self, path: Path) -> np.ndarray:
        content = path.read_bytes()
        assert not content.lower().startswith(b"solid")
        (count,) = np.frombuffer(content[80:84], "<u4")
        assert len(content) == 84 + 50 * count
        return np.frombuffer(content[84:], self.FACET)

    def test_flat_facets_point_up(self, tmp_path: Path) -> None:
        write_mesh(TRIANGLES, tmp_path / "mesh.stl")
        facets = self.parse(tmp_path / "mesh.stl")
        expected = in_space(POINTS)[TRIANGLES.cells["triangle"]].astype(np.float32)
        assert np.array_equal(facets["corners"], expected)
        assert facets["normal"].tolist() == [[0, 0, 1], [0, 0, 1]]
        assert not facets["extra"].any()

    @pytest.mark.parametrize("scale", [1.0, 1e-30, 1e30])
    def test_normals_follow_the_right_hand(self, tmp_path: Path, scale: float) -> None:
        points = np.array([[0, 0, 0], [1, 0, 0], [0, 2, 0], [0, 0, 3.0]]) * scale
        faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3], [0, 0, 1]]
        with pytest.warns(LossyFormatWarning, match="1 triangles collapse"):
            write_mesh(Mesh(points, {"triangle": faces}), tmp_path / "mesh.stl")
        normals = self.parse(tmp_path / "mesh.stl")["normal"]
        diagonal = np.array([6, 3, 2]) / 7
        assert np.allclose(normals, [[0, 0, -1], [0, -1, 0], [-1, 0, 0], diagonal, [0, 0, 0]])

    def test_triangles_that_collapse_in_32_bits_are_told(self, tmp_path: Path) -> None:
        far = Mesh([[5e8, 0], [5e8 + 1, 0], [5e8, 1]], {"triangle": [[0, 1, 2]]})
        with pytest.warns(LossyFormatWarning, match="1 triangles collapse.*towards the origin"):
            write_mesh(far, tmp_path / "mesh.stl")
        write_mesh(far, tmp_path / "mesh.ply")
        assert same(read_mesh(tmp_path / "mesh.ply").points, in_space(far.points))

    def test_numbers_beyond_32_bits_are_refused(self, tmp_path: Path) -> None:
        huge = Mesh([[1e39, 0], [0, 0], [0, 1]], {"triangle": [[0, 2, 1]]})
        with pytest.raises(FileWriteError, match=r"mesh\.stl': .*too large.*or choose \.ply"):
            write_mesh(huge, tmp_path / "mesh.stl")
        assert names(tmp_path) == []


class TestOthersReaders:
    """What ParaView and Gmsh refuse, though meshio reads it back."""

    def test_vtk_has_the_types_of_numbers_that_paraview_knows(self, tmp_path: Path) -> None:
        kinds = ("?", "i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f2", "f4", "f8")
        data = {f"as_{np.dtype(kind).name}": np.arange(8).astype(kind) for kind in kinds}
        path = written(dataclasses.replace(SQUARE, point_data=data), tmp_path / "mesh.vtk")
        content = path.read_bytes()
        assert content.startswith(b"# vtk DataFile Version 5.1\n")
        found = re.findall(rb"\n(as_\w+|input_row|radius) 1 \d+ (\w+)\n", content)
        assert len(found) == len(kinds) + 2
        assert {kind for _, kind in found} == {
            b"float", b"double", b"vtktypeint64", b"vtktypeuint64",
        }  # fmt: skip

    def test_msh_declares_the_entity_of_every_block(self, tmp_path: Path) -> None:
        content = written(SQUARE, tmp_path / "mesh.msh").read_bytes()
        assert content.startswith(b"$MeshFormat\n4.1 1 8\n\1\0\0\0\n$EndMeshFormat\n")
        assert b'$PhysicalNames\n3\n0 1 "vertices"\n1 1 "edges"\n2 1 "triangles"\n' in content

        def section(name: bytes) -> bytes:
            return content.split(b"$" + name + b"\n")[1].split(b"\n$End" + name)[0]

        point = [("tag", "i4"), ("box", "f8", 3), ("groups", "u8"), ("group", "i4")]
        other = [*point[:1], ("box", "f8", 6), *point[2:], ("bounding", "u8")]
        counts = np.dtype(("u8", 4))
        entities = np.frombuffer(
            section(b"Entities"),
            [("counts", counts), ("point", point), ("curve", other), ("surface", other)],
        )[0]
        assert entities["counts"].tolist() == [1, 1, 1, 0]
        space = in_space(POINTS[KEPT])
        assert same(entities["surface"]["box"], [*space.min(axis=0), *space.max(axis=0)])
        for name in ("point", "curve", "surface"):
            assert (entities[name]["tag"], entities[name]["group"]) == (1, 1)

        block = [("dim", "i4"), ("tag", "i4"), ("kind", "i4"), ("count", "u8")]
        elements = np.frombuffer(
            section(b"Elements"),
            [("counts", counts), ("v", block), ("vertex", "u8", (1, 2)),
             ("l", block), ("line", "u8", (1, 3)), ("t", block), ("triangle", "u8", (2, 4))],
        )[0]  # fmt: skip
        assert elements["counts"].tolist() == [3, 4, 1, 4]
        assert elements["v"].tolist() == (0, 1, 15, 1)
        assert elements["l"].tolist() == (1, 1, 1, 1)
        assert elements["t"].tolist() == (2, 1, 2, 2)
        assert elements["vertex"].tolist() == [[1, 6]]
        assert elements["line"].tolist() == [[2, 2, 5]]
        assert elements["triangle"].tolist() == [[3, 1, 2, 3], [4, 1, 3, 4]]

        nodes = np.frombuffer(
            section(b"Nodes"),
            [("counts", counts), ("dim", "i4"), ("tag", "i4"), ("parametric", "i4"),
             ("count", "u8"), ("tags", "u8", 6), ("points", "f8", (6, 3))],
        )[0]  # fmt: skip
        assert nodes["counts"].tolist() == [1, 6, 1, 6]
        assert (nodes["dim"], nodes["tag"], nodes["count"]) == (2, 1, 6)
        assert nodes["tags"].tolist() == [1, 2, 3, 4, 5, 6]
        assert same(nodes["points"], space)
