"""Tiles of periodic boxes: their union is the complex of the whole box, bit for bit."""

from __future__ import annotations

import json
from itertools import pairwise

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st

import alphamesh as am
from alphamesh import tiles
from alphamesh.cli.app import app
from alphamesh.errors import ParameterError, PeriodicError, PeriodsError

pa = pytest.importorskip("pyarrow")
pq = pytest.importorskip("pyarrow.parquet")


def solved(points, periods, radius, count, weights=None):
    """Return the pieces of a plain loop over tiles."""
    tiling = tiles.plan_in_box(points[:500], count, periods)
    known = None if weights is None else tiles.WeightRange.of(weights)
    reach = radius if known is None else known.reach(radius)
    offsets, rows, moves = tiles.spread_in_box(tiling, points, periods, reach)
    pieces = []
    for tile, (a, b) in enumerate(pairwise(offsets)):
        part = rows[a:b]
        heavy = None if weights is None else weights[part]
        pieces.append(
            tiles.solve_in_box(
                tiling, tile, part, points[part], moves[a:b], periods, radius,
                weights=heavy, weight_range=known,
            )
        )  # fmt: skip
    return pieces


def ordered(simplices, offsets, radii):
    order = np.lexsort(simplices.T[::-1])
    return simplices[order], offsets[order], radii[order]


def assert_same_simplices(cx, radius, found):
    """Rows tell simplices apart, as boxes are wide beside the radius."""
    for k in range(cx.points.shape[1] + 1):
        there = cx.radii[k] <= radius
        want = ordered(cx.simplices[k][there], cx.offsets[k][there], cx.radii[k][there])
        for got, wanted in zip(ordered(*found(k)), want, strict=True):
            np.testing.assert_array_equal(got, wanted)


def assert_whole(points, periods, radius, count, weights=None):
    """Compare the union of pieces with the complex in memory."""
    pieces = solved(points, periods, radius, count, weights)
    cx = am.AlphaComplex(points, periods=periods, weights=weights)
    d = points.shape[1]
    names = ("simplices", "offsets", "radii")
    assert_same_simplices(
        cx,
        radius,
        lambda k: [np.concatenate([getattr(p, name)[k] for p in pieces]) for name in names],
    )
    rows = np.concatenate([piece.rows for piece in pieces])
    assert np.array_equal(np.sort(rows), np.arange(len(points)))
    for name, whole in (("points", cx.positions), ("representative", cx.representative)):
        got = np.concatenate([getattr(piece, name) for piece in pieces])
        np.testing.assert_array_equal(got, whole[rows])
    parts = [tiles.part_of(piece) for piece in pieces]
    summary, _, sizes = tiles.merge(parts, radius, periodic=True)
    shape = cx.at(radius)
    assert summary.counts == tuple(shape.counts.values())
    assert summary.euler_characteristic == shape.euler
    told = [k is not None for k in summary.betti]
    assert all(told) or (d == 3 and sum(summary.windings[2:]) > 0)
    kept = zip(summary.betti, shape.betti, strict=True)
    assert all(found in {None, wanted} for found, wanted in kept)
    size, around = (
        (shape.area, shape.perimeter) if d == 2 else (shape.volume, shape.surface_area)
    )
    assert summary.size == pytest.approx(size, rel=1e-12)
    assert summary.boundary_size == pytest.approx(around, rel=1e-12)
    there = cx.radii[-1] <= radius
    assert sizes.sum() == pytest.approx(size, rel=1e-12)
    assert summary.regions == regions_of(cx.filtration.facet_cells, there)
    assert summary.windings == windings_of(shape)
    return summary


