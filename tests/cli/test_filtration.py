"""``alphamesh filtration``."""

from __future__ import annotations

import numpy as np
import pytest

import alphamesh as am
from cli_tools import facts, ok


def rows_of(table: np.ndarray) -> set:
    """Return simplices with their radii, whatever the order."""
    names = [name for name in table.dtype.names if name.startswith("vertex")]
    return {
        (tuple(v for v in (int(row[name]) for name in names) if v >= 0), float(row["radius"]))
        for row in table
    }


def test_every_simplex_is_listed_in_an_order_that_is_a_filtration(points):
    out = facts("filtration", "points.csv", "-o", "a.csv")
    made = am.filtration(points)
    counts = [len(rows) for rows in made.simplices]
    assert [out["vertices"], out["edges"], out["triangles"]] == counts
    assert out["last_radius"] == made.radii[2].max()
    table = np.genfromtxt("a.csv", delimiter=",", names=True)
    expected = {
        (tuple(simplex), radius)
        for rows, radii in zip(made.simplices, made.radii, strict=True)
        for simplex, radius in zip(rows.tolist(), radii.tolist(), strict=True)
    }
    assert rows_of(table) == expected
    assert (np.diff(table["radius"]) >= 0).all()
    seen = set()
    for simplex, dimension in zip(
        table[["vertex_0", "vertex_1", "vertex_2"]].tolist(), table["dimension"], strict=True
    ):
        corners = [int(v) for v in simplex if v >= 0]
        assert len(corners) == dimension + 1
        faces = [tuple(corners[:k] + corners[k + 1 :]) for k in range(len(corners))]
        assert len(corners) == 1 or all(face in seen for face in faces)
        seen.add(tuple(corners))


def test_simplices_as_arrays_and_squared(points):
    made = am.filtration(points)
    ok("filtration", "points.csv", "-o", "a.npz")
    with np.load("a.npz") as arrays:
        np.testing.assert_array_equal(arrays["points"], made.points)
        np.testing.assert_array_equal(arrays["triangles"], made.simplices[2])
        np.testing.assert_array_equal(arrays["edge_radii"], made.radii[1])
    ok("filtration", "points.csv", "-o", "b.npz", "--squared")
    with np.load("b.npz") as arrays:
        np.testing.assert_array_equal(arrays["edge_radii_squared"], made.radii[1] ** 2)


def test_simplices_in_parquet_up_to_a_radius(points):
    pq = pytest.importorskip("pyarrow.parquet")
    radius = float(np.sort(am.filtration(points).radii[1])[300])
    out = facts("filtration", "points.csv", "--max-radius", str(radius), "-o", "a.parquet")
    shape = am.AlphaComplex(points).at(radius)
    table = pq.read_table("a.parquet").to_pydict()
    assert out["triangles"] == len(shape.triangles) == table["dimension"].count(2) > 0
    assert out["edges"] == len(shape.edges)
    assert max(table["radius"]) == radius == out["last_radius"]


def test_simplices_of_hardly_anything(folder):
    assert ok("filtration", "-", "-o", "-", stdin=b"3,4\n") == (
        "dimension,vertex_0,vertex_1,vertex_2,radius\n0,0,-1,-1,0.0\n"
    )
