"""Tiles on disk: formats, resuming, faults, workers, commands."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import textwrap
import time

import numpy as np
import pytest
from click.testing import CliRunner

import alphamesh as am
from alphamesh import tiles
from alphamesh.cli.app import app
from alphamesh.errors import DimensionError, FileReadError, NonFiniteError, ParameterError

pa = pytest.importorskip("pyarrow")
pq = pytest.importorskip("pyarrow.parquet")

RADIUS = 0.9


@pytest.fixture(scope="module")
def points():
    return np.random.default_rng(11).random((6000, 2)) * 70


@pytest.fixture
def data(tmp_path, points):
    np.save(tmp_path / "cloud.npy", points)
    return tiles.dataset(tmp_path / "cloud.npy", chunk_points=1700)


def assert_same(result, points):
    cx = am.AlphaComplex(points)
    for k in range(3):
        there = cx.radii[k] <= result.radius
        want = cx.simplices[k][there]
        order = np.lexsort(want.T[::-1])
        simplices, radii = result.simplices(k)
        np.testing.assert_array_equal(simplices, want[order])
        np.testing.assert_array_equal(radii, cx.radii[k][there][order])


def contents(folder):
    return {
        path.relative_to(folder): path.read_bytes()
        for name in ("vertices", "edges", "triangles", "tiles")
        for path in sorted((folder / name).iterdir())
    }


def test_run_is_the_complex_of_the_whole(tmp_path, data, points):
    fractions = []
    result = tiles.run(
        data, RADIUS, tmp_path / "out", tile_points=900, progress=fractions.append
    )
    assert len(result.tiling) == 7
    assert_same(result, points)
    assert fractions == sorted(fractions)
    assert fractions[-1] == 1.0
    shape = am.AlphaComplex(points).at(RADIUS)
    assert len(result.polygons()) == len(shape.regions)
    assert sum(p.area for p in result.polygons()) == pytest.approx(shape.area)
    again = tiles.TiledComplex(tmp_path / "out")
    assert again.summary == result.summary
    assert not list((tmp_path / "out" / "chunks").iterdir())


def write_las(path, points):
    laspy = pytest.importorskip("laspy")
    header = laspy.LasHeader(point_format=0, version="1.2")
    header.scales = [2.0**-20] * 3
    las = laspy.LasData(header)
    las.x, las.y = points.T[:2]
    las.z = points[:, 2] if points.shape[1] == 3 else np.zeros(len(points))
    las.write(str(path))


def write_parquet(path, points):
    table = pa.table({"name": ["a"] * len(points), "y": points[:, 1], "x": points[:, 0]})
    pq.write_table(table, path, row_group_size=700)


@pytest.mark.parametrize(
    ("extension", "write"),
    [("npy", np.save), ("parquet", write_parquet), ("las", write_las), ("laz", write_las)],
)
def test_folders_of_each_format(tmp_path, extension, write, points):
    points = np.round(points * 2**20) / 2**20
    folder = tmp_path / "data"
    folder.mkdir()
    for k, part in enumerate(np.array_split(points, 3)):
        write(folder / f"part-{k}.{extension}", part)
    (folder / "_SUCCESS").write_text("")
    data = tiles.dataset(folder, chunk_points=900)
    assert data.count == len(points)
    np.testing.assert_array_equal(np.concatenate([c.read() for c in data.chunks]), points)
    assert_same(tiles.run(data, RADIUS, tmp_path / "out", tile_points=2500), points)


def test_a_run_goes_on_where_it_was(tmp_path, data, points):
    whole = tmp_path / "whole"
    tiles.run(data, RADIUS, whole, tile_points=900)
    out = tmp_path / "out"

    class StopError(Exception):
        pass

    def stop_late(fraction):
        if fraction > 0.6:
            raise StopError

    with pytest.raises(StopError):
        tiles.run(data, RADIUS, out, tile_points=900, threads=1, progress=stop_late)
    state = tiles.status(out)
    assert 0 < state.tiles_done < state.tiles == 7
    assert not state.finished
    with pytest.raises(FileReadError, match="no finished tiles"):
        tiles.TiledComplex(out)
    done = {path: path.stat().st_mtime_ns for path in (out / "triangles").iterdir()}
    tiles.run(data, RADIUS, out, tile_points=900)
    assert tiles.status(out).finished
    assert contents(out) == contents(whole)
    kept = sum(path.stat().st_mtime_ns == at for path, at in done.items())
    assert kept >= state.tiles_done


def test_a_damaged_tile_is_made_again(tmp_path, data, points):
    out = tmp_path / "out"
    tiles.run(data, RADIUS, out, tile_points=900)
    before = contents(out)
    victim = sorted((out / "edges").iterdir())[2]
    victim.write_bytes(victim.read_bytes()[:-9])
    assert tiles.status(out).tiles_done == 6
    tiles.run(data, RADIUS, out, tile_points=900)
    assert contents(out) == before


def test_damage_of_unfinished_work_is_repaired(tmp_path, data, points):
    """As a power failure may leave it: names are there, contents are not."""
    whole, out = tmp_path / "whole", tmp_path / "out"
    tiles.run(data, RADIUS, whole, tile_points=900)
    tiles.run(data, RADIUS, out, tile_points=900, keep_chunks=True)
    (out / "tiles" / "000003.json").write_bytes(bytes(100))
    (out / "tiles" / "000004.npz").write_bytes(b"")
    chunk = sorted((out / "chunks").iterdir())[1]
    chunk.write_bytes(bytes(chunk.stat().st_size))
    state = tiles.status(out)
    assert state.tiles_done == 5
    with pytest.raises(FileReadError, match="tile 3 is missing or damaged"):
        tiles.TiledComplex(out).polygons()
    tiles.run(data, RADIUS, out, tile_points=900)
    assert contents(out) == contents(whole)


def test_threads_change_nothing(tmp_path, data):
    for threads in (1, 3):
        tiles.run(data, RADIUS, tmp_path / str(threads), tile_points=900, threads=threads)
    assert contents(tmp_path / "1") == contents(tmp_path / "3")


KILLED = """
    import sys, os, signal
    from alphamesh import tiles
    data, out = sys.argv[1:]
    def kill(fraction):
        if fraction > 0.5:
            os.kill(os.getpid(), signal.SIGKILL)
    tiles.run(tiles.dataset(data, chunk_points=1700), 0.9, out, tile_points=900, progress=kill)
