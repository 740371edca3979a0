"""The figure of the documentation: time per point by size, one panel a cloud, and memory."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from benchmarks.jobs import FILTRATION, JOBS, OURS
from benchmarks.results import Results

__all__ = ["save_figure"]

# Okabe and Ito's palette: distinct for colour-blind readers too.
_COLORS = {
    "alphamesh": "#0072B2",
    "alphamesh-1": "#56B4E9",
    "alphamesh-delaunay": "#009E73",
    "shull": "#E69F00",
    "shull-parallel": "#D55E00",
    "scipy": "#999999",
    "diode": "#CC79A7",
    "gudhi": "#000000",
}
_COLUMNS = 3


def save_figure(results: Results, path: Path) -> None:
    """Draw the results into an image file, its format told by the name."""
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot

    # Without these an SVG of the same numbers would differ at every run.
    with mpl.rc_context({"svg.hashsalt": "alphamesh", "font.size": 9}):
        clouds = results.clouds()
        rows = -(-(len(clouds) + 1) // _COLUMNS)
        figure, axes = pyplot.subplots(
            rows, _COLUMNS, figsize=(4 * _COLUMNS, 3.2 * rows), squeeze=False,
            layout="constrained",
        )  # fmt: skip
        panels = axes.ravel()
        for cloud, panel in zip(clouds, panels, strict=False):
            _draw_times(panel, results, cloud)
        _share_limits(panels[: len(clouds)])
        _draw_memory(panels[len(clouds)], results)
        for panel in panels[len(clouds) + 1 :]:
            panel.set_axis_off()
        handles, labels = panels[0].get_legend_handles_labels()
        if handles:
            figure.legend(
                handles, labels, loc="outside lower center", ncols=len(labels), frameon=False,
                title="solid: with all filtration values; dashed: triangulation alone",
            )  # fmt: skip
        metadata = {"Date": None} if path.suffix == ".svg" else {}
        figure.savefig(path, metadata=metadata)
        pyplot.close(figure)


def _draw_times(axes: Any, results: Results, cloud: str) -> None:
    for job in results.jobs():
        timings = [t for n in results.sizes() if (t := results.timing(job, cloud, n))]
        axes.plot(
            [timing.size for timing in timings],
            [1e6 * timing.per_point for timing in timings],
            color=_COLORS[job],
            marker="o",
            markersize=3.5,
            linewidth=2.2 if job in OURS else 1.2,
            linestyle="-" if JOBS[job].makes == FILTRATION else "--",
            label=job,
        )
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_title(cloud, fontsize="medium")
    axes.set_xlabel("points")
    axes.set_ylabel("µs per point (median)")
    axes.grid(which="major", color="0.9", linewidth=0.6)


def _share_limits(panels: Any) -> None:
    """Give all panels the limits of the widest, so that they can be compared."""
    lows, highs = zip(*(panel.get_ylim() for panel in panels), strict=True)
    for panel in panels:
        panel.set_ylim(min(lows), max(highs))


def _draw_memory(axes: Any, results: Results) -> None:
    runs = [run for run in results.fresh if run.cloud == "uniform"]
    size = max((run.size for run in runs), default=0)
    shown = [run for run in runs if run.size == size]
    if not shown:
        axes.set_axis_off()
        return
    names = [run.job for run in shown]
    values = [run.bytes_per_point for run in shown]
    axes.barh(names, values, color=[_COLORS[name] for name in names])
    axes.invert_yaxis()
    axes.set_title(f"peak memory, {size:,} uniform points", fontsize="medium")
    axes.set_xlabel("bytes per point beyond the input")
