"""The benchmark of tiles compares, measures, and writes its figures into the page."""

from __future__ import annotations

import importlib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent

PAGE = """# Tiles

<!-- tile-runs:begin -->
<!-- tile-runs:end -->
<!-- tile-costs-3:begin -->
<!-- tile-costs-3:end -->
"""


@pytest.fixture(name="tiles")
def import_tiles(monkeypatch):
    pytest.importorskip("psutil")
    pytest.importorskip("pyarrow")
    monkeypatch.syspath_prepend(str(ROOT))
    return importlib.import_module("benchmarks.tiles")


def test_figures_are_written_into_the_page(tiles, tmp_path, capsys):
    page = tmp_path / "tiles.md"
    page.write_text(PAGE)
    write = ["--folder", str(tmp_path), "--write-docs", str(tmp_path)]
    for options in (["--threads", "2"], ["--threads", "1"], ["--threads", "2"]):
        assert tiles.main(["--tiny", *options, *write]) == 0
    assert capsys.readouterr().out.count("bit for bit: yes") == 3
    rows = [line for line in page.read_text().splitlines() if line.startswith("| the plane")]
    assert len(rows) == 2
    assert all("60,000" in row for row in rows)
    assert {row.split("|")[4].strip() for row in rows} == {"1 thread", "2 threads"}


def test_costs_are_written_into_the_page(tiles, tmp_path):
    page = tmp_path / "tiles.md"
    page.write_text(PAGE)
    options = ["--tiny", "--costs", "--dimension", "3", "--tile-points", "3000"]
    assert tiles.main([*options, "--write-docs", str(tmp_path)]) == 0
    text = page.read_text()
    assert "| triangulation, values, what belongs to whom, borders |" in text
    halo = next(line for line in text.splitlines() if line.startswith("| halo"))
    assert float(halo.split("|")[2].rstrip("% ")) > 10
