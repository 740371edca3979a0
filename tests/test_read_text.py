"""Text tables: delimiters, headers and encodings found; faults named by their lines."""

from __future__ import annotations

import gzip
import io
import sys

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from alphamesh.errors import FileReadError, ParameterError
from alphamesh.io.points import read_points

TWO = [[1.0, 2.0], [3.0, 4.0]]

clouds = hnp.arrays(
    np.float64,
    st.tuples(st.integers(1, 30), st.just(2)),
    elements=st.floats(allow_nan=True, allow_infinity=True),
)


@pytest.fixture
def read(tmp_path):
    """Return a function that writes a text to a file and reads it as points."""

    def write_and_read(text, name="points.csv", **options):
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return read_points(path, **options).tolist()

    return write_and_read


@pytest.fixture
def fault(read):
    """Return a function that tells the error message of a text."""

    def message(text, name="points.csv", **options):
        with pytest.raises(FileReadError) as caught:
            read(text, name, **options)
        assert name in str(caught.value)
        return str(caught.value)

    return message


# What is understood


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    clouds,
    st.sampled_from([",", ";", "\t", " ", "  ", ", "]),
    st.sampled_from(["", "x{0}y\n", "# made by hand\n", "#x{0}y\n", "\n\n"]),
    st.sampled_from(["\n", "\r\n"]),
)
def test_text_round_trip(tmp_path, points, delimiter, top, line_end):
    text = top.format(delimiter) + "".join(
        f"{x!r}{delimiter}{y!r}\n" for x, y in points.tolist()
    )
    path = tmp_path / "points.txt"
    path.write_bytes(text.replace("\n", line_end).encode())
    again = read_points(path)
    assert again.dtype == np.float64
    assert again.flags.c_contiguous
    assert np.array_equal(again, points, equal_nan=True)
    assert np.array_equal(np.signbit(again[again == 0]), np.signbit(points[points == 0]))


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.csv", "1,2\n3,4\n"),
        ("a.csv", "1,2\n3,4"),
        ("a.csv", "x,y\n1,2\n3,4\n"),
        ("a.csv", "x;y\n1;2\n3;4\n"),
        ("a.csv", "1 , 2\n3 , 4\n"),
        ("a.csv", "1,2,\n3,4,\n"),
        ("a.csv", "x,y\n1,2,\n3,4,\n"),
        ("a.csv", 'x,y\n"1","2"\n"3","4"\n'),
        ("a.csv", "x,y\n1,2\n,\n\n  \n3,4\n,\n"),
        ("a.csv", "x,y\r1,2\r3,4\r"),
        ("a.csv", "id,label,y,x\n7,a,2,1\n8,b,4,3\n"),
        ("a.csv", 'name,X,Y\n"Smith, J",1,2\n"two\nlines",3,4\n'),
        ("a.csv", "id,Lat,Lon\n7,2,1\n8,4,3\n"),
        ("a.csv", "Northing (m),Easting (m)\n2,1\n4,3\n"),
        ("a.csv", "first,second\n1,2\n3,4\n"),
        ("a.csv", ",x,y\n0,1,2\n1,3,4\n"),
        ("a.csv", "1,2,9\n3,4,9\n"),
        ("a.csv", "1,2\n3,4,too,many\n"),
        ("a.tsv", "x\ty\n1\t2\n3\t4\n"),
        ("a.tab", "name\tx\ty\n\t1\t2\nb\t3\t4\n"),
        ("a.txt", "x y\n1 2\n3 4\n"),
        ("a.txt", "  1   2\n  3\t 4\n"),
        ("a.txt", "# made, by; hand\n1 2 # one\n3 4\n"),
        ("a.txt", '"x" "y"\n"1" 1 2\n"2" 3 4\n'),  # as R writes it
        ("a.txt", "# time x y\n0 1 2\n0 3 4\n"),  # as numpy.savetxt writes it
        ("a.dat", "1;2\n3;4\n"),
        ("a.xyz", "1 2 9\n3 4 9\n"),
        ("a.XYZ", "x y z\n1 2 9\n3 4 9\n"),
    ],
)
def test_layouts(read, name, text):
    assert read(text, name) == TWO


@pytest.mark.parametrize(
    ("text", "options"),
    [
        ("A,1,2\nB,3,4\n", {"columns": (1, 2)}),
        ("A,1,2\nB,3,4\n", {"columns": "1,2"}),
        ("a,b,c\n2,0,1\n4,0,3\n", {"columns": ("c", "a")}),
        ("a,b,c\n2,0,1\n4,0,3\n", {"columns": "C, A"}),
        ("a,b,c\n2,0,1\n4,0,3\n", {"columns": (np.int64(2), "a")}),
        ("a,A,c\n2,0,1\n4,0,3\n", {"columns": ("c", "a")}),
        ("x,y,2020\n1,2,0\n3,4,0\n", {"header": True}),
        ("x,y,2020\n1,2,0\n3,4,0\n", {"columns": ("x", "y")}),
        ("5,6\n1,2\n3,4\n", {"header": True}),
        ("5,6\n1,2\n3,4\n", {"skip": 1}),
        ("1|2\n3|4\n", {"delimiter": "|"}),
        ("1  2\n3 4\n", {"delimiter": " "}),
        ("x;y\n1,0;2,0\n3,0;4,0\n", {"decimal": ","}),
        ("1,0 2,0\n3,0 4,0\n", {"decimal": ","}),
        ("% note\n1,2 % one\n3,4\n", {"comment": "%"}),
        ("name,x,y\n#1,1,2\n#2,3,4\n", {"comment": None}),
        ("2\nwater\nH 1 2 9\nO 3 4 9\n", {"skip": 2, "columns": (1, 2)}),
        ("E (m) N (m)\n1 2\n3 4\n", {"columns": (0, 1)}),
        ("1,2\n3,4\n", {"file_format": "CSV"}),
    ],
)
def test_options(read, text, options):
    assert read(text, **options) == TWO


