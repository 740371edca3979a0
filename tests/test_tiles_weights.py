"""Tiles of weighted clouds: their union is the complex of the whole cloud, bit for bit."""

from __future__ import annotations

import json
import math
from itertools import pairwise

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st

import alphamesh as am
from alphamesh import tiles
from alphamesh._weights import shifted_radii
from alphamesh.cli.app import app
from alphamesh.errors import (
    FileReadError,
    ParameterError,
    UnweightedOnlyError,
    WeightsError,
)

shapely = pytest.importorskip("shapely")
pa = pytest.importorskip("pyarrow")
pq = pytest.importorskip("pyarrow.parquet")


def solved(points, weights, radius, count):
    """Return the pieces of a plain loop over tiles."""
    rng = np.random.default_rng(0)
    tiling = tiles.plan(points[rng.permutation(len(points))[:500]], count)
    known = tiles.WeightRange.of(weights)
    offsets, rows = tiling.with_halo(points, known.reach(radius))
    parts = [rows[a:b] for a, b in pairwise(offsets)]
    return [
        tiles.solve(
            tiling, tile, part, points[part], radius,
            weights=weights[part], weight_range=known,
        )
        for tile, part in enumerate(parts)
    ]  # fmt: skip


def ordered(simplices, radii):
    order = np.lexsort(simplices.T[::-1])
    return simplices[order], radii[order]


def assert_same_simplices(cx, radius, found):
    for k in range(cx.points.shape[1] + 1):
        there = cx.radii[k] <= radius
        want = ordered(cx.simplices[k][there], cx.radii[k][there])
        got = ordered(*found(k))
        np.testing.assert_array_equal(got[0], want[0])
        np.testing.assert_array_equal(got[1], want[1])


def assert_whole(points, weights, radius, count, *, topology=True):
    """Compare the union of pieces with the complex in memory."""
    pieces = solved(points, weights, radius, count)
    cx = am.AlphaComplex(points, weights=weights)
    assert_same_simplices(
        cx,
        radius,
        lambda k: (
            np.concatenate([piece.simplices[k] for piece in pieces]),
            np.concatenate([piece.radii[k] for piece in pieces]),
        ),
    )
    rows = np.concatenate([piece.rows for piece in pieces])
    assert np.array_equal(np.sort(rows), np.arange(len(points)))
    for name, whole in (("representative", cx.representative), ("weights", weights)):
        got = np.concatenate([getattr(piece, name) for piece in pieces])
        np.testing.assert_array_equal(got, whole[rows])
    summary, labels, sizes = tiles.merge([tiles.part_of(piece) for piece in pieces], radius)
    shape, d = cx.at(radius), points.shape[1]
    assert summary.counts == tuple(shape.counts.values())[: d + 1]
    facets = "edges" if d == 2 else "triangles"
    for kind in ("singular", "regular", "interior"):
        assert getattr(summary, f"{kind}_facets") == shape.counts[f"{kind}_{facets}"]
    size = shape.area if d == 2 else shape.volume
    assert summary.size == pytest.approx(size, rel=1e-12)
    assert sizes.sum() == pytest.approx(size, rel=1e-12)
    if topology:
        betti = cx.persistence().betti_numbers(radius)[:d]
        assert summary.betti == tuple(int(number) for number in betti)
    if d == 2:
        made = tiles.finish([piece.boundary for piece in pieces], labels)
        assert normal(made) == normal(shapely.get_parts(shape.polygons()))
    return summary, cx


def normal(polygons):
    return sorted(shapely.to_wkb(shapely.normalize(polygon)) for polygon in polygons)


def places(dimension):
    rng = np.random.default_rng(dimension)
    count = 900 if dimension == 2 else 700
    side = 28 if dimension == 2 else 8
    grid = np.stack(np.meshgrid(*[np.arange(float(side))] * dimension), axis=-1)
    centres = rng.random((8, dimension)) * 30
    return {
        "uniform": rng.random((count, dimension)) * count ** (1 / dimension),
        "grid": rng.permutation(grid.reshape(-1, dimension)),
        "clusters": np.concatenate([c + rng.normal(0, 1.2, (90, dimension)) for c in centres]),
        "duplicates": np.round(rng.random((count, dimension)) * (14 if dimension == 2 else 6)),
    }


def heavinesses(count):
    """Return weights of points about 1 apart."""
    rng = np.random.default_rng(count)
    return {
        "small": rng.random(count) / 8,
        "of both signs": rng.normal(0, 0.4, count),
        "hiding": rng.exponential(0.5, count),
        "integers": rng.integers(-1, 3, count).astype(float),
        "few heavy": np.where(rng.random(count) < 0.01, 3.0, 0.1),
    }