def windings_of(shape):
    """Return how many components run around a box in 0, 1, ... directions, by plain search."""
    around = {int(row): [] for row in shape.vertices[:, 0]}
    moves = shape.offsets(1).astype(int)
    for (a, b), (_, move) in zip(shape.edges.tolist(), moves, strict=True):
        around[a].append((b, move))
        around[b].append((a, -move))
    found, places = [0] * (moves.shape[2] + 1), {}
    for start in around:
        if start in places:
            continue
        places[start], waiting = np.zeros(moves.shape[2], dtype=int), [start]
        loops = [places[start]]
        while waiting:
            row = waiting.pop()
            for other, move in around[row]:
                if other not in places:
                    places[other] = places[row] + move
                    waiting.append(other)
                loops.append(places[row] + move - places[other])
        found[np.linalg.matrix_rank(np.unique(loops, axis=0))] += 1
    return tuple(found)


def regions_of(facet_cells, there):
    """Return how many sets of cells hang together, by plain search."""
    neighbors = {int(cell): [] for cell in np.flatnonzero(there)}
    for a, b in facet_cells.tolist():
        if a in neighbors and b in neighbors:
            neighbors[a].append(b)
            neighbors[b].append(a)
    count = 0
    while neighbors:
        count += 1
        waiting = [next(iter(neighbors))]
        while waiting:
            waiting += neighbors.pop(waiting.pop(), [])
    return count


def places(dimension):
    rng = np.random.default_rng(dimension)
    count = 600 if dimension == 2 else 500
    side = 12 if dimension == 2 else 8
    grid = np.stack(np.meshgrid(*[np.arange(float(side))] * dimension), axis=-1)
    grid = rng.permutation(grid.reshape(-1, dimension))
    centre = rng.random((6, dimension)) * side
    return {
        "uniform": (rng.random((count, dimension)) * side * 5 - 7, side),
        "grid": (grid, side),
        "tenths": (grid[:150] * 0.1 + 0.05, side * 0.1),
        "clusters": (
            np.concatenate([c + rng.normal(0, 0.5, (60, dimension)) for c in centre]),
            side,
        ),
        "duplicates": (np.round(rng.random((300, dimension)) * 9) - side, side),
    }


@pytest.mark.parametrize("place", list(places(2)))
@pytest.mark.parametrize("dimension", [2, 3])
def test_union_is_the_whole(dimension, place):
    points, side = places(dimension)[place]
    scale = side / (12 if dimension == 2 else 8)
    for closed, radius, count in (
        ((1, 1, 1), 0.5, 1),
        ((0, 1, 1), 0.72, 7),
        ((1, 1, 0), 0.99, 4),
    ):
        periods = tuple(side if k else None for k in closed[:dimension])
        assert_whole(points, periods, radius * scale, count)


@pytest.mark.parametrize("place", list(places(2)))
@pytest.mark.parametrize("dimension", [2, 3])
def test_union_is_the_whole_with_weights(dimension, place):
    points, side = places(dimension)[place]
    unit = (side / (12 if dimension == 2 else 8)) ** 2
    rng = np.random.default_rng(6)
    weights = np.clip(rng.normal(0, 0.2, len(points)), -1, 0.4) * unit
    periods = (side,) * dimension
    assert_whole(points, periods, 0.6 * unit**0.5, 5, weights)
    if place == "uniform":
        assert_whole(points, periods, -0.3 * unit**0.5, 5, weights)
        assert_whole(points, periods, 0.3, 5, np.full(len(points), 0.2))


def test_a_full_box_is_a_torus():
    rng = np.random.default_rng(2)
    points = rng.random((900, 2)) * 10
    assert assert_whole(points, (10, 10), 1.2, 6).betti == (1, 2, 1)
    assert assert_whole(points, (10, None), 1.2, 6).betti == (1, 1, 0)
    summary = assert_whole(places(3)["grid"][0], (8, 8, 8), 0.9, 6)
    assert (summary.betti, summary.euler_characteristic) == ((1, 3, 3, 1), 0)
    assert summary.size == pytest.approx(512.0)


coordinates = st.integers(-3, 20).map(float)