"""


def test_a_killed_run_goes_on(tmp_path, data, points):
    out = tmp_path / "out"
    script = [sys.executable, "-c", textwrap.dedent(KILLED), data.chunks[0].path, str(out)]
    ended = subprocess.run(script, check=False, timeout=120)
    assert ended.returncode == -signal.SIGKILL
    assert not tiles.status(out).finished
    assert_same(tiles.run(data, RADIUS, out, tile_points=900), points)


FULL = """
    import resource, signal, sys
    from alphamesh import errors, tiles
    data, out = sys.argv[1:]
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))
    try:
        tiles.run(tiles.dataset(data, chunk_points=1700), 0.9, out, tile_points=900)
    except (errors.FileWriteError, OSError) as error:
        print(type(error).__name__)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="no limit on file sizes there")
def test_a_full_disk_leaves_no_half_written_file(tmp_path, data, points):
    out = tmp_path / "out"
    script = [sys.executable, "-c", textwrap.dedent(FULL), data.chunks[0].path, str(out)]
    ended = subprocess.run(script, check=True, timeout=120, capture_output=True, text=True)
    assert ended.stdout.strip() == "FileWriteError"
    assert not [path for path in out.rglob("*") if path.name.startswith(".")]
    assert_same(tiles.run(data, RADIUS, out, tile_points=900), points)


def test_other_runs_are_not_overwritten_by_chance(tmp_path, data, points):
    out = tmp_path / "out"
    tiles.run(data, RADIUS, out)
    with pytest.raises(ParameterError, match=r"another run \(different: radius\)"):
        tiles.run(data, 2 * RADIUS, out)
    result = tiles.run(data, 2 * RADIUS, out, overwrite=True)
    assert result.radius == 2 * RADIUS
    assert_same(result, points)
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "letter.txt").write_text("dear reader")
    with pytest.raises(ParameterError, match="holds other files"):
        tiles.run(data, RADIUS, tmp_path / "full", overwrite=True)
    assert (tmp_path / "full" / "letter.txt").exists()