@pytest.mark.parametrize("heavy", list(heavinesses(1)))
@pytest.mark.parametrize("place", list(places(2)))
@pytest.mark.parametrize("dimension", [2, 3])
def test_union_is_the_whole(dimension, place, heavy):
    points = places(dimension)[place]
    weights = heavinesses(len(points))[heavy]
    for radius, count in ((-0.4, 3), (0.0, 8), (0.6, 5)):
        assert_whole(points, weights, radius, count, topology=dimension == 2 or count == 8)


def test_voids_of_balls_of_two_sizes():
    """Balls on a sphere, and within it points that are not there yet, or hidden."""
    rng = np.random.default_rng(4)
    shell = rng.normal(size=(900, 3))
    shell /= np.linalg.norm(shell, axis=1)[:, np.newaxis]
    inner = rng.random((200, 3)) - 0.5
    points = np.concatenate((4 * shell, inner))
    weights = np.concatenate((np.full(900, 0.2), np.full(200, -5.0)))
    summary, _ = assert_whole(points, weights, 0.8, 6)
    assert summary.betti == (1, 0, 1)
    assert summary.counts[0] == 900 < len(points)
    weights[900:] = 0.1 + rng.random(200)
    summary, cx = assert_whole(points, weights, 0.8, 6)
    assert summary.betti == (2, 0, 1)
    assert len(cx.hidden) > 50


@pytest.mark.parametrize("weight", [0.3, -0.25, 1e-9, 0.1, 0.0])
def test_equal_weights_shift_values(weight):
    points = places(2)["uniform"]
    weights = np.full(len(points), weight)
    for radius in (-0.6, -0.2, 0.0, 0.7):
        assert_whole(points, weights, radius, 5)
    assert_whole(places(3)["uniform"], np.full(700, weight), 0.4, 3)


@settings(max_examples=100, deadline=None)
@given(
    st.floats(-4, 4).filter(bool), st.floats(-4, 4), st.sampled_from([0.0, 1e-300, 1e100, 1.0])
)
def test_the_radius_without_weights_is_the_last_that_shifts_into_range(weight, radius, scale):
    radius, weight = radius * scale or radius, weight * scale * scale or weight
    plain = tiles.WeightRange(weight, weight).plain_radius(radius)
    if plain < 0:
        assert shifted_radii(np.zeros(1), weight)[0] > radius
        return
    around = np.array([plain, np.nextafter(plain, math.inf)])
    there = [shifted_radii(around[k : k + 1], weight)[0] <= radius for k in range(2)]
    assert there == [True, False]


def test_a_tile_of_equal_weights_in_a_cloud_of_others():
    points = np.concatenate((places(2)["uniform"], places(2)["uniform"] + [60, 0]))
    weights = np.where(points[:, 0] < 40, 0.1, 0.3)
    assert_whole(points, weights, 0.4, 6)


@pytest.mark.parametrize("axes", [((1, 0, 0), (0, 1, 0)), ((1, 0.5, 0), (0, 0, 1))])
def test_flat_clouds_have_the_values_that_they_have_in_space(axes):
    rng = np.random.default_rng(8)
    points = rng.random((300, 2)) * 17 @ np.array(axes, dtype=float)
    assert_whole(points, rng.normal(0, 0.3, 300), 0.5, 4)
    line = np.outer(rng.random(60) * 20, (1.0, 0.5, 0.25))
    assert_whole(line, rng.normal(0, 0.3, 60), 0.5, 3)


coordinates = st.integers(-3, 3).map(float)
heavy = st.one_of(st.integers(-2, 6).map(float), st.floats(-2, 4, width=16))


@settings(max_examples=40, deadline=None)
@given(
    st.integers(2, 3),
    st.lists(st.tuples(coordinates, coordinates, coordinates, heavy), max_size=30),
    st.sampled_from([-1.5, -0.5, 0.0, 0.5, 0.75, 2.0]),
    st.integers(1, 6),
)
def test_union_is_the_whole_for_nasty_clouds(dimension, rows, radius, count):
    table = np.array(rows, dtype=np.float64).reshape(-1, 4)
    assert_whole(table[:, :dimension].copy(), table[:, 3].copy(), radius, count)


