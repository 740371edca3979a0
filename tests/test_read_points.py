"""Points from NPY, NPZ and Parquet files, and from paths that hold none."""

from __future__ import annotations

import io
import os
import struct
import subprocess
import sys
import threading
import zipfile
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from alphamesh.errors import FileReadError, MissingLibraryError, ParameterError
from alphamesh.io.points import POINT_FORMATS, read_points

TWO = np.array([[1.0, 2.0], [3.0, 4.0]])
ANY_FOLDER = settings(suppress_health_check=[HealthCheck.function_scoped_fixture])

clouds = hnp.arrays(
    np.float64,
    st.tuples(st.integers(0, 30), st.just(2)),
    elements=st.floats(allow_nan=True, allow_infinity=True),
)


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


def npy(array: np.ndarray) -> bytes:
    buffer = io.BytesIO()
    np.save(buffer, array)
    return buffer.getvalue()


def npz(**arrays: np.ndarray) -> bytes:
    buffer = io.BytesIO()
    np.savez_compressed(buffer, **arrays)
    return buffer.getvalue()


def parquet(**columns) -> bytes:
    buffer = io.BytesIO()
    pq.write_table(pa.table(columns), buffer)
    return buffer.getvalue()


# Round trips


@ANY_FOLDER
@given(clouds, st.sampled_from(["C", "F"]), st.sampled_from(["<f8", ">f8"]))
def test_npy_and_npz_round_trip(tmp_path, points, order, dtype):
    stored = np.asarray(points, dtype=dtype, order=order)
    np.save(tmp_path / "a.npy", stored)
    np.savez(tmp_path / "a.npz", points=stored, other=[1])
    np.savez_compressed(tmp_path / "b.npz", anything=stored)
    for name in ("a.npy", "a.npz", "b.npz"):
        again = read_points(tmp_path / name)
        assert again.dtype == np.dtype("=f8")
        assert again.flags.c_contiguous
        assert again.flags.owndata or again.base.flags.owndata
        assert np.array_equal(again, points, equal_nan=True)


@ANY_FOLDER
@given(clouds)
def test_parquet_round_trip(tmp_path, points):
    table = pa.table({"id": range(len(points)), "y": points[:, 1], "x": points[:, 0]})
    pq.write_table(table, tmp_path / "a.parquet")
    assert np.array_equal(read_points(tmp_path / "a.parquet"), points, equal_nan=True)


@pytest.mark.parametrize("dtype", ["i1", "u1", "i4", "u8", "i8", "f2", "f4", "g"])
def test_npy_of_any_number_type(read, dtype):
    assert read(npy(TWO.astype(dtype)), "a.npy") == TWO.tolist()


def test_npy_of_signalling_nans(read):
    """Found by fuzzing: NumPy warns when it widens them."""
    bits = np.array([[0x7FA00000, 0], [0, 0x3F800000]], dtype=np.uint32)
    points = np.array(read(npy(bits.view(np.float32)), "a.npy"))
    assert np.array_equal(points, [[np.nan, 0], [0, 1]], equal_nan=True)


# NPY and NPZ


def test_npy_of_python_2(read):
    content = npy(TWO).replace(f"({len(TWO)}, 2)".encode(), f"({len(TWO)}L, 2L)".encode())
    content = content.replace(b"  \n", b"\n", 1)
    assert read(content, "a.npy") == TWO.tolist()


def test_npy_of_text_by_its_old_name(read):
    """Found by fuzzing: NumPy warns of it."""
    content = npy(np.array(["1", "2"], dtype="S1")).replace(b"'|S1'", b"'|a1'")
    with pytest.raises(FileReadError):
        read(content, "a.npy")


def test_npy_columns(read):
    wide = np.column_stack([np.zeros(2), TWO[:, 1], TWO[:, 0]])
    assert read(npy(wide), "a.npy", dimension=2) == wide[:, :2].tolist()
    assert read(npy(wide), "a.npy", columns=(2, 1)) == TWO.tolist()
    assert read(npy(wide), "a.npy", dimension=3) == wide.tolist()


