"""``python -m benchmarks.view``: how heavy the pages are, how soon they load and answer.

Measured in headless Chromium, which draws by the processor alone (SwiftShader): slower than
any laptop with a GPU.
"""

from __future__ import annotations

import argparse
import os
import shutil
import statistics
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

import alphamesh as am

__all__ = ["Row", "main", "measure", "table"]

_BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
_SWITCHES = ("--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
_SIZES = {2: (1_000, 50_000, 100_000, 500_000), 3: (1_000, 20_000)}
_TINY = {2: (200,), 3: (100,)}
# From moving the slider until the last pixel is there: reading one waits for all.
_ANSWERS = """
(count) => {
  const gl = alphamesh.stage.gl, pixel = new Uint8Array(4), times = [];
  const slider = document.querySelector(".track input");
  for (let i = 0; i <= count; i++) {
    const start = performance.now();
    slider.value = String((Number(slider.max) * i) / count);
    slider.dispatchEvent(new Event("input"));
    alphamesh.drawNow();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    times.push(performance.now() - start);
  }
  return times;
}
"""


@dataclass(frozen=True, slots=True)
class Row:
    """What was measured for one cloud; times in seconds."""

    columns: int
    points: int
    size: int
    writing: float
    loading: float
    median: float
    slowest: float


def measure(
    sizes: dict[int, Sequence[int]], *, repeats: int = 3, positions: int = 40
) -> list[Row]:
    """Write pages of uniform clouds, load them, and move their sliders."""
    from playwright.sync_api import sync_playwright

    rows = []
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as player:
        browser = player.chromium.launch(executable_path=_executable(), args=list(_SWITCHES))
        for columns, counts in sizes.items():
            for count in counts:
                file = Path(folder) / f"page-{columns}-{count}.html"
                writing = _write(file, columns, count)
                visits = [_visit(browser, file, positions) for _ in range(repeats)]
                answers = [np.median(times) for _, times in visits]
                rows.append(
                    Row(
                        columns,
                        count,
                        file.stat().st_size,
                        writing,
                        statistics.median(loading for loading, _ in visits),
                        float(min(answers)),
                        min(max(times) for _, times in visits),
                    )
                )
        browser.close()
    return rows


def _executable() -> str:
    found = os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, _BROWSERS)), None)
    if found is None:
        sys.exit("there is no Chromium: apt-get install chromium, or set CHROMIUM to its path")
    return found


def _write(file: Path, columns: int, count: int) -> float:
    cx = am.AlphaComplex(np.random.default_rng(1).random((count, columns)))
    start = time.perf_counter()
    cx.view(file)
    return time.perf_counter() - start


def _visit(browser: Any, file: Path, positions: int) -> tuple[float, list[float]]:
    """Return how long a page takes to show its first picture, and each answer."""
    page = browser.new_page(viewport={"width": 1280, "height": 800})
    page.goto(file.as_uri())
    page.wait_for_function("() => window.alphamesh", timeout=120_000)
    loading = page.evaluate("performance.now()") / 1000
    page.evaluate(_ANSWERS, 4)  # shaders are compiled when they are first used
    times = [value / 1000 for value in page.evaluate(_ANSWERS, positions)]
    page.close()
    return loading, times


def table(rows: Sequence[Row]) -> str:
    """Return the rows as a table in Markdown."""
    lines = [
        "| points | page, MB | written, s | loaded, s | slider answers, ms | at most, ms |",
        "|---|---|---|---|---|---|",
    ]
    lines += [
        f"| {row.points:,} in {row.columns}D | {row.size / 1e6:.1f} | {row.writing:.2f} | "
        f"{row.loading:.2f} | {row.median * 1e3:.0f} | {row.slowest * 1e3:.0f} |"
        for row in rows
    ]
    return "\n".join(lines)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line."""
    parser = argparse.ArgumentParser("python -m benchmarks.view", description=__doc__)
    parser.add_argument("--tiny", action="store_true", help="small clouds: a test of the tool")
    options = parser.parse_args(arguments)
    rows = measure(_TINY, repeats=1, positions=5) if options.tiny else measure(_SIZES)
    print(table(rows))


if __name__ == "__main__":
    main()
