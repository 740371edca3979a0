"""The benchmark of periodic boxes: it runs, and says what it left out."""

from __future__ import annotations

import importlib
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def test_tiny_run(monkeypatch, capsys):
    monkeypatch.syspath_prepend(str(ROOT))
    periodic = importlib.import_module("benchmarks.periodic")
    monkeypatch.setitem(sys.modules, "diode", None)  # a peer that is missing
    assert periodic.main(["--tiny"]) == 0
    printed = capsys.readouterr().out
    assert printed.count("left out: diode") == 4
    timed = re.findall(r"^ +ours  +([\d.]+)  +([\d.]+)$", printed, re.MULTILINE)
    assert len(timed) == 4
    assert all(float(middle) >= float(least) for middle, least in timed)
    assert "FAIL  diode over ours in space, 1,000: not measured" in printed