def test_npy_of_three_columns_is_in_space_unless_it_is_flat(read):
    solid = np.arange(9.0).reshape(3, 3)
    assert read(npy(solid), "a.npy") == solid.tolist()
    flat = np.column_stack([TWO, [7.0, 7.0]])
    assert read(npy(flat), "a.npy") == TWO.tolist()
    assert read(npy(flat), "a.npy", dimension=3) == flat.tolist()
    assert read(npy(flat), "a.npy", columns=(0, 1, 2)) == flat.tolist()
    fields = np.array([(1.0, 2.0, 3.0), (4.0, 5.0, 6.0)], dtype="f8,f8,f8")
    fields.dtype.names = ("z", "x", "y")
    assert read(npy(fields), "a.npy") == [[2, 3, 1], [5, 6, 4]]


def test_npy_with_fields(read):
    table = np.array([(2.0, "a", 1.0), (4.0, "b", 3.0)], dtype="f8,U3,f8")
    table.dtype.names = ("lat", "\u03bc", "lon")
    with pytest.warns(UserWarning, match=r"format 3\.0"):
        data = npy(table)
    assert read(data, "a.npy") == TWO.tolist()
    assert read(data, "a.npy", columns=("lat", 2)) == TWO[:, ::-1].tolist()


def test_npz_keys(read):
    data = npz(first=TWO, second=TWO + 1)
    assert read(data, "a.npz", key="second") == (TWO + 1).tolist()


def faulty_header(shape: str, dtype: str = "<f8") -> bytes:
    header = f"{{'descr': '{dtype}', 'fortran_order': False, 'shape': {shape}, }}"
    header = header.ljust(117) + "\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode()


OBJECTS = npy(np.array([[object(), 1]], dtype=object).astype(str).astype(object))


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (npy(TWO)[:-1], "is cut off or damaged: its header promises 32 bytes of data and 31"),
        (npy(TWO)[:100], "is not a complete NPY file ("),
        (npy(TWO)[:5], "is not a complete NPY file ("),
        (b"x,y\n1,2\n", "is not a complete NPY file ("),
        (faulty_header("(1000000000000, 2)"), "its header promises 16000000000000 bytes"),
        (faulty_header("(-1, 2)"), "is cut off or damaged"),
        (faulty_header("(9" + "9" * 60 + ", 2)"), "is cut off or damaged"),
        (faulty_header("(2, 2"), "is not a complete NPY file"),
        (faulty_header("(2, 2)", "<q9"), "is not a complete NPY file"),
        (OBJECTS, "holds Python objects, which are not read because they could run code"),
        (npy(np.zeros(5)), "holds an array of shape (5,), not a table; save points of shape"),
        (npy(np.zeros((2, 2, 2))), "holds an array of shape (2, 2, 2), not a table"),
        (npy(np.zeros((5, 7))), "among its 7 columns with columns=, such as columns=(0, 1)"),
        (npy(np.zeros((2, 50))), "if it is transposed, save points.T"),
        (npy(np.array([["1", "2"]])), "holds <U1 in column 0, which are no coordinates"),
        (npy(TWO.astype(complex)), "holds complex128 in column 0, which are no coordinates"),
        (npy(TWO > 1), "holds bool in column 0, which are no coordinates"),
        (npy(np.array([[0, 0], [0, 2**53 + 1]])), "beyond 2**53 in column 1, row 1, which"),
        (npy(np.full((9, 2), -(2**63))), "in column 0, rows 0, 1, 2, 3, 4, ... (9 in all)"),
    ],
)
def test_npy_faults(fault, data, message):
    assert message in fault(data, "a.npy")


def hostile_npz() -> bytes:
    """Return an archive whose directory claims a terabyte."""
    data = bytearray(npz(points=TWO))
    entry = data.index(b"PK\x01\x02")
    data[entry + 24 : entry + 28] = struct.pack("<I", 2**31)
    return bytes(data)


