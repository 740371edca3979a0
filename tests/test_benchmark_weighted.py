"""The benchmark of weighted clouds: it runs, and says what it left out."""

from __future__ import annotations

import importlib
import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent


@pytest.fixture(name="weighted")
def import_weighted(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT))
    return importlib.import_module("benchmarks.weighted")


def test_tiny_run(weighted, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "diode", None)  # a peer that is missing
    assert weighted.main(["--tiny"]) == 0
    printed = capsys.readouterr().out
    assert "left out: diode" in printed
    for name in ("weighted", "weighted, 1 thread", "no weights, 1 thread"):
        rows = re.findall(rf"^ +{name}  +([\d.]+)  +([\d.]+)$", printed, re.MULTILINE)
        assert len(rows) == len(weighted.WEIGHTS)
        assert all(0 < float(least) <= float(middle) for middle, least in rows)
    assert printed.count("gudhi safe over weighted") == 2 * len(weighted.WEIGHTS)