def test_bad_data_is_named(tmp_path, points):
    with pytest.raises(FileReadError, match="does not exist"):
        tiles.dataset(tmp_path / "none.npy")
    with pytest.raises(FileReadError, match="found: none"):
        tiles.dataset(tmp_path)
    with pytest.raises(FileReadError, match="chunk at a time"):
        tiles.dataset(tmp_path / "cloud.csv")
    (tmp_path / "bad.parquet").write_bytes(b"PAR1" * 50)
    with pytest.raises(FileReadError, match=r"bad\.parquet is not a complete Parquet file"):
        tiles.dataset(tmp_path / "bad.parquet")
    (tmp_path / "bad.parquet").unlink()
    np.save(tmp_path / "cut.npy", points)
    whole = (tmp_path / "cut.npy").read_bytes()
    (tmp_path / "cut.npy").write_bytes(whole[: len(whole) // 2])
    with pytest.raises(FileReadError, match=r"cut\.npy is not a complete NPY file"):
        tiles.dataset(tmp_path / "cut.npy")
    holed = points.copy()
    holed[3210, 1] = np.nan
    np.save(tmp_path / "nan.npy", holed)
    data = tiles.dataset(tmp_path / "nan.npy", chunk_points=1000)
    with pytest.raises(NonFiniteError, match=r"row 3210 of .*nan\.npy") as caught:
        tiles.run(data, RADIUS, tmp_path / "out")
    assert caught.value.rows == (3210,)


@pytest.mark.parametrize("radius", [-1, np.inf, np.nan, "wide", None])
def test_bad_radius(tmp_path, data, radius):
    with pytest.raises(ParameterError, match="radius must be a number"):
        tiles.run(data, radius, tmp_path / "out")


def test_empty_data(tmp_path):
    np.save(tmp_path / "empty.npy", np.empty((0, 2)))
    result = tiles.run(tiles.dataset(tmp_path / "empty.npy"), 1.0, tmp_path / "out")
    assert result.summary.points == result.summary.counts[0] == 0
    assert result.summary.betti == (0, 0)
    assert len(result.polygons()) == 0


def test_radius_from_sampled_tiles(tmp_path):
    points = am.sample_mask(am.demo_mask("annulus", size=400), 20_000, seed=2)
    np.save(tmp_path / "ring.npy", points)
    data = tiles.dataset(tmp_path / "ring.npy", chunk_points=3000)
    choice = tiles.choose_radius(data, tile_points=2000, samples=5)
    assert len(choice.radii) == 5
    assert choice.low <= choice.radius <= choice.high
    betti = am.AlphaComplex(points).persistence().betti_numbers(choice.radius)
    assert tuple(betti[:2]) == (1, 1)
    assert f"{choice.points:,} points" in choice.reason


def test_a_header_that_promises_too_much_is_refused_at_once(tmp_path):
    path = tmp_path / "cloud.las"
    write_las(path, np.random.default_rng(3).random((50, 3)))
    data = bytearray(path.read_bytes())
    data[100:104] = (2**32 - 1).to_bytes(4, "little")  # variable length records
    path.write_bytes(data)
    with pytest.raises(FileReadError, match="promises 4294967295 records"):
        tiles.dataset(path)


def test_a_run_in_space(tmp_path):
    points = np.random.default_rng(3).random((3000, 3)) * 14
    write_las(tmp_path / "cloud.laz", points)
    data = tiles.dataset(tmp_path / "cloud.laz", dimension=3, chunk_points=700)
    points = np.concatenate([chunk.read() for chunk in data.chunks])
    result = tiles.run(data, RADIUS, tmp_path / "out", tile_points=700)
    cx = am.AlphaComplex(points)
    for k in range(4):
        there = cx.radii[k] <= RADIUS
        order = np.lexsort(cx.simplices[k][there].T[::-1])
        simplices, radii = result.simplices(k)
        np.testing.assert_array_equal(simplices, cx.simplices[k][there][order])
        np.testing.assert_array_equal(radii, cx.radii[k][there][order])
    shape = cx.at(RADIUS)
    corners, facets, rows = result.boundary()
    np.testing.assert_array_equal(points[rows], corners)
    found = {tuple(np.roll(row, -row.argmin())) for row in rows[facets]}
    assert found == {tuple(np.roll(row, -row.argmin())) for row in shape.boundary_triangles}
    assert result.summary.size == pytest.approx(shape.volume)
    with pytest.raises(DimensionError, match=r"boundary\(\)"):
        result.polygons()
    again = call("merge", tmp_path / "out")
    assert "tunnels" in again.output
    assert "Surface area" in again.output


# ---------------------------------------------------------------------- workers


@pytest.mark.timeout(120)
def test_workers_of_dask_and_one_that_dies(tmp_path, data, points):
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        killed = []

        def kill_one(fraction):
            if fraction > 0.4 and not killed:
                killed.append(next(iter(client.run(os.getpid).values())))
                os.kill(killed[0], signal.SIGKILL)

        result = tiles.run(
            data, RADIUS, tmp_path / "out", tile_points=400, cluster=client, progress=kill_one
        )
    assert killed
    assert_same(result, points)


def test_cluster_must_be_one(tmp_path, data):
    pytest.importorskip("distributed")
    with pytest.raises(ParameterError, match="cluster must be None"):
        tiles.run(data, RADIUS, tmp_path / "out", cluster=7)


def test_interrupted_run_stops_soon(tmp_path):
    rng = np.random.default_rng(0)
    np.save(tmp_path / "large.npy", rng.random((1_000_000, 2)) * 1000)
    command = [sys.executable, "-m", "alphamesh", "tiles", "run", str(tmp_path / "large.npy")]
    command += ["--radius", "1", "-o", str(tmp_path / "out"), "--tile-points", "50000"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        deadline = time.monotonic() + 60
        while not (tmp_path / "out" / "plan.npz").exists():
            assert time.monotonic() < deadline
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=10)
    assert process.returncode == 130
    assert "Interrupted" in errors


# ---------------------------------------------------------------------- commands


def call(*arguments):
    return CliRunner().invoke(app, ["tiles", *map(str, arguments)])


def test_commands(tmp_path, points):
    np.save(tmp_path / "cloud.npy", points)
    out = tmp_path / "out"
    made = call("run", tmp_path / "cloud.npy", "-r", RADIUS, "-o", out, "--tile-points", 2000)
    assert made.exit_code == 0, made.output
    assert "Tiles" not in made.output
    assert "6,000" in made.output
    state = json.loads(call("status", out, "--json").output)
    assert state["finished"]
    assert state["tiles"] == state["tiles_done"] == 3
    merged = call("merge", out, "-o", tmp_path / "outline.geojson", "--json")
    facts = json.loads(merged.output)
    collection = json.loads((tmp_path / "outline.geojson").read_text())
    assert len(collection["features"]) == facts["regions"]
    assert "Finished" in call("status", out).output


def test_command_chooses_the_radius(tmp_path, points):
    np.save(tmp_path / "cloud.npy", points)
    made = call("run", tmp_path / "cloud.npy", "-r", "auto", "-o", tmp_path / "out", "--json")
    assert made.exit_code == 0, made.output
    facts = json.loads(made.output)
    assert "the rule topology" in facts["reason"]
    assert facts["betti"][0] == 1


def test_wrong_commands(tmp_path, points):
    np.save(tmp_path / "cloud.npy", points)
    wrong = call("run", tmp_path / "cloud.npy", "-r", "wide", "-o", tmp_path / "out")
    assert wrong.exit_code == 2
    assert "neither a number nor auto" in wrong.output
    nothing = call("status", tmp_path)
    assert nothing.exit_code == 1
    assert "holds no tiles" in nothing.output
