"""Columns of points: read from files, brought to triangles and regions, kept in meshes."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import alphamesh as am
from alphamesh.aggregates import AGGREGATES
from alphamesh.errors import FileReadError, LossyFormatWarning, ParameterError
from alphamesh.io.meshes import read_mesh
from planar_samples import planar_shapes

EIGHT = am.demo_cloud("eight", 200, seed=1)
DATA = {"height": EIGHT[:, 0] / 3, "number": np.arange(200)[::-1]}
ALL_TRIANGLES = np.inf


def by_hand(values, how):
    """Return the aggregate of a list, by definition; missing ones do not count."""
    present = [v for v in values if not math.isnan(v)]
    if how == "count":
        return len(present)
    if how == "sum":
        return math.fsum(present)
    if not present:
        return math.nan
    return {
        "mean": lambda: math.fsum(present) / len(present),
        "min": lambda: min(present),
        "max": lambda: max(present),
        "first": lambda: present[0],
    }[how]()


class TestAggregates:
    @settings(max_examples=60)
    @given(planar_shapes(), st.sampled_from(AGGREGATES), st.data())
    def test_by_definition(self, shape, how, data):
        n = len(shape.points)
        value = st.floats(-1e6, 1e6) | st.just(math.nan)
        values = np.array(data.draw(st.lists(value, min_size=n, max_size=n)))
        corners = [sorted(rows) for rows in shape.triangles.tolist()]
        found = shape.triangle_values(values, how)
        wanted = [by_hand([values[row] for row in rows], how) for rows in corners]
        np.testing.assert_allclose(found, wanted, rtol=1e-12, atol=1e-6)
        same = shape.filtration.representative
        wanted = []
        for region in range(len(shape.regions)):
            used = set(shape.triangles[shape.regions.labels == region].ravel().tolist())
            wanted.append(by_hand([values[i] for i in range(n) if same[i] in used], how))
        found = shape.region_values(values, how)
        np.testing.assert_allclose(found, wanted, rtol=1e-12, atol=1e-6)
        assert not found.flags.writeable

    def test_types_are_kept(self):
        shape = am.AlphaComplex([[0, 0], [1, 0], [0, 1]]).at(9)
        whole = np.array([2**60, 1, 5])
        assert shape.triangle_values(whole, "sum").tolist() == [2**60 + 6]
        assert shape.triangle_values(whole, "mean").dtype == np.float64
        assert shape.triangle_values([True, False, True], "sum").tolist() == [2]
        days = np.array(["2020-01-03", "NaT", "2020-01-01"], "M8[D]")
        assert shape.triangle_values(days, "min") == np.datetime64("2020-01-01")
        assert shape.triangle_values(days, "count").tolist() == [2]
        text = np.array([None, "b", "a"], dtype=object)
        assert shape.region_values(text, "first").tolist() == ["b"]
        assert shape.region_values(np.array([None] * 3), "first").tolist() == [None]

    def test_duplicates_count_in_regions(self):
        shape = am.AlphaComplex([[0, 0], [1, 0], [0, 1], [1, 0], [1, 0]]).at(9)
        values = [1, 2, 4, 8, 16]
        assert shape.triangle_values(values, "sum").tolist() == [7]
        assert shape.region_values(values, "sum").tolist() == [31]

    @pytest.mark.parametrize(
        ("values", "how", "message"),
        [
            ([1, 2], "mean", r"each of the 3 points; got shape \(2,\)"),
            ([1, 2, 3], "median", "no aggregate 'median'; choose one of mean, min"),
            (["a", "b", "c"], "max", "have no max; choose one of count, first"),
            (np.array([1, 2, 3], "M8[D]"), "mean", "have no mean; choose one of min"),
        ],
    )
    def test_what_is_wrong_is_told(self, values, how, message):
        shape = am.AlphaComplex([[0, 0], [1, 0], [0, 1]]).at(9)
        for method in (shape.triangle_values, shape.region_values):
            with pytest.raises(ParameterError, match=message):
                method(values, how)


class TestMeshes:
    @pytest.mark.parametrize("extension", [".vtu", ".vtk", ".ply", ".msh", ".npz"])
    def test_columns_are_numbers_of_vertices(self, tmp_path, extension):
        if extension in (".vtu", ".vtk", ".ply", ".msh"):
            pytest.importorskip("meshio")
        shape = am.AlphaComplex(EIGHT).at(ALL_TRIANGLES)
        shape.save(tmp_path / f"a{extension}", point_data=DATA)
        mesh = read_mesh(tmp_path / f"a{extension}")
        rows = mesh.point_data["input_row"].astype(int)
        for name, values in DATA.items():
            assert mesh.point_data[name].tolist() == values[rows].tolist()

    @pytest.mark.parametrize("extension", ["ply", "npz"])
    def test_and_columns_of_points_again(self, tmp_path, extension):
        shape = am.AlphaComplex(EIGHT).at(20)
        path = tmp_path / f"a.{extension}"
        shape.save(path, point_data=DATA, keep_all=True)
        table = am.read_table(path)
        assert np.array_equal(table.points, EIGHT)
        for name, values in DATA.items():
            assert table.columns[name].tolist() == values.tolist()
            assert table.columns[name].dtype.kind == values.dtype.kind

    @pytest.mark.parametrize("extension", [".npz", ".ply"])
    def test_in_space_too(self, tmp_path, extension):
        points = np.random.default_rng(1).random((60, 3))
        table = am.PointTable(points, {"heat": points[:, 2] / 3, "name": ["a"] * 60})
        shape = am.AlphaComplex(table).at(np.inf)
        path = tmp_path / f"a{extension}"
        with pytest.warns(LossyFormatWarning, match="left out 'name'"):
            shape.save(path, point_data=table, keep_all=True)
        found = am.read_table(path, dimension=3)
        assert np.array_equal(found.points, points)
        assert found.columns["heat"].tolist() == table.columns["heat"].tolist()
        with pytest.warns(LossyFormatWarning, match="hold no numbers of points"):
            shape.save(tmp_path / "a.stl", point_data={"heat": points[:, 2]})

    def test_names_fit_all_files(self):
        mesh = am.AlphaComplex(EIGHT).at(20).mesh({"Höhe [m]": EIGHT[:, 0]})
        assert list(mesh.point_data) == ["H_he_[m]"]
        with pytest.raises(ParameterError, match="two columns would both be called 'a_b'"):
            am.AlphaComplex(EIGHT).at(20).mesh({"a b": EIGHT[:, 0], "a_b": EIGHT[:, 0]})

    def test_text_is_left_out_and_told(self, tmp_path):
        shape = am.AlphaComplex(EIGHT).at(ALL_TRIANGLES)
        with pytest.warns(LossyFormatWarning, match="numbers alone: left out 'name'") as told:
            shape.save(tmp_path / "a.npz", point_data={"name": ["a"] * 200})
        assert [one.filename for one in told] == [__file__]
        with pytest.warns(LossyFormatWarning, match="STL files hold no numbers of points"):
            shape.save(tmp_path / "a.stl", point_data=DATA)
        with pytest.raises(ParameterError, match="'a' must have one value"):
            shape.save(tmp_path / "b.npz", point_data={"a": [1]})
        assert not (tmp_path / "b.npz").exists()


class TestReadTable:
    def test_text(self, tmp_path):
        path = tmp_path / "trees.csv"
        path.write_text(
            "# planted\nspecies,x,y,height [m],count,note\n"
            '"oak, red",1,2,3.5,4,\n'
            "ash,3,4,,5,old\n\nelm,5,6,1e1,-6,NA\n"
        )
        table = am.read_table(path)
        assert table.points.tolist() == [[1, 2], [3, 4], [5, 6]]
        assert list(table.columns) == ["species", "height [m]", "count", "note"]
        assert table.columns["species"].tolist() == ["oak, red", "ash", "elm"]
        np.testing.assert_array_equal(table.columns["height [m]"], [3.5, np.nan, 10])
        assert table.columns["count"].dtype == np.int64
        assert table.columns["note"].tolist() == ["", "old", "NA"]
        assert table.crs is None

    def test_decimal_commas_are_those_of_numbers(self, tmp_path):
        path = tmp_path / "a.csv"
        path.write_text("x;y;name;h\n1,5;2;a,b;3,5\n2;3,5;c;4\n")
        table = am.read_table(path, decimal=",")
        assert table.points.tolist() == [[1.5, 2], [2, 3.5]]
        assert table.columns["name"].tolist() == ["a,b", "c"]
        assert table.columns["h"].tolist() == [3.5, 4]

    def test_large_numbers_and_no_header(self, tmp_path):
        path = tmp_path / "a.csv"
        path.write_text(f"x,y,id\n1,2,{2**70}\n3,4,1\n")
        assert am.read_table(path).columns["id"].tolist() == [2.0**70, 1]
        path.write_text("1 2 3\n4 5 6\n")
        assert dict(am.read_table(path).columns) == {}

    def test_a_row_that_is_too_short_is_told(self, tmp_path):
        path = tmp_path / "a.csv"
        path.write_text("x,y,h\n1,2,3\n4,5\n")
        with pytest.raises(FileReadError, match=r"a\.csv has"):
            am.read_table(path)
        with pytest.raises(ParameterError, match="no option 'seperator'"):
            am.read_table(path, seperator=",")

    def test_structured_arrays(self, tmp_path):
        array = np.zeros(3, dtype=[("name", "U3"), ("x", "f8"), ("y", "f8"), ("k", "i4")])
        array["x"], array["k"], array["name"] = [1, 2, 3], [7, 8, 9], ["a", "b", "c"]
        np.save(tmp_path / "a.npy", array)
        np.savez(tmp_path / "a.npz", points=array)
        for path in (tmp_path / "a.npy", tmp_path / "a.npz"):
            table = am.read_table(path)
            assert table.points[:, 0].tolist() == [1, 2, 3]
            assert {k: v.tolist() for k, v in table.columns.items()} == {
                "name": ["a", "b", "c"],
                "k": [7, 8, 9],
            }

    def test_parquet(self, tmp_path):
        pa = pytest.importorskip("pyarrow")
        pq = pytest.importorskip("pyarrow.parquet")
        columns = {"x": [1.0, 2.0], "n": ["a", None], "y": [3.0, 4.0], "k": [5, 6]}
        pq.write_table(pa.table(columns), tmp_path / "a.parquet")
        table = am.read_table(tmp_path / "a.parquet")
        assert table.points.tolist() == [[1, 3], [2, 4]]
        assert {k: v.tolist() for k, v in table.columns.items()} == {
            "n": ["a", None],
            "k": [5, 6],
        }
        (tmp_path / "a.parquet").write_bytes((tmp_path / "a.parquet").read_bytes()[:-9])
        with pytest.raises(FileReadError, match="not a complete Parquet"):
            am.read_table(tmp_path / "a.parquet")

    def test_columns_are_for_tables(self, tmp_path):
        with pytest.raises(ParameterError, match="columns= is for tables"):
            am.read_points(tmp_path / "a.gpkg", columns=("x", "y"))