def test_three_dimensions(read):
    text = "z,y,x\n3,2,1\n"
    assert read(text) == [[1, 2]]
    assert read(text, dimension=3) == [[1, 2, 3]]
    assert read(text, columns=("x", "y", "z")) == [[1, 2, 3]]
    assert read("1,2,3,4\n", dimension=3) == [[1, 2, 3]]
    assert read("lat,lon,alt\n2,1,3\n", dimension=3) == [[1, 2, 3]]


def test_a_column_z_makes_points_in_space_unless_it_is_flat(read):
    table = "id,x,y,z\n1,2,3,4\n5,6,7,8\n"
    assert read(table) == [[2, 3, 4], [6, 7, 8]]
    assert read(table, dimension=2) == read(table, columns="x,y") == [[2, 3], [6, 7]]
    assert read(table.replace("8", "4")) == [[2, 3], [6, 7]]
    assert read("X [m],Y [m],Z [m]\n1,2,3\n4,5,6\n") == [[1, 2, 3], [4, 5, 6]]
    # Heights are in other units than degrees; a third column without a name may be anything.
    assert read("lon,lat,alt\n1,2,3\n4,5,6\n") == [[1, 2], [4, 5]]
    assert read("east,north,z\n1,2,3\n4,5,6\n") == [[1, 2], [4, 5]]
    assert read("1,2,3\n4,5,6\n") == [[1, 2], [4, 5]]
    assert read("x,y,z,z\n1,2,3,9\n4,5,6,9\n") == [[1, 2], [4, 5]]


def test_xyz_files_are_in_space(read):
    assert read("1 2 3\n4 5 6\n", "a.xyz") == [[1, 2, 3], [4, 5, 6]]
    assert read("1 2 3 0.5\n4 5 6 0.7\n", "a.xyz") == [[1, 2, 3], [4, 5, 6]]
    assert read("1 2 3\n4 5 3\n", "a.xyz") == [[1, 2], [4, 5]]
    assert read("1 2\n4 5\n", "a.xyz") == [[1, 2], [4, 5]]
    assert read("1 2 3\n4 5 6\n", "a.xyz", dimension=2) == [[1, 2], [4, 5]]
    assert read("1 2 3\n4 5 nan\n", "a.xyz")[0] == [1, 2, 3]


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-32"])
def test_byte_order_marks(read, encoding):
    assert read("größe,x,y\n0,1,2\n0,3,4\n".encode(encoding)) == TWO


def test_an_encoding_can_be_named(read):
    assert read("größe,x,y\n0,1,2\n0,3,4\n".encode("latin-1"), encoding="latin-1") == TWO


def test_packed_text(read):
    assert read(gzip.compress(b"x,y\n1,2\n3,4\n"), "points.csv.gz") == TWO
    assert read(gzip.compress(b"1 2\n3 4\n"), "points.xyz.GZ") == TWO


def test_standard_input(monkeypatch):
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(b"x,y\n1,2\n3,4\n")))
    assert read_points("-").tolist() == TWO


def test_many_rows(tmp_path):
    points = np.random.default_rng(0).normal(size=(70_000, 2))
    np.savetxt(tmp_path / "a.txt", points, fmt="%.17g")
    assert np.array_equal(read_points(tmp_path / "a.txt"), points)


def test_a_quotation_mark_within_a_word_is_no_quote(read):
    assert read('name,x,y\n5" pipe,1,2\nb,3,4\n') == TWO


