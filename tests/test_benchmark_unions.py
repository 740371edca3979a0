"""The benchmark of unions of balls: it runs, compares, and says what it left out."""

from __future__ import annotations

import importlib
import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent


@pytest.fixture(name="unions")
def import_unions(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT))
    return importlib.import_module("benchmarks.unions")


def test_tiny_run(unions, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "biotite", None)  # a peer that is missing
    monkeypatch.setitem(sys.modules, "biotite.structure", None)
    assert unions.main(["--tiny"]) == 0
    printed = capsys.readouterr().out
    assert "left out: biotite" in printed
    for name in ("filtration", "union of it"):
        rows = re.findall(rf"^ +{name}  +([\d.]+)  +([\d.]+)$", printed, re.MULTILINE)
        assert len(rows) == 2
        assert all(0 < float(least) <= float(middle) for middle, least in rows)
    if importlib.util.find_spec("shapely"):
        polygons = re.search(r"shapely, of polygons  +[\d.]+  +[\d.]+  +([\d.e+-]+)", printed)
        # Polygons of 64 corners within discs: pi / 32 squared over 6 of an area is missing.
        assert polygons is not None and 1e-4 < float(polygons[1]) < 1.7e-3
    assert printed.count("union of it over filtration") == 2