@pytest.mark.parametrize(
    ("data", "options", "message"),
    [
        (
            npz(a=TWO, b=TWO),
            {},
            "has no array 'points' and not just one array; choose with key=",
        ),
        (npz(a=TWO, b=TWO), {}, "one of: 'a', 'b'"),
        (npz(), {}, "choose with key= one of: none"),
        (npz(a=TWO), {"key": "c"}, "has no array 'c'; choose with key= one of: 'a'"),
        (npz(a=TWO)[:-30], {}, "is not a complete NPZ file ("),
        (npz(a=TWO)[:50], {}, "is not a complete NPZ file ("),
        (npy(TWO), {}, "is not a complete NPZ file ("),
        (hostile_npz(), {}, "is damaged: it claims more data than it can hold"),
        (npz(points=np.zeros(3)), {}, "holds an array of shape (3,), not a table"),
    ],
)
def test_npz_faults(fault, data, options, message):
    assert message in fault(data, "a.npz", **options)


def test_an_npz_whose_data_were_changed(fault, tmp_path):
    with zipfile.ZipFile(tmp_path / "b.npz", "w") as archive:
        archive.writestr("points.npy", npy(TWO))
    data = bytearray((tmp_path / "b.npz").read_bytes())
    data[data.index(TWO.tobytes())] ^= 255
    assert "is not a complete NPZ file (Bad CRC-32" in fault(bytes(data), "a.npz")


# Parquet


def test_parquet_columns(read):
    data = parquet(id=[1, 2], Easting=[1, 3], Northing=[2.0, 4.0], z=[0, 0])
    assert read(data, "a.parquet") == TWO.tolist()
    assert read(data, "a.parquet", columns=("northing", 1)) == TWO[:, ::-1].tolist()
    assert read(data, "a.parquet", columns=(0, 3)) == [[1, 0], [2, 0]]


def test_parquet_decimals(read):
    decimals = pa.array([1, 3], pa.decimal128(9, 2))
    assert read(parquet(x=decimals, y=[2, 4]), "a.parquet") == TWO.tolist()


def twins() -> bytes:
    buffer = io.BytesIO()
    pq.write_table(pa.table([pa.array([1.0])] * 3, names=["a", "a", "b"]), buffer)
    return buffer.getvalue()


@pytest.mark.parametrize(
    ("data", "options", "message"),
    [
        (parquet(x=[1.0], y=[2.0])[:-9], {}, "is not a complete Parquet file ("),
        (b"x,y\n1,2\n", {}, "is not a complete Parquet file ("),
        (parquet(x=["a"], y=[1]), {}, "holds string in column 'x', which are no coordinates"),
        (parquet(x=[1], y=[[1]]), {}, "column 'y', which are no coordinates"),
        (parquet(x=[1, None, None], y=[1, 2, 3]), {}, "no number in column 'x' in rows 1, 2;"),
        (parquet(x=[1], w=[1]), {}, "(not one 'y'); choose 2 with columns="),
        (parquet(x=[1]), {"columns": ("x", "q")}, "has no column 'q'; it has the column 'x'"),
        (parquet(x=[2**60], y=[1]), {}, "beyond 2**53 in column 'x', row 0"),
        (twins(), {"columns": (0, 2)}, "has several columns named 'a'; give them different"),
    ],
)
def test_parquet_faults(fault, data, options, message):
    assert message in fault(data, "a.parquet", **options)


def test_parquet_without_pyarrow(tmp_path, monkeypatch):
    (tmp_path / "a.parquet").write_bytes(parquet(x=[1], y=[2]))
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    message = r'reading Parquet files needs pyarrow.*pip install "alphamesh\[io\]"'
    with pytest.raises(MissingLibraryError, match=message):
        read_points(tmp_path / "a.parquet")


# Damaged files of every kind

WHOLE = {
    "a.npy": npy(TWO),
    "a.npz": npz(points=TWO),
    "a.parquet": parquet(x=TWO[:, 0], y=TWO[:, 1]),
    "a.ply": b"ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
    b"end_header\n1 2\n3 4\n",
    "b.ply": b"ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty double x\n"
    b"property double y\nend_header\n" + TWO.tobytes(),
}


@ANY_FOLDER
@given(st.sampled_from(sorted(WHOLE)), st.integers(0, 2**32))
def test_damaged_files_give_points_or_one_of_our_errors(tmp_path, name, seed):
    data = bytearray(WHOLE[name])
    rng = np.random.default_rng(seed)
    for _ in range(int(rng.integers(1, 5))):
        data[int(rng.integers(len(data)))] = int(rng.integers(256))
    data = data[: int(rng.integers(1, 2 * len(data)))]
    (tmp_path / name).write_bytes(data)
    try:
        points = read_points(tmp_path / name)
    except FileReadError as error:
        assert name in str(error)
    else:
        assert points.shape[1] == 2


