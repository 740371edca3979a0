"""The vertices of PLY files."""

from __future__ import annotations

import struct
import tracemalloc

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from alphamesh.errors import FileReadError
from alphamesh.io.points import read_points

TWO = np.array([[1.0, 2.0], [3.0, 4.0]])

clouds = hnp.arrays(
    np.float64,
    st.tuples(st.integers(0, 30), st.just(2)),
    elements=st.floats(allow_nan=True, allow_infinity=True),
)


def ply(form: str, *elements: str, body: bytes = b"") -> bytes:
    """Return a PLY file; an element is its declaration and those of its properties."""
    lines = ["ply", f"format {form} 1.0", "comment made by a test", *elements, "end_header", ""]
    return "\n".join(lines).encode() + body


XYZ = "property float x\nproperty float y\nproperty float z"


def vertices(count: int, properties: str = XYZ) -> str:
    return f"element vertex {count}\n{properties}"


@pytest.fixture
def fault(tmp_path):
    """Return a function that tells the error message of bytes in a file."""

    def message(data: bytes, name: str, **options) -> str:
        (tmp_path / name).write_bytes(data)
        with pytest.raises(FileReadError) as caught:
            read_points(tmp_path / name, **options)
        assert name in str(caught.value)
        return str(caught.value)

    return message


@pytest.fixture
def read(tmp_path):
    def write_and_read(data: bytes, name: str, **options) -> list:
        (tmp_path / name).write_bytes(data)
        return read_points(tmp_path / name, **options).tolist()

    return write_and_read


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(clouds, st.sampled_from(["ascii", "binary_little_endian", "binary_big_endian"]))
def test_ply_round_trip(tmp_path, points, form):
    properties = "property double x\nproperty uchar red\nproperty double y"
    if form == "ascii":
        body = "".join(f"{x!r} 255 {y!r}\n" for x, y in points.tolist()).encode()
    else:
        pack = struct.Struct("<dBd" if "little" in form else ">dBd").pack
        body = b"".join(pack(x, 255, y) for x, y in points.tolist())
    path = tmp_path / "a.ply"
    path.write_bytes(ply(form, vertices(len(points), properties), body=body))
    assert np.array_equal(read_points(path), points, equal_nan=True)


FACES = "element face 1\nproperty list uchar int vertex_indices"


def test_ply_with_faces(read):
    body = b"1 2 9\n3 4 9\n3 0 1 0\n"
    assert read(ply("ascii", vertices(2), FACES, body=body), "a.ply") == TWO.tolist()
    body = struct.pack("<6f", 1, 2, 9, 3, 4, 9) + struct.pack("<B3i", 3, 0, 1, 0)
    data = ply("binary_little_endian", vertices(2), FACES, body=body)
    assert read(data, "a.ply") == TWO.tolist()
    assert read(data, "a.ply", dimension=3) == [[1, 2, 9], [3, 4, 9]]
    assert read(data, "a.ply", columns=("z", "x")) == [[9, 1], [9, 3]]
    assert read(data.replace(b"\n", b"\r\n", 9), "a.ply") == TWO.tolist()


def test_ply_of_a_solid_is_in_space(read):
    body = b"1 2 9\n3 4 8\n"
    assert read(ply("ascii", vertices(2), body=body), "a.ply") == [[1, 2, 9], [3, 4, 8]]
    assert read(ply("ascii", vertices(2), body=body), "a.ply", dimension=2) == TWO.tolist()


def test_ply_with_elements_before_the_vertices(read):
    first = "element camera 2\nproperty short a\nproperty int b"
    body = b"1 2\n3 4\n1 2 9\n3 4 9\n"
    assert read(ply("ascii", first, vertices(2), body=body), "a.ply") == TWO.tolist()
    body = bytes(12) + struct.pack(">6f", 1, 2, 9, 3, 4, 9)
    data = ply("binary_big_endian", first, vertices(2), body=body)
    assert read(data, "a.ply") == TWO.tolist()


