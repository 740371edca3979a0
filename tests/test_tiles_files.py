"""Files of tiles: past the cache or through it, tables that others read, turns to compute."""

from __future__ import annotations

import errno
import os
import threading

import numpy as np
import pytest

from alphamesh._kernels.tiles import Recycling, checksum, recycled
from alphamesh.errors import FileWriteError
from alphamesh.io._atomic import atomic_path
from alphamesh.tiles import direct, parquet
from alphamesh.tiles.direct import BLOCK, DirectReader, checksum_of, lent_block, write_direct
from alphamesh.tiles.parquet import write_parquet
from alphamesh.tiles.workers import computing, workers_of


def pieces_of(content, steps):
    """Cut bytes into pieces of some sizes, over and over."""
    done = 0
    for k in range(len(content)):
        if done >= len(content):
            return
        yield content[done : done + steps[k % len(steps)]]
        done += steps[k % len(steps)]


def written(path, content, steps=(3, 70_000, 1_234_567, 0, 4096)):
    with write_direct(path) as file:
        for piece in pieces_of(memoryview(content), steps):
            file.write(piece)
    return file


def read(path, start, count):
    with lent_block() as block, DirectReader(path, block) as file:
        return b"".join(bytes(part) for part in file.parts(start, count))


SIZES = (0, 1, 4095, BLOCK - 1, BLOCK, BLOCK + 1, 2 * BLOCK + 4096, 2 * BLOCK + 5000)