def test_the_halo_is_as_wide_as_the_largest_balls():
    known = tiles.WeightRange(-4.0, 9.0)
    assert known.reach(0.0) == pytest.approx(3.0)
    assert known.reach(4.0) == pytest.approx(5.0)
    assert known.reach(-math.sqrt(5)) == pytest.approx(2.0)
    assert known.reach(-3.5) == 0.0
    assert tiles.WeightRange(-4.0, -1.0).reach(1.25) == pytest.approx(0.75)
    assert 3.0 < known.reach(0.0) < 3.0 + 1e-10


def test_weights_need_their_range():
    points, weights = np.zeros((2, 2)), np.array([1.0, 2.0])
    tiling = tiles.plan(points, 1)
    rows = np.arange(2)
    for known in (None, tiles.WeightRange(0.0, 1.5)):
        with pytest.raises(WeightsError, match="weights of the whole cloud"):
            tiles.solve(tiling, 0, rows, points, 1.0, weights=weights, weight_range=known)
    with pytest.raises(WeightsError, match="NaN or infinite"):
        tiles.WeightRange.of(np.array([1.0, np.nan]))


# ----------------------------------------------------------------------- on disk


@pytest.fixture(scope="module")
def cloud():
    rng = np.random.default_rng(12)
    return rng.random((3000, 3)) * 15, rng.normal(0.1, 0.3, 3000)


def write_parquet(folder, points, weights):
    folder.mkdir(exist_ok=True)
    names = dict(zip("xyz", points.T, strict=False))
    table = pa.table({"w": weights, **names, "name": ["a"] * len(points)})
    half = len(points) // 2
    for k, part in enumerate((table.slice(0, half), table.slice(half))):
        pq.write_table(part, folder / f"part-{k}.parquet", row_group_size=400)
    return folder


def contents(folder, names=("vertices", "edges", "triangles", "tetrahedra", "tiles")):
    paths = [path for name in names for path in sorted((folder / name).iterdir())]
    return {path.relative_to(folder): path.read_bytes() for path in paths}


@pytest.mark.parametrize("dimension", [2, 3])
def test_a_run_with_weights_stopped_and_resumed(tmp_path, cloud, dimension):
    points, weights = cloud[0][:, :dimension] * (4 if dimension == 2 else 1), cloud[1]
    folder = write_parquet(tmp_path / "data", points, weights)
    data = tiles.dataset(folder, dimension=dimension, weights="w")
    assert (data.weights, data.count, data.dimension) == ("w", 3000, dimension)
    whole = tiles.run(data, 0.3, tmp_path / "whole", tile_points=700)
    cx = am.AlphaComplex(points, weights=weights)
    assert_same_simplices(cx, 0.3, whole.simplices)
    assert whole.summary.counts[0] < len(points)

    class StopError(Exception):
        pass

    def stop(fraction):
        if fraction > 0.6:
            raise StopError

    out = tmp_path / "out"
    with pytest.raises(StopError):
        tiles.run(data, 0.3, out, tile_points=700, threads=1, progress=stop)
    assert 0 < tiles.status(out).tiles_done < tiles.status(out).tiles
    again = tiles.run(data, 0.3, out, tile_points=700)
    assert again.summary == whole.summary
    names = ("vertices", "edges", "triangles", "tiles")
    assert contents(out, names) == contents(tmp_path / "whole", names)
    vertices = pa.concat_tables(whole.tables("vertices")).to_pandas().set_index("row")
    np.testing.assert_array_equal(vertices.sort_index()["weight"], weights)
    born = np.full(len(points), np.nan)
    there = cx.radii[0] <= 0.3
    born[cx.simplices[0][there, 0]] = cx.radii[0][there]
    np.testing.assert_array_equal(vertices.sort_index()["radius"], born)
    plain = tiles.dataset(folder, dimension=dimension)
    with pytest.raises(ParameterError, match=r"different: data, weights\)"):
        tiles.run(plain, 0.3, out, tile_points=700)


def test_weights_of_each_format(tmp_path, cloud):
    points, weights = np.round(cloud[0] * 2**20) / 2**20, cloud[1]
    np.save(tmp_path / "cloud.npy", np.column_stack((weights, points)))
    data = tiles.dataset(tmp_path / "cloud.npy", columns=(1, 2, 3), weights=0)
    np.testing.assert_array_equal(data.chunks[0].read(), points)
    np.testing.assert_array_equal(data.chunks[0].read_weights(), weights)
    table = data.chunks[0].read_weighted()
    np.testing.assert_array_equal(table, np.column_stack((points, weights)))
    laspy = pytest.importorskip("laspy")
    las = laspy.LasData(laspy.LasHeader(point_format=0, version="1.2"))
    las.header.scales = [2.0**-20] * 3
    las.x, las.y, las.z = points.T
    las.intensity = np.arange(3000, dtype=np.uint16)
    las.write(str(tmp_path / "cloud.las"))
    data = tiles.dataset(tmp_path / "cloud.las", dimension=3, weights="intensity")
    table = np.concatenate([chunk.read_weighted() for chunk in data.chunks])
    np.testing.assert_array_equal(table, np.column_stack((points, np.arange(3000.0))))