# Faults of the whole table


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "is empty (0 bytes); was it written to the end?"),
        (";\n;;\n", "holds no rows of numbers; was it written to the end?"),
        ("\n\n", "holds no rows of numbers; was it written to the end?"),
        ("# x,y\n", "holds no rows of numbers; was it written to the end?"),
        ("x,y\n", "holds only the header line 'x,y' and no rows of numbers"),
        ("1\n2\n3\n", "has 1 column, and 2 are needed; check that it is a table"),
        ("x\n2\n3\n", "has the column 'x': which are the coordinates is unclear (not one 'y')"),
        ("x,why\n1,2\n", "(not one 'y'); choose 2 with columns="),
        ("x,y,X\n1,2,3\n", "the columns 'x', 'y', 'X': which are the coordinates is unclear"),
        (
            "a b c d\n1 2\n",
            "names 4 columns in its header, but its rows have 2; choose by number",
        ),
        (
            "3\nC 0 0 0\nC 1 0 0\n",
            "begins with a lone number, while other lines have 4 columns",
        ),
        (b"x,y\n1,2\n\0\1\2", "is not a table in text: line 3 is very long or holds binary"),
        ("1,2 " * 600_000, "is not a table in text: line 1 is very long or holds binary"),
        (
            b"\x93NUMPY",
            "is not a table in text but an NPY file; rename it, or pass file_format=",
        ),
        (
            b"PK\x03\x04",
            "is not a table in text but a zip archive, such as NPZ or a spreadsheet",
        ),
        (gzip.compress(b"1,2\n", mtime=0), "is not a table in text but compressed by gzip"),
        (b"x,y\n1,2\n\xe4,3\n", "is not text in the encoding utf-8 in line 3 ("),
        (b"1,2\n" * 50_000 + b"\xe4,3\n", "is not text in the encoding utf-8 in line 50001 ("),
        (b"\xff\xfex\0,\0y\0\n\0\0", "is not text in the encoding utf-16"),
    ],
)
def test_texts_that_are_no_table(fault, text, message):
    assert message in fault(text)


def test_broken_gzip(fault):
    whole = gzip.compress(b"1,2\n" * 50_000)
    for data in (whole[:-20], whole[: len(whole) // 2], b"1,2\n"):
        assert "is not a complete gzip file (" in fault(data, "points.csv.gz")


@pytest.mark.parametrize(
    ("columns", "message"),
    [
        (("x", "w"), "has no column 'w'; it has the columns 'x', 'y', 'name', 'Name'; choose"),
        (("x", "NAME"), r"has several columns named 'NAME' (numbers 2, 3, from 0)"),
        ((0, 9), "has no column number 9; it has the columns 'x', 'y', 'name', 'Name', and"),
        ((0, -1), "has no column number -1"),
    ],
)
def test_columns_that_are_not_there(fault, columns, message):
    assert message in fault("x,y,name,Name\n1,2,a,b\n", columns=columns)


def test_columns_of_a_table_without_names(fault):
    message = fault("1,2\n3,4\n", columns=("x", "y"))
    assert "has no column 'x'; it has 2 columns; choose" in message


def test_wide_tables_are_listed_in_part(fault):
    names = ",".join(f"c{k}" for k in range(40))
    assert "'c11', ... (40 in all)" in fault(f"{names}\n{names}\n", columns=("x", "y"))


def test_closed_and_empty_standard_input(monkeypatch):
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(b"")))
    with pytest.raises(FileReadError, match="standard input is empty; pipe a table"):
        read_points("-")
    monkeypatch.setattr(sys, "stdin", None)
    with pytest.raises(FileReadError, match="standard input is closed; name a file"):
        read_points("-")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"delimiter": ",,"}, "delimiter must be one character, not ',,'"),
        ({"delimiter": ""}, "delimiter must be one character"),
        ({"delimiter": 5}, "delimiter must be one character"),
        ({"header": "yes"}, "header must be True, False or 'auto', not 'yes'"),
        ({"skip": -1}, "skip must be a number of lines, not -1"),
        ({"skip": 1.0}, "skip must be a number of lines"),
        ({"comment": "//"}, "comment must be one character or None, not '//'"),
        ({"comment": ",", "delimiter": ","}, "comment and delimiter are both ','"),
        ({"decimal": "·"}, "decimal must be '.' or ','"),
        ({"decimal": ",", "delimiter": ","}, "and not the delimiter"),
        ({"encoding": "klingon"}, "encoding 'klingon' is unknown; common ones are"),
        ({"columns": ("x",)}, r"columns=('x',) must name two or three columns"),
        ({"columns": "x,y,z", "dimension": 2}, "must name 2 columns"),
        ({"columns": (0.5, 1)}, "columns must hold names or numbers that count from 0"),
        ({"columns": 5}, "columns must hold names or numbers that count from 0"),
        ({"columns": ("x", 0)}, "names one column twice"),
        ({"dimension": 4}, "dimension must be 2 or 3, not 4"),
        ({"dimension": 2.0}, "dimension must be 2 or 3"),
        ({"key": "points"}, "key= is for NPZ files; this is CSV"),
    ],
)
def test_impossible_parameters(read, options, message):
    with pytest.raises(ParameterError) as caught:
        read("x,y\n1,2\n3,4\n", **options)
    assert message in str(caught.value)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.one_of(
        st.binary(max_size=80),
        st.text(alphabet="0123.,;\t \n\r\"'#-exy\0é", max_size=80).map(str.encode),
    ),
    st.sampled_from(["a.csv", "a.tsv", "a.txt"]),
)
def test_any_bytes_give_points_or_one_of_our_errors(tmp_path, data, name):
    path = tmp_path / name
    path.write_bytes(data)
    try:
        points = read_points(path)
    except FileReadError as error:
        assert name in str(error)
    else:
        assert points.dtype == np.float64
        assert points.shape[1] == 2
        assert len(points) >= 1