@settings(max_examples=40, deadline=None)
@given(
    st.integers(2, 3),
    st.lists(
        st.tuples(coordinates, coordinates, coordinates, st.integers(-2, 2)),
        min_size=1, max_size=20,
    ),
    st.sampled_from([0.0, 0.5, 0.75, 1.0, 1.4]),
    st.integers(1, 5),
    st.sampled_from([(1, 1, 1), (1, 0, 1), (0, 1, 0)]),
    st.booleans(),
)  # fmt: skip
def test_union_is_the_whole_for_sparse_boxes(dimension, rows, radius, count, closed, heavy):
    table = np.array(rows, dtype=float)
    points = table[:, :dimension] * [1, 0.5, 1][:dimension]
    periods = tuple(16.0 if k else None for k in closed[:dimension])
    assert_whole(points, periods, radius, count, table[:, 3] if heavy else None)


def test_strips_run_around():
    along = np.arange(0.0, 20.0, 0.5)
    strip = np.column_stack((along, np.full(40, 5.0)))
    other = np.column_stack((along, np.full(40, 12.0)))
    upright = np.column_stack((np.full(40, 3.0), along))
    alone = np.array([[10.0, 8.0]])
    for rows, wanted in (
        ((strip, alone), (1, 1, 0)),
        ((strip, other, alone), (1, 2, 0)),
        ((strip, upright), (0, 0, 1)),
        ((strip[:-2],), (1, 0, 0)),
        ((np.column_stack((along, along)),), (0, 1, 0)),
        ((np.column_stack((along, along)), alone), (1, 1, 0)),
    ):
        cloud = np.concatenate(rows)
        assert assert_whole(cloud, (20.0, 20.0), 0.4, 6).windings == wanted
    points = np.concatenate((strip, upright))
    assert assert_whole(points, (20.0, None), 0.4, 6).windings == (0, 1, 0)


def test_voids_in_boxes():
    """Spheres across borders, one of them full; a layer, of which tiles cannot tell."""
    rng = np.random.default_rng(5)
    shell = rng.normal(size=(330, 3))
    shell *= 1.5 / np.linalg.norm(shell, axis=1)[:, np.newaxis]
    centres = np.array([[0.0, 5, 5], [5, 9, 0.5]])
    points = np.concatenate(
        (shell + centres[0], shell + centres[1], shell[::9] / 6 + centres[0])
    )
    assert assert_whole(points, (10.0, None, 10.0), 0.5, 5).betti == (3, 0, 2, 0)
    rod = np.column_stack((np.arange(0, 10, 0.5), np.full(20, 7.5), np.full(20, 7.5)))
    points = np.concatenate((points, rod))
    assert assert_whole(points, (10.0,) * 3, 0.5, 5).betti == (4, 1, 2, 0)
    layer = np.stack(np.meshgrid(*[np.arange(0, 10, 0.625)] * 2, [8.0]), axis=-1).reshape(-1, 3)
    summary = assert_whole(np.concatenate((layer, shell + centres[0])), (10.0,) * 3, 0.5, 5)
    assert (summary.betti, summary.windings) == ((2, None, None, 0), (1, 0, 1, 0))


def test_small_boxes_are_refused():
    points = np.random.default_rng(1).random((50, 2))
    with pytest.raises(PeriodsError, match=r"at least 8 radii.*along y is 1\. A box"):
        solved(points, (100.0, 1.0), 0.2, 3)
    assert solved(points, (100.0, None), 0.2, 3)


def test_tiles_of_open_space_do_not_fit_a_box():
    points = np.random.default_rng(1).random((60, 2)) * 10
    tiling, periods = tiles.plan(points, 1), (10.0, 10.0)
    _, rows, moves = tiles.spread_in_box(tiling, points, periods, 1.0)
    with pytest.raises(ParameterError, match="knows a point twice"):
        tiles.solve_in_box(tiling, 0, rows, points[rows], moves, periods, 1.0)


def test_no_tile_takes_more_than_half_a_box():
    tiling = tiles.plan_in_box(np.full((9, 3), 0.7), 1, (2.0, None, 1.0))
    boxes = np.clip(tiling.boxes, [0, -9, 0], [2, 9, 1])
    assert len(tiling) == 4
    assert (np.diff(boxes, axis=1)[:, 0] == [1, 18, 0.5]).all()


# ----------------------------------------------------------------------- on disk