def test_ply_with_lists_at_the_vertices(read, fault):
    properties = XYZ + "\nproperty list uchar int near"
    body = b"1 2 9 0\n3 4 9 2 5 6\n"
    assert read(ply("ascii", vertices(2, properties), body=body), "a.ply") == TWO.tolist()
    data = ply("binary_little_endian", vertices(2, properties), body=bytes(99))
    assert "has lists of varying length in its 'vertex' elements" in fault(data, "a.ply")
    properties = "property list uchar int near\nproperty float x\nproperty float y"
    data = ply("ascii", vertices(1, properties), body=b"0 1 2\n")
    assert "has 0 columns, and 2 are needed" in fault(data, "a.ply")


def test_ply_written_by_meshio(tmp_path):
    meshio = pytest.importorskip("meshio")
    corners = np.random.default_rng(0).random((4, 3))
    mesh = meshio.Mesh(corners, [("triangle", np.array([[0, 1, 2], [0, 2, 3]]))])
    for binary in (False, True):
        meshio.ply.write(tmp_path / "a.ply", mesh, binary=binary)
        assert np.array_equal(read_points(tmp_path / "a.ply", dimension=3), corners)


ASCII = ply("ascii", vertices(2), body=b"1 2 9\n3 4 9\n")
BINARY = ply("binary_little_endian", vertices(2), body=bytes(24))
HUGE = 10**12


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (ASCII[:-8], "is cut off or damaged: its header promises 2 vertices, and 4 bytes"),
        (
            ply("ascii", vertices(3), FACES, body=b"1 2 9\n3 4 9\n\n       \n"),
            "is cut off: its header promises 3 vertices and 2 follow",
        ),
        (BINARY[:-1], "is cut off or damaged: its header promises 2 vertices, and 23 bytes"),
        (ply("ascii", vertices(HUGE)), f"promises {HUGE} vertices, and 0 bytes follow"),
        (ply("binary_big_endian", vertices(HUGE)), f"promises {HUGE} vertices, and 0 bytes"),
        (
            ply("binary_big_endian", f"element a {HUGE}\nproperty int b", vertices(1)),
            "promises 1 vertices, and 0 bytes follow",
        ),
        (ply("ascii", f"element a {HUGE}", vertices(1), body=b"1 2 3\n"), "and 0 follow"),
        (b"x,y\n1,2\n", "is not a PLY file: its first line is not 'ply'"),
        (b"ply\nformat ascii 1.0\n" + vertices(1).encode(), "has no line 'end_header'"),
        (b"ply\n" + b"comment\n" * 2**18, "has no line 'end_header'"),
        (b"ply\nend_header\n", "the line 'format' is missing before line 2 of its header"),
        (ply("ascii", FACES), "has no element 'vertex' (its elements: 'face')"),
        (ply("ascii"), "has no element 'vertex' (its elements: none)"),
        (ply("ascii 2.0"), "unknown declaration 'format ascii 2.0 1.0' in line 2"),
        (ply("ascii", vertices(1, "property quad x")), "unknown declaration 'property quad x'"),
        (ply("ascii", "property float x"), "unknown declaration 'property float x' in line 4"),
        (ply("ascii", "element vertex -5"), "unknown declaration 'element vertex -5'"),
        (ply("ascii", vertices(0, "property int a")), "has the column 'a', and 2 are needed"),
        (
            ply("ascii", vertices(2), body=b"1 2 9\n3 up 9\n"),
            "has text in the place of a number in line 10 (line 10, column 'y': 'up')",
        ),
        (ply("ascii", vertices(2), body=b"1\n2 2 9 9 9\n"), "has too few columns in line 9"),
    ],
)
def test_ply_faults(fault, data, message):
    tracemalloc.start()
    try:
        assert message in fault(data, "a.ply")
        assert tracemalloc.get_traced_memory()[1] < 50e6
    finally:
        tracemalloc.stop()
