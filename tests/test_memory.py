"""Memory between calls: kept for the next one, given back when asked for, never shared."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

from alphamesh._kernels import _core

N = 30_000


def values(points):
    return [array for array in _core.alpha3(points, 2, None) if isinstance(array, np.ndarray)]


def mapped():
    """Return the size of the address space: what is kept counts, touched or not."""
    import resource

    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0])
    return pages * resource.getpagesize()


def test_results_that_are_held_are_left_alone():
    rng = np.random.default_rng(0)
    clouds = [rng.random((N, 3)) for _ in range(3)]
    wanted = [[array.copy() for array in values(cloud)] for cloud in clouds]
    held = []
    for cloud in clouds:
        held.append(values(cloud))
        _core.alpha2(np.ascontiguousarray(cloud[:, :2]), 2, None)
        held[-1].pop(1)  # a hole, which the next call may fill
    for arrays, copies in zip(held, wanted, strict=True):
        for array, copy in zip(arrays, copies[:1] + copies[2:], strict=True):
            assert np.array_equal(array, copy)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="needs /proc")
def test_the_next_call_finds_the_memory_of_the_last():
    points = np.random.default_rng(1).random((100_000, 3))
    slack = sum(array.nbytes for array in values(points)) / 4
    _core.trim_memory()
    before = mapped()
    result = values(points)
    held = mapped()
    assert held - before > 4 * slack
    del result
    assert abs(mapped() - held) < slack  # kept, though the system may have the pages
    again = values(points)
    assert abs(mapped() - held) < slack
    del again
    _core.trim_memory()
    assert abs(mapped() - before) < slack


def test_giving_memory_back_twice_or_while_results_live_is_harmless():
    points = np.random.default_rng(2).random((N, 3))
    result = values(points)
    copies = [array.copy() for array in result]
    _core.trim_memory()
    _core.trim_memory()
    assert all(np.array_equal(a, b) for a, b in zip(result, copies, strict=True))
    assert all(np.array_equal(a, b) for a, b in zip(values(points), copies, strict=True))
