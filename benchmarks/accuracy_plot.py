"""``python -m benchmarks.accuracy_plot FILE``: clouds that the rule got right, and wrong.

The first of each kind, in the order of families and seeds: nothing is picked by hand.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

import alphamesh as am
from benchmarks.mask_clouds import KINDS, sample_cloud
from benchmarks.masks import REPORT, draw_mask

__all__ = ["main"]

_POINTS = 1_000
_SEEDS = range(100, 140)  # other masks than those of the tables


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line."""
    import matplotlib as mpl

    mpl.use("Agg")
    import matplotlib.pyplot as plt

    parser = argparse.ArgumentParser("python -m benchmarks.accuracy_plot")
    parser.add_argument("file", type=Path, help="picture to write (PNG, SVG, PDF)")
    options = parser.parse_args(arguments)
    figure, axes = plt.subplots(2, len(KINDS), figsize=(12, 6.6))
    for column, kind in zip(axes.T, KINDS, strict=True):
        for ax, right in zip(column, (True, False), strict=True):
            _draw(ax, *_first(kind, right))
    figure.tight_layout()
    figure.savefig(options.file, dpi=90)
    return 0


def _first(kind: str, right: bool) -> tuple[str, Any, tuple[int, int]]:
    """Return the first cloud of a kind that the rule gets right, or wrong."""
    for seed, family in _turns():
        mask, betti = draw_mask(family, seed)
        rng = np.random.default_rng([seed, KINDS.index(kind), *family.encode()])
        cx = am.AlphaComplex(sample_cloud(mask, _POINTS, kind, rng))
        if (cx.choose_radius().betti == betti) == right:
            return kind, cx, betti
    raise SystemExit(f"no cloud of the kind {kind} is {'right' if right else 'wrong'}")


def _turns() -> Iterator[tuple[int, str]]:
    """Take the families in turns, another one first for each seed."""
    names = list(REPORT)
    for seed in _SEEDS:
        for k in range(len(names)):
            yield seed, names[(seed + k) % len(names)]


def _draw(ax: Any, kind: str, cx: Any, betti: tuple[int, int]) -> None:
    choice = cx.choose_radius()
    points, shape = cx.points, cx.at(choice.radius)
    if len(shape.triangles):
        ax.triplot(*points.T, shape.triangles, color="tab:blue", lw=0.5)
    ax.plot(*points.T, ".", color="black", ms=1.2)
    ax.set_aspect("equal")
    ax.set_axis_off()
    clear = "" if choice.clear else ", unclear"
    title = f"{kind}: {_numbers(betti)}"
    found = "found" if choice.betti == betti else f"taken for {_numbers(choice.betti)}"
    ax.set_title(f"{title}\n{found}{clear}", fontsize=9)


def _numbers(betti: tuple[int, int]) -> str:
    return f"{betti[0]} comp., {betti[1]} holes"


if __name__ == "__main__":
    raise SystemExit(main())
