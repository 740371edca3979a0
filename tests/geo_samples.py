"""Shapes, columns and files of geographic information, for tests."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import strategies as st

import alphamesh as am
from alphamesh.io.geo import GEO_FORMATS
from planar_samples import from_picture

geopandas = pytest.importorskip("geopandas")
shapely = pytest.importorskip("shapely")
pytest.importorskip("pyogrio")
pytest.importorskip("pyarrow")

FORMATS = tuple(GEO_FORMATS)
WITH_COLUMNS = tuple(key for key, form in GEO_FORMATS.items() if form.columns)
SHAPEFILES = (".shp", ".shz", ".zip")
OF_POINTS = tuple(key for key in FORMATS if key != ".wkb")
UTM = 25832

# A ring that touches itself, an island in its hole, a square that touches the ring.
FIGURE = from_picture(["#####.", "#...#.", "#.#.#.", "#...#.", "####.#", "....#."])


@st.composite
def coordinates(draw, least=0, most=12):
    """Points of many magnitudes, every bit of which must survive."""
    number = st.floats(-1e9, 1e9, allow_nan=False, width=64).map(lambda x: x + 0.0)
    rows = draw(st.lists(st.tuples(number, number, number), min_size=least, max_size=most))
    return np.array(rows, dtype=float).reshape(-1, 3)


@st.composite
def tables(draw):
    """Points with a column of each kind that GIS files hold."""
    points = draw(coordinates(least=1))
    n = len(points)
    text = st.text(st.characters(codec="utf-8", exclude_categories=("C", "Z")), max_size=9)
    columns = {
        "height": draw(st.lists(st.floats(-1e6, 1e6), min_size=n, max_size=n)),
        "number": draw(st.lists(st.integers(-(2**31), 2**31 - 1), min_size=n, max_size=n)),
        "name": draw(st.lists(text.map(lambda t: f"n{t}"), min_size=n, max_size=n)),
    }
    return am.PointTable(points, columns, UTM)


def placed(shape, seed=1):
    """Return the same triangles over points that need all their bits, as (n, 2)."""
    rng = np.random.default_rng(seed)
    turn = rng.uniform(0, 7)
    matrix = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    return shape.points @ matrix * rng.uniform(1, 99) + rng.uniform(-1e6, 1e6, 2)
