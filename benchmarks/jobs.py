"""What is measured: one job for alphamesh or a peer, from a NumPy array to its result."""

from __future__ import annotations

import importlib
import importlib.metadata
import os
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from benchmarks.clouds import Points

__all__ = [
    "FILTRATION",
    "JOBS",
    "OURS",
    "TRIANGULATION",
    "Job",
    "Run",
    "available",
    "space",
    "version",
]

Run = Callable[[Points], object]

TRIANGULATION = "triangulation"
FILTRATION = "triangulation and filtration"


@dataclass(frozen=True, slots=True)
class Job:
    """One thing to measure.

    Attributes
    ----------
    name : str
        How `--jobs` calls it.
    package : str
        The distribution whose version is reported.
    call : str
        The Python expression that is measured, for the reader.
    makes : str
        `TRIANGULATION` or `FILTRATION`.
    load : callable
        Imports the library and returns the function to measure. Raises ``ImportError``
        where the library is missing.
    """

    name: str
    package: str
    call: str
    makes: str
    load: Callable[[], Run]


def _filtration(threads: int | None) -> Callable[[], Run]:
    def load() -> Run:
        filtration = importlib.import_module("alphamesh.filtration").filtration
        return lambda points: filtration(points, threads=threads)

    return load


def _delaunay(threads: int | None) -> Callable[[], Run]:
    def load() -> Run:
        delaunay = importlib.import_module("alphamesh.delaunay").delaunay
        return lambda points: delaunay(points, threads=threads)

    return load


def space(what: str, threads: int | None, *, core: bool = False) -> Callable[[], Run]:
    """Return what loads a job in space: "filtration" or "delaunay".

    With `core`, the compiled function alone; otherwise the public one, which also looks at
    its input and makes the object that users get.
    """

    def load() -> Run:
        kernels = importlib.import_module("alphamesh._kernels._core")
        call = {"filtration": kernels.alpha3, "delaunay": kernels.delaunay3}[what]
        return lambda points: call(points, threads or os.cpu_count() or 1, None)

    public = {"filtration": _filtration, "delaunay": _delaunay}[what](threads)
    return load if core else public


def _scipy() -> Run:
    delaunay: Run = importlib.import_module("scipy.spatial").Delaunay
    return delaunay


def _shull(parallel: bool) -> Callable[[], Run]:
    def load() -> Run:
        delaunay = importlib.import_module("shull").Delaunay
        return lambda points: delaunay(points, parallel=parallel)

    return load


def _gudhi() -> Run:
    alpha_complex = importlib.import_module("gudhi").AlphaComplex
    return lambda points: alpha_complex(points=points).create_simplex_tree()


def _diode() -> Run:
    diode = importlib.import_module("diode")
    # Older releases have only the call that makes one Python object per simplex.
    fill: Run = getattr(diode, "fill_alpha_shapes_arrays", diode.fill_alpha_shapes)
    return fill


OURS = ("alphamesh", "alphamesh-1", "alphamesh-delaunay")

JOBS: dict[str, Job] = {
    job.name: job
    for job in (
        Job("alphamesh", "alphamesh", "alphamesh.filtration(P)", FILTRATION, _filtration(None)),
        Job(
            "alphamesh-1",
            "alphamesh",
            "alphamesh.filtration(P, threads=1)",
            FILTRATION,
            _filtration(1),
        ),
        Job(
            "alphamesh-delaunay",
            "alphamesh",
            "alphamesh.delaunay(P)",
            TRIANGULATION,
            _delaunay(None),
        ),
        Job("shull", "shull", "shull.Delaunay(P)", TRIANGULATION, _shull(False)),
        Job(
            "shull-parallel",
            "shull",
            "shull.Delaunay(P, parallel=True)",
            TRIANGULATION,
            _shull(True),
        ),
        Job("scipy", "scipy", "scipy.spatial.Delaunay(P)", TRIANGULATION, _scipy),
        Job("diode", "diode", "diode.fill_alpha_shapes_arrays(P)", FILTRATION, _diode),
        Job(
            "gudhi",
            "gudhi",
            "gudhi.AlphaComplex(points=P).create_simplex_tree()",
            FILTRATION,
            _gudhi,
        ),
    )
}


def available(names: Iterable[str]) -> tuple[dict[str, Run], dict[str, str]]:
    """Load the jobs `names`.

    Returns
    -------
    runs : dict of str to callable
        The functions to measure, in the order of `names`.
    left_out : dict of str to str
        Why each of the other jobs cannot run.
    """
    runs: dict[str, Run] = {}
    left_out: dict[str, str] = {}
    for name in names:
        try:
            runs[name] = JOBS[name].load()
        except ImportError as error:
            left_out[name] = f"{JOBS[name].package} cannot be imported ({error})"
    return runs, left_out


def version(library: str) -> str:
    """Return the version of an installed distribution, "source tree" if it is not installed."""
    try:
        return importlib.metadata.version(library)
    except importlib.metadata.PackageNotFoundError:
        return "source tree"
