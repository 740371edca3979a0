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
    for name in ("all values", "all values, 1 thread", "bare", "bare, 1 thread"):
        seconds = re.search(rf"^ +{name}  +([\d.]+)  +([\d.]+)$", printed, re.MULTILINE)
        assert seconds is not None
        assert float(seconds[1]) >= float(seconds[2])
    assert "FAIL  diode over all values, 1,000: not measured" in printed
    assert "pass  peak memory beyond the input" in printed