@pytest.mark.parametrize("size", SIZES)
def test_what_is_written_is_read(tmp_path, size):
    path = tmp_path / "file"
    content = np.random.default_rng(size).bytes(size)
    file = written(path, content)
    assert path.read_bytes() == content
    assert file.size == size
    step = 1 << 20
    total = 0
    for start in range(0, size, step):
        total = checksum(content[start : start + step], total)
    assert file.sum == checksum_of(path) == total
    for start, count in ((0, size), (1, 10), (4090, 9000), (size // 2, size), (size, 5)):
        assert read(path, start, count) == content[start : start + count]


def test_memory_is_filled_piece_by_piece(tmp_path):
    path = tmp_path / "file"
    content = np.random.default_rng(5).bytes(2 * BLOCK + 77)
    written(path, content)
    targets = [bytearray(size) for size in (5, 0, BLOCK + 3, 4096)]
    total = sum(map(len, targets))
    with lent_block() as block, DirectReader(path, block) as file:
        assert file.peek(17, 6) == content[17:23]
        assert file.fill(123, *map(memoryview, targets))
        assert b"".join(targets) == content[123 : 123 + total]
        assert file.peek(file.size - 2, 6) == content[-2:]
        assert not file.fill(file.size - total + 1, *map(memoryview, targets))


@pytest.mark.skipif(not hasattr(os, "O_DIRECT"), reason="all files go through the cache there")
@pytest.mark.parametrize("when", ["at once", "later"])
def test_files_that_must_go_through_the_cache(tmp_path, monkeypatch, when):
    """As in file systems that know no other way."""
    refused = []

    def refusing(known):
        def move(self, *arguments):
            if self._direct:
                refused.append(known)
                raise OSError(errno.EINVAL, "no")
            return known(self, *arguments)

        return move

    def no_flag(_file, command, flags):
        refused.append((command, flags))
        raise OSError(errno.EINVAL, "no")

    if when == "later":
        for name in ("write", "readinto"):
            known = getattr(direct._File, name)
            monkeypatch.setattr(direct._File, name, refusing(known), raising=False)
    else:
        monkeypatch.setattr("fcntl.fcntl", no_flag)
    content = np.random.default_rng(6).bytes(2 * BLOCK + 77)
    written(tmp_path / "file", content)
    assert (tmp_path / "file").read_bytes() == content
    assert len(refused) == 1
    assert read(tmp_path / "file", 0, len(content)) == content
    assert len(refused) == 2


@pytest.mark.parametrize("number", [errno.ENOSPC, errno.EIO])
def test_a_disk_that_fails_in_a_large_file(tmp_path, monkeypatch, number):
    done = []

    def write(_self, content):
        if len(done) == 2:
            raise OSError(number, os.strerror(number))
        done.append(len(content))
        return len(content)

    monkeypatch.setattr(direct._File, "write", write, raising=False)
    path = tmp_path / "file"
    with (
        pytest.raises(FileWriteError, match="Nothing was changed"),
        atomic_path(path) as at,
        write_direct(at) as file,
    ):
        for _ in range(9):
            file.write(bytes(BLOCK // 2))
    assert done == [BLOCK, BLOCK]
    assert not list(tmp_path.iterdir())


def test_files_may_be_open_at_the_same_time(tmp_path):
    content = [np.random.default_rng(k).bytes(BLOCK + 9) for k in range(2)]
    with write_direct(tmp_path / "0") as first, write_direct(tmp_path / "1") as second:
        for start in range(0, BLOCK + 9, 100_000):
            first.write(content[0][start : start + 100_000])
            second.write(content[1][start : start + 100_000])
    assert [(tmp_path / name).read_bytes() for name in "01"] == content


# ----------------------------------------------------------------------- tables


@pytest.fixture
def small(monkeypatch):
    """Make row groups of 64 rows in pages of 24."""
    monkeypatch.setattr(parquet, "_GROUP", 64)
    monkeypatch.setattr(parquet, "_PAGE", 24)


@pytest.mark.parametrize("count", [0, 1, 7, 8, 24, 25, 64, 65, 1000])
def test_others_read_the_tables(tmp_path, small, count):
    pq = pytest.importorskip("pyarrow.parquet")
    rng = np.random.default_rng(count)
    columns = {
        "row": rng.integers(-(2**31), 2**31, count).astype(np.int32),
        "long": rng.integers(-(2**62), 2**62, count),
        "x": rng.standard_normal(count),
        "kind": rng.integers(1, 4, count).astype(np.int8),
        "same": np.full(count, -7, dtype=np.int8),
        "sign": rng.integers(0, 2, count).astype(np.int8) * 2 - 1,
        "move": rng.integers(-5, 6, count).astype(np.int8),
        "byte": rng.integers(-128, 128, count).astype(np.int8),
    }
    path = tmp_path / "table.parquet"
    with write_direct(path) as file:
        write_parquet(file, columns, ranges=["x"])
    table = pq.read_table(path)
    table.validate(full=True)
    assert table.column_names == list(columns)
    for name, column in columns.items():
        found = table.column(name).to_numpy()
        assert found.dtype == column.dtype
        np.testing.assert_array_equal(found, column)
    facts = pq.read_metadata(path)
    assert facts.num_rows == count
    assert facts.num_row_groups == -(-count // 64)
    for k in range(facts.num_row_groups):
        part = columns["x"][64 * k : 64 * (k + 1)]
        noted = facts.row_group(k).column(2).statistics
        assert (noted.min, noted.max, noted.null_count) == (part.min(), part.max(), 0)
        assert facts.row_group(k).column(0).statistics is None
    if count:
        chosen = pq.read_table(path, filters=[("x", ">", 0.5), ("kind", "==", 2)])
        assert len(chosen) == np.sum((columns["x"] > 0.5) & (columns["kind"] == 2))


def test_ranges_hold_zeros_of_both_signs(tmp_path):
    pq = pytest.importorskip("pyarrow.parquet")
    path = tmp_path / "table.parquet"
    with write_direct(path) as file:
        write_parquet(file, {"x": np.array([0.0, -0.0, 0.0])}, ranges="xyz")
    noted = pq.read_metadata(path).row_group(0).column(0).statistics
    assert np.signbit([noted.min, noted.max]).tolist() == [True, False]


# ------------------------------------------------------------- threads and memory


def test_some_read_and_write_while_others_compute():
    lock = threading.Lock()
    together = threading.Barrier(3)
    active, most = 0, 0

    def work(task):
        nonlocal active, most
        together.wait(timeout=30)  # three are here, although two may compute
        with computing():
            with lock:
                active += 1
                most = max(most, active)
            pause.wait(0.002)
            with lock:
                active -= 1
        return task

    pause = threading.Event()
    with workers_of(None, None, 2) as workers:
        assert sorted(workers.each(work, range(30))) == list(range(30))
    assert most == 2


def test_memory_serves_again():
    keep = Recycling()
    first = recycled((1000, 200), np.float64)
    assert first.shape == (1000, 200)
    place = first.ctypes.data
    del first
    again = recycled((1_600_000,), np.uint8)
    assert again.ctypes.data == place
    again[:] = 7
    other = recycled((3, 2), np.int32)
    other[:] = 5
    assert (again == 7).all()
    del keep
