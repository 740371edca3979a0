"""Faults in the rows of text tables are named by line, with what to do about them."""

from __future__ import annotations

import pytest

from alphamesh.errors import FileReadError
from alphamesh.io.points import read_points


@pytest.fixture
def fault(tmp_path):
    """Return a function that tells the error message of a text."""

    def message(text, name="points.csv", **options):
        (tmp_path / name).write_bytes(text.encode())
        with pytest.raises(FileReadError) as caught:
            read_points(tmp_path / name, **options)
        assert name in str(caught.value)
        return str(caught.value)

    return message


def test_text_instead_of_numbers(fault):
    assert fault("x,y\n1,2\nfoo,5\n4,5\n6,bar\n").endswith(
        "has text in the place of a number in lines 3, 5 (line 3, column 'x': 'foo'); "
        "correct or delete the lines"
    )
    assert fault("1 2\n3 4\n5 6e\n", "a.txt").endswith(
        "in line 3 (line 3, column number 1: '6e'); correct or delete the lines"
    )
    many = fault("x,y\n1,2\n" + "a,b\n" * 20)
    assert "in lines 3, 4, 5, 6, 7, ... (20 in all) (line 3" in many
    assert "'1_0'" in fault("1,2\n1_0,2\n")
    assert "'٣'" in fault("1,2\n٣,2\n")
    assert "..." in fault("1,2\n" + "long" * 50 + ",2\n")


def test_a_whole_column_of_text(fault):
    assert fault("A,1,2\nB,3,4\n").endswith("choose columns of numbers with columns=")
    assert fault("name,kind,x1\nA,B,2\nC,D,4\n").endswith(
        "choose columns of numbers with columns= (there are 'name', 'kind', 'x1')"
    )


def test_a_header_with_a_number_in_it(fault):
    assert "if line 1 is a header, pass header=True" in fault("x,y,2020\n1,2,0\n3,4,0\n")


def test_decimal_commas(fault):
    message = fault("x;y\n1,5;2,5\n")
    assert "'1,5'); if these are decimal commas, pass decimal=','" in message


def test_missing_numbers(fault):
    assert fault("x,y\n1,\n3,4\n5,NA\n").endswith(
        "has no number in lines 2, 4 (line 2, column 'y'); "
        "fill in these numbers or delete the lines"
    )
    # A first line of missing values is no header.
    assert "has no number in line 1" in fault("NA,NA\n3,4\n")
    assert "column 'x': 'null'" in fault("x\ty\nnull\t1\n", "a.tsv")


def test_too_few_columns(fault):
    assert "has too few columns in line 3 (1 where 2 are needed)" in fault("x,y\n1,2\n3\n4,5\n")
    assert "line 4" in fault("1 2\n3 4\n\n5\n", "a.txt")


def test_line_numbers_count_comments_and_blank_lines(fault):
    assert "line 6, column 'x'" in fault("# a\n\nx,y\n1,2\n# b\n?!,4\n")
    assert "line 7, column 'x'" in fault('name,x,y\n"a\nb\nc",1,2\nd,3,4\n\ne,?!,6\n')
    assert "line 3," in fault("junk\nx,y\n?!,2\n1,2\n", skip=1)


def test_faults_far_down_are_found(fault):
    text = "x,y\n" + "1,2\n" * 60_000 + "1,?!\n" + "1,2\n" * 10
    assert "in line 60002 (line 60002, column 'y': '?!'); correct" in fault(text)


@pytest.mark.parametrize(
    ("name", "text", "line"),
    [
        ("a.csv", 'name,x,y\n"Smith,1,2\nb,3,4\nc,5,6\n', 2),
        ("a.csv", 'name,x,y\na,1,2\n"b,3,4\nc,5,6\n"d",7,8\n', 3),
        ("a.csv", 'x,y,name\n1,2,a\n3,4,"b\n5,6,c\n7,8,d\n', 3),
        ("a.txt", '1 2 a\n3 4 "b\n5 6 c\n', 2),
    ],
)
def test_a_quotation_mark_left_open_swallows_no_rows(fault, name, text, line):
    message = fault(text, name)
    assert f"has a quotation mark that is not closed in line {line} (" in message
    assert message.endswith("close it, or delete it")


def test_a_quote_after_a_blank_is_not_the_start_of_a_cell(fault):
    assert "column number 0: '\"3\"'" in fault('1,2\n "3",4\n')


def test_counting_faults_stops_in_time(fault, monkeypatch):
    monkeypatch.setattr("alphamesh.io._diagnosis._LOOKED_AT", 10)
    message = fault("x,y\n" + "1,2\n" * 5 + "?,2\n" * 50)
    assert "lines 7, 8, 9, 10, 11, ... (10 in all) and perhaps more (line 7" in message


def test_cells_too_long_for_the_search_of_faults(fault):
    cell = '"' + "long" * 50_000 + '"'
    message = fault(f"name,x,y\n{cell},1,2\nb,?,4\n{cell},1,2\n")
    assert "in line 3 (line 3, column 'x': '?')" in message
    # An odd number of quotation marks in a line makes the search start at the top.
    over_lines = cell.replace("longlong", "long\nlong", 1)
    message = fault(f"name,x,y\n{over_lines},1,2\nb,?,4\n")
    assert "cannot be read as a table: field larger than field limit" in message


def test_what_numpy_alone_objects_to_is_told_too(fault, monkeypatch):
    monkeypatch.setattr("alphamesh.io._text.explain", lambda *_: "")
    assert "cannot be read as a table: could not convert string" in fault("1,2\n?,4\n")
