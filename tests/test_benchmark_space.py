"""The benchmark of clouds in space: it runs, and says what it left out."""

from __future__ import annotations

import importlib
import re
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parent.parent


@pytest.fixture(name="space")
def import_space(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT))
    return importlib.import_module("benchmarks.space")


def test_clouds_are_in_space(space):
    for name, make in space.SPACE_CLOUDS.items():
        points = make(1_000, np.random.default_rng(1))
        assert points.shape == (1_000, 3), name
        assert len(np.unique(points, axis=0)) == 1_000, name


def test_tiny_run(space, monkeypatch, capsys):
    for peer in ("diode", "shull"):  # a peer that is missing
        monkeypatch.setitem(sys.modules, peer, None)
    if not Path("/proc/self/status").exists():
        pytest.importorskip("psutil")
    assert space.main(["--tiny", "--clouds", "uniform"]) == 0
    printed = capsys.readouterr().out
    assert printed.count("left out: ") == 3
    ours = ("all values", "all values, 1 thread", "bare", "bare, 1 thread")
    core = ("core", "core, bare", "core, bare, 1 thread")
    for name in (*ours, *core):
        seconds = re.search(rf"^ +{name}  +([\d.]+)  +([\d.]+)$", printed, re.MULTILINE)
        assert seconds is not None
        assert float(seconds[1]) >= float(seconds[2])
    assert "FAIL  diode over all values, 1,000: not measured" in printed
    assert "pass  peak memory beyond the input" in printed
    header, row = (line.split("|") for line in printed.splitlines() if line.startswith("| "))
    assert [cell.strip() for cell in header[2:6]] == [*ours[:2], core[0], ours[2]]
    assert row[1].strip() == "uniform, 1,000"
    assert all(float(cell) > 0 for cell in row[2:6])


def test_time_is_forecast_from_small_clouds(space, capsys, monkeypatch):
    asked = []
    monkeypatch.setattr(space, "_contestants", lambda threads: [("one", asked.append)])
    monkeypatch.setattr(space, "_memory", lambda sizes: [])
    seconds = iter([0.01, 0.05])
    monkeypatch.setattr(space, "once", lambda call: (call(), next(seconds))[1])
    arguments = ["--clouds", "uniform", "--sizes", "30000", "100000", "--repeats", "1"]
    # In proportion to the number of points, as it was from the first to the second.
    assert space.main([*arguments, "--budget", "0.12"]) == 1
    assert [len(points) for points in asked][:4] == [2_000, 2_000, 10_000, 10_000]
    assert "expected 0 s" in capsys.readouterr().out  # 0.15 s for 30,000 points
    assert max(len(points) for points in asked) == 10_000
    seconds = iter([0.01, 0.05])
    assert space.main([*arguments, "--budget", "0.18"]) == 1
    assert max(len(points) for points in asked) == 100_000  # its turns were quick