@pytest.mark.parametrize("dimension", [2, 3])
def test_a_run_stopped_and_resumed(tmp_path, dimension):
    rng = np.random.default_rng(12)
    points, weights = rng.random((1500, dimension)) * 12, rng.normal(0, 0.05, 1500)
    np.save(tmp_path / "cloud.npy", np.column_stack((points, weights)))
    periods = (12.0, None, 12.0)[:dimension]
    data = tiles.dataset(
        tmp_path / "cloud.npy", dimension=dimension, weights=dimension, periods=periods,
        chunk_points=400,
    )  # fmt: skip
    out = tmp_path / "out"

    class StopError(Exception):
        pass

    def stop(fraction):
        if fraction > 0.5:
            raise StopError

    with pytest.raises(StopError):
        tiles.run(data, 0.5, out, tile_points=300, threads=1, progress=stop)
    assert 0 < tiles.status(out).tiles_done < tiles.status(out).tiles
    result = tiles.run(data, 0.5, out, tile_points=300)
    assert result.periods == periods
    cx = am.AlphaComplex(points, weights=weights, periods=periods)
    assert_same_simplices(
        cx,
        0.5,
        lambda k: (result.simplices(k)[0], result.offsets(k), result.simplices(k)[1]),
    )
    vertices = pa.concat_tables(result.tables("vertices")).to_pandas().set_index("row")
    places = vertices.sort_index()[list("xyz"[:dimension])].to_numpy()
    np.testing.assert_array_equal(places, cx.positions)
    with pytest.raises(PeriodicError, match="boundary"):
        result.boundary()
    with pytest.raises(PeriodicError, match="polygons"):
        result.polygons()
    with pytest.raises(PeriodicError, match="give one"):
        tiles.choose_radius(data)
    with pytest.raises(PeriodsError, match="at least 8 radii"):
        tiles.run(data, 2.0, tmp_path / "wide")


def test_offsets_are_of_boxes(tmp_path):
    np.save(tmp_path / "cloud.npy", np.random.default_rng(1).random((50, 2)))
    data = tiles.dataset(tmp_path / "cloud.npy")
    with pytest.raises(PeriodicError, match="periods="):
        tiles.run(data, 0.1, tmp_path / "out").offsets(1)
    with pytest.raises(PeriodsError, match="need 2 periods"):
        tiles.dataset(tmp_path / "cloud.npy", periods=(1, 1, 1))


def test_commands(tmp_path):
    points = np.random.default_rng(3).random((900, 2)) * 10
    np.save(tmp_path / "cloud.npy", points)
    run, out = CliRunner().invoke, str(tmp_path / "out")
    options = ["--periods", "10,", "-r", "0.5", "--tile-points", "300", "-o", out, "--json"]
    ran = run(app, ["tiles", "run", str(tmp_path / "cloud.npy"), *options])
    assert ran.exit_code == 0, ran.output
    shape = am.AlphaComplex(points, periods=(10, None)).at(0.5)
    assert json.loads(ran.stdout)["betti"] == list(shape.betti)
    assert json.loads(ran.stdout)["periods"] == [10.0, None]
    told = run(app, ["tiles", "merge", out]).stdout
    assert f"{shape.betti[1]} loops" in told
    assert "1 component in 1 direction" in told
    failed = run(app, ["tiles", "merge", out, "-o", str(tmp_path / "outline.geojson")])
    assert failed.exit_code != 0
    assert "open clouds alone" in failed.output


def test_a_box_that_is_refused_leaves_nothing_behind(tmp_path):
    rng = np.random.default_rng(2)
    np.save(tmp_path / "cloud.npy", rng.random((50, 3)))
    for weights in (None, 2):  # weights are read before the largest ball is known
        data = tiles.dataset(tmp_path / "cloud.npy", weights=weights, periods=(1, 1))
        with pytest.raises(PeriodsError, match="at least 8 radii"):
            tiles.run(data, 0.3, tmp_path / "tiles", threads=1)
        assert [path.name for path in tmp_path.iterdir()] == ["cloud.npy"]