# Paths


def test_paths_that_cannot_be_read(tmp_path, monkeypatch):
    path = tmp_path / "a.csv"
    for missing in (path, path / "b.csv", str(path)):
        with pytest.raises(
            FileReadError, match=r"\.csv does not exist; check the name and the"
        ):
            read_points(missing)
    (tmp_path / "b.csv").mkdir()
    with pytest.raises(FileReadError, match=r"b\.csv is a folder; name a file in it"):
        read_points(tmp_path / "b.csv")
    with pytest.raises(FileReadError, match=r"cannot be read: .*null"):
        read_points("a\0.csv")
    path.write_text("1,2\n")

    def refuse(*_args, **_options):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "open", refuse)
    with pytest.raises(FileReadError, match=r"a\.csv may not be read by this user; change"):
        read_points(path)


def test_a_disk_that_fails_while_reading(tmp_path, monkeypatch):
    class Failing(io.BytesIO):
        def read(self, *_):
            raise OSError(5, "Input/output error")

        read1 = readinto = read

    for name in ("a.csv", "a.npy", "a.parquet", "a.ply"):
        (tmp_path / name).write_bytes(WHOLE.get(name, b"1,2\n"))
        with monkeypatch.context() as patch:
            patch.setattr(Path, "open", lambda *_: Failing(b"ply\n"))
            with pytest.raises(FileReadError, match=name):
                read_points(tmp_path / name)


def test_names_that_tell_no_format(tmp_path):
    for name, message in (
        (
            "a.foo",
            r"a\.foo has the extension \.foo, which tells no format .*csv.*ply.*file_format=",
        ),
        ("a", "a has no extension, which tells no format of points"),
        ("a.png", r"a\.png is an image; draw points from it with sample_mask"),
    ):
        with pytest.raises(FileReadError, match=message):
            read_points(tmp_path / name)
    (tmp_path / "a.foo").write_bytes(npy(TWO))
    assert np.array_equal(read_points(tmp_path / "a.foo", file_format=".npy"), TWO)


def test_every_known_format_is_dispatched(tmp_path):
    for kind in POINT_FORMATS:
        (tmp_path / f"a.{kind}").write_bytes(b"\0")
        with pytest.raises(FileReadError, match=rf"a\.{kind} is not a"):
            read_points(tmp_path / f"a.{kind}")


@pytest.mark.parametrize(
    ("path", "options", "message"),
    [
        (5, {}, "path must name a file, not be a int"),
        ("a.csv", {"file_format": "doc"}, "file_format='doc' is unknown; choose one of csv"),
        ("-", {"file_format": "npy"}, "standard input is read as text, not as npy"),
        ("a.npy", {"delimiter": ","}, "are for text tables; this is NPY: leave them out"),
        ("a.ply", {"key": "points"}, "key= is for NPZ files; this is PLY"),
    ],
)
def test_parameters_that_do_not_fit(path, options, message):
    with pytest.raises(ParameterError) as caught:
        read_points(path, **options)
    assert message in str(caught.value)


def test_packed_binary_files(fault):
    assert "is a packed NPY file; unpack it with gunzip" in fault(b"\x1f\x8b", "a.npy.gz")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
@pytest.mark.parametrize(
    ("name", "data"),
    [("a.csv", b"x,y\n1,2\n3,4\n"), ("a.npy", npy(TWO)), ("a.npz", npz(a=TWO))],
)
def test_a_pipe_is_read_once(tmp_path, name, data):
    os.mkfifo(tmp_path / name)
    writer = threading.Thread(target=(tmp_path / name).write_bytes, args=(data,))
    writer.start()
    points = read_points(tmp_path / name)
    writer.join()
    assert np.array_equal(points, TWO)


def test_reading_needs_no_library_before_its_time():
    code = (
        "import sys; from alphamesh.io.points import read_points; import alphamesh.io.images;"
        "print([m for m in ('pandas', 'pyarrow', 'PIL', 'meshio') if m in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "[]"
