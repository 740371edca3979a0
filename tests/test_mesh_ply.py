"""PLY files with edges, which only alphamesh's own reader takes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from alphamesh.errors import FileReadError
from alphamesh.io.meshes import read_mesh, write_mesh
from mesh_samples import SQUARE

ASCII = """ply
format ascii 1.0
comment by hand
element vertex 4
property float x
property float y
property double z
property uchar red
element face 1
property list uchar int vertex_indices
element edge 2
property int vertex1
property int vertex2
end_header
0 0 0 1
1 0 0 2
0 1 0.1 3
5 5 -2 255
3 0 1 2
2 3
0 3
"""


def test_edges_and_numbers_come_back(tmp_path):
    path = tmp_path / "m.ply"
    write_mesh(SQUARE, path, keep_all=True)
    mesh = read_mesh(path)
    np.testing.assert_array_equal(mesh.points[:, :2], SQUARE.points)
    np.testing.assert_array_equal(mesh.cells["line"], SQUARE.cells["line"])
    np.testing.assert_array_equal(mesh.cells["triangle"], SQUARE.cells["triangle"])
    np.testing.assert_array_equal(mesh.point_data["height"], SQUARE.point_data["height"])
    np.testing.assert_array_equal(mesh.point_data["label"], SQUARE.point_data["label"])
    again = tmp_path / "again.ply"
    write_mesh(mesh, again, keep_all=True)
    assert again.read_bytes() == path.read_bytes()


def test_text_is_read_too(tmp_path):
    path = tmp_path / "m.ply"
    path.write_text(ASCII)
    mesh = read_mesh(path)
    assert mesh.points.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0.1], [5, 5, -2]]
    assert mesh.cells["triangle"].tolist() == [[0, 1, 2]]
    assert mesh.cells["line"].tolist() == [[2, 3], [0, 3]]
    assert mesh.point_data["red"].tolist() == [1, 2, 3, 255]


def test_the_other_order_of_bytes(tmp_path):
    head = ASCII.partition("end_header\n")[0].replace("ascii", "binary_big_endian")
    vertex = np.dtype([("p", ">f4", 2), ("z", ">f8"), ("red", "u1")])
    vertices = np.array(
        [((0, 0), 0, 1), ((1, 0), 0, 2), ((0, 1), 0.1, 3), ((5, 5), -2, 4)], vertex
    )
    face = np.array([(3, (0, 1, 2))], np.dtype([("n", "u1"), ("rows", ">i4", 3)]))
    edges = np.array([[2, 3], [0, 3]], ">i4")
    body = vertices.tobytes() + face.tobytes() + edges.tobytes()
    path = tmp_path / "m.ply"
    path.write_bytes(head.encode() + b"end_header\n" + body)
    mesh = read_mesh(path)
    assert mesh.points.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0.1], [5, 5, -2]]
    assert mesh.cells["line"].tolist() == [[2, 3], [0, 3]]
    path.write_bytes(path.read_bytes()[:-3])
    with pytest.raises(FileReadError, match=r"cut off.*2 of 'edge'"):
        read_mesh(path)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("\n0 3\n", "\n", "cut off"),
        ("3 0 1 2", "4 0 1 2", "no triangles"),
        ("2 3\n0 3", "2 3\n0 4", "outside"),
        ("property uchar red", "property rainbow red", "damaged"),
        ("format ascii 1.0", "format odd 1.0", "line 'format'"),
        ("5 5 -2", "5 five -2", "damaged"),
    ],
)
def test_damaged_files_are_refused(tmp_path, old, new, said):
    path = Path(tmp_path / "m.ply")
    assert old in ASCII
    path.write_text(ASCII.replace(old, new))
    with pytest.raises(FileReadError, match=said):
        read_mesh(path)


@pytest.mark.timeout(30)
def test_a_header_without_end_is_refused(tmp_path):
    """Found by fuzzing: meshio looks for the end for ever."""
    path = tmp_path / "cut.ply"
    path.write_bytes(b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n")
    with pytest.raises(FileReadError, match="no line 'end_header'"):
        read_mesh(path)
