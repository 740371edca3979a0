"""What tiles leave to the core: points sent down a tree, shares, checksums; and the spool."""

from __future__ import annotations

import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from alphamesh import tiles
from alphamesh._kernels.tiles import checksum
from alphamesh.errors import FileReadError
from alphamesh.tiles.spool import Spool
from alphamesh.tiles.workers import workers_of

coordinates = st.integers(-3, 3).map(float)


def sent(tiling, point, width, node=0):
    """Return the tiles that know a point: plain recursion, exact widths."""
    if node < 0:
        return [-1 - node]
    at, cut = point[tiling.axes[node]], tiling.cuts[node]
    below = sent(tiling, point, width, int(tiling.below[node])) if at < cut + width else []
    above = sent(tiling, point, width, int(tiling.above[node])) if at >= cut - width else []
    return below + above


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.tuples(coordinates, coordinates, coordinates), min_size=1, max_size=60),
    st.integers(2, 3),
    st.integers(1, 12),
    st.sampled_from([0.0, 0.25, 1.0]),
)
def test_points_go_to_all_tiles_that_are_near(rows, dimension, count, radius):
    points = np.array(rows)[:, :dimension]
    tiling = tiles.plan(points, count)
    start = 0 if len(tiling.cuts) else -1
    # Widths are rounded up, so that at the rim a point may go to one tile more.
    least = [sent(tiling, point, 2 * radius, start) for point in points]
    most = [sent(tiling, point, 2 * radius + 1e-9, start) for point in points]
    offsets, found, places = tiling.spread(points, radius)
    np.testing.assert_array_equal(points[found], places)
    for tile in range(len(tiling)):
        part = found[offsets[tile] : offsets[tile + 1]].tolist()
        assert part == sorted(part)
        assert {i for i, known in enumerate(least) if tile in known} <= set(part)
        assert set(part) <= {i for i, known in enumerate(most) if tile in known}
    owners = [sent(tiling, point, 0.0, start) for point in points]
    assert [[tile] for tile in tiling.tile_of(points).tolist()] == owners


def test_a_checksum_sees_every_byte():
    content = bytes(range(200)) + bytes(53)
    known = {checksum(content)}
    for place in range(len(content)):
        changed = bytearray(content)
        changed[place] ^= 1 << (place % 8)
        known.add(checksum(bytes(changed)))
    for length in range(len(content)):
        known.add(checksum(content[:length]))
    assert len(known) == 1 + 2 * len(content)
    assert checksum(content[64:], checksum(content[:64])) not in {checksum(content), 0}
    assert checksum(content[:64] + content[64:]) == checksum(content)


@pytest.mark.parametrize("dimension", [2, 3])
def test_rows_of_the_cloud_may_be_long(dimension):
    points = np.random.default_rng(2).random((700, dimension))
    tiling = tiles.plan(points, 3)
    offsets, rows = tiling.with_halo(points, 0.1)
    part = rows[offsets[1] : offsets[2]]
    short = tiles.solve(tiling, 1, part.astype(np.int32), points[part], 0.1)
    far = np.int64(5 * 10**12)
    long = tiles.solve(tiling, 1, part + far, points[part], 0.1)
    for k in range(dimension + 1):
        assert short.simplices[k].dtype == np.int32
        assert len(short.simplices[k]) > 0
        np.testing.assert_array_equal(short.simplices[k] + far, long.simplices[k])
        np.testing.assert_array_equal(short.radii[k], long.radii[k])
    for name in ("components", "regions"):
        np.testing.assert_array_equal(getattr(short, name).keys + far, getattr(long, name).keys)
    np.testing.assert_array_equal(short.representative + far, long.representative)


def spooled(folder, chunks=3):
    rng = np.random.default_rng(4)
    folder.mkdir()
    spool = Spool(folder, 2, 3)
    offsets = np.array([0, 40, 40, 100])
    content = []
    for chunk in range(chunks):
        rows = np.sort(rng.integers(0, 1000, 100)).astype(np.int32)
        content.append((rows, rng.random((100, 2))))
        spool.write(chunk, offsets, *content[-1])
    return spool, content


def test_points_come_back_from_the_spool(tmp_path):
    spool, content = spooled(tmp_path / "chunks")
    first_rows = np.array([0, 1000, 2000])
    for tile, part in enumerate((slice(0, 40), slice(0, 0), slice(40, 100))):
        rows, points = spool.points_of(tile, first_rows, np.int64)
        np.testing.assert_array_equal(points, np.concatenate([p[part] for _, p in content]))
        wanted = [r[part] + first for (r, _), first in zip(content, first_rows, strict=True)]
        np.testing.assert_array_equal(rows, np.concatenate(wanted))
    assert all(spool.holds(chunk) for chunk in range(3))
    assert not spool.holds(3)
    spool.drop()
    assert not any(tmp_path.rglob("*.points"))


def test_damage_of_the_spool_is_seen(tmp_path):
    spool, _ = spooled(tmp_path / "chunks", chunks=1)
    whole = spool.path(0).read_bytes()
    for place in (len(whole) - 3, len(whole) // 2, 70, 22, 14, 7, 0):
        damaged = bytearray(whole)
        damaged[place] ^= 0x40
        spool.path(0).write_bytes(damaged)
        assert not spool.holds(0)
    spool.path(0).write_bytes(bytes(len(whole)))
    assert not spool.holds(0)
    for length in (0, 5, 40, len(whole) - 1):
        spool.path(0).write_bytes(whole[:length])
        assert not spool.holds(0)
    spool.path(0).write_bytes(whole[:-1] + bytes([whole[-1] ^ 1]))
    with pytest.raises(FileReadError, match=r"000000\.points is damaged"):
        spool.points_of(2, np.zeros(1, dtype=np.int64), np.int32)


@pytest.mark.parametrize("threads", [1, 3])
def test_an_error_stops_the_other_threads(threads):
    done = []

    def work(task):
        done.append(task)
        time.sleep(0.001)
        if task == 2:
            raise ValueError("two")
        return task

    with workers_of(None, None, threads) as workers:
        assert sorted(workers.each(abs, [3, -1, 2])) == [1, 2, 3]
        with pytest.raises(ValueError, match="two"):
            list(workers.each(work, range(1000)))
    assert len(done) < 1000