def test_bad_weights_are_named(tmp_path, cloud):
    points, weights = cloud[0].copy(), cloud[1].copy()
    folder = write_parquet(tmp_path / "data", points, weights)
    with pytest.raises(FileReadError, match=r"has no column 'mass'; .* with weights="):
        tiles.dataset(folder, weights="mass")
    with pytest.raises(ParameterError, match="weights='x' is a column of coordinates"):
        tiles.dataset(folder, weights="x")
    with pytest.raises(ParameterError, match="Weights in memory: write them beside"):
        tiles.dataset(folder, weights=weights)
    np.save(tmp_path / "cloud.npy", points)
    with pytest.raises(FileReadError, match=r"has no column number 3; it has 3 columns"):
        tiles.dataset(tmp_path / "cloud.npy", dimension=3, weights=3)
    with pytest.raises(ParameterError, match="0 or more"):
        tiles.run(tiles.dataset(tmp_path / "cloud.npy"), -1.0, tmp_path / "out")
    weights[1700] = np.nan
    data = tiles.dataset(write_parquet(folder, points, weights), weights="w")
    with pytest.raises(WeightsError, match=r"weights in row 1700 of .*part-1\.parquet"):
        tiles.run(data, 0.5, tmp_path / "out")
    with pytest.raises(ParameterError, match="must be a number, finite"):
        tiles.run(data, math.inf, tmp_path / "out")
    data = tiles.dataset(folder, columns=("x", "y"), weights="name")
    with pytest.raises(FileReadError, match="cannot be read"):
        tiles.run(data, 0.5, tmp_path / "other")


def test_the_radius_of_given_balls(tmp_path, cloud):
    points, weights = cloud
    folder = write_parquet(tmp_path / "data", points, weights)
    choice = tiles.choose_radius(tiles.dataset(folder, weights="w"))
    in_memory = am.AlphaComplex(points, weights=weights).choose_radius()
    assert (choice.radius, choice.low, choice.high) == (in_memory.radius, 0.0, 0.0)
    assert in_memory.reason.startswith(choice.reason.removesuffix("."))
    write_parquet(folder, points, -np.abs(weights))
    with pytest.raises(UnweightedOnlyError, match="give one"):
        tiles.choose_radius(tiles.dataset(folder, weights="w"))
    write_parquet(folder, points[:, :2], np.zeros(3000))
    nothing = tiles.choose_radius(tiles.dataset(folder, weights="w"), tile_points=1000)
    without = tiles.choose_radius(tiles.dataset(folder), tile_points=1000)
    np.testing.assert_array_equal(nothing.radii, without.radii)


def test_commands(tmp_path, cloud):
    points, weights = cloud
    folder = write_parquet(tmp_path / "data", points, weights)
    out = str(tmp_path / "out")
    options = [
        "--dimension",
        "3",
        "--weights",
        "w",
        "--tile-points",
        "900",
        "-o",
        out,
        "--json",
    ]
    ran = CliRunner().invoke(
        app, ["tiles", "run", str(folder), "-r", "-0.2", *options, "--json"]
    )
    assert ran.exit_code == 0, ran.output
    told = json.loads(ran.stdout)
    shape = am.AlphaComplex(points, weights=weights).at(-0.2)
    assert told["counts"] == list(shape.counts.values())[:4]
    merged = CliRunner().invoke(app, ["tiles", "merge", out, "--json"])
    assert json.loads(merged.stdout)["betti"] == told["betti"]
    state = CliRunner().invoke(app, ["tiles", "status", out, "--json"])
    assert json.loads(state.stdout)["radius"] == -0.2
    auto = [*options, "--overwrite", "--json"]
    ran = CliRunner().invoke(app, ["tiles", "run", str(folder), "-r", "auto", *auto])
    assert json.loads(ran.stdout)["radius"] == 0.0
    assert "dual of the union" in json.loads(ran.stdout)["reason"]
