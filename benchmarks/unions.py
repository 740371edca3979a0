"""``python -m benchmarks.unions``: measures of unions of balls, beside shapely and biotite.

In the plane the area of a union of discs, where shapely unites polygons of 64 corners; in
space the surface of balls as large as atoms, where biotite counts dots, 1,000 on each.
Ours are exact up to rounding, and tell holes and voids, too; each is measured on a filtration
that stands, which is timed as well. Ends with the promised ratios, pass or fail.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from importlib import import_module
from statistics import median
from typing import TypeAlias

import numpy as np

from benchmarks.clouds import Points
from benchmarks.contest import measured, options_of
from benchmarks.verdict import Criterion

__all__ = ["main"]

Run: TypeAlias = Callable[[], float]

_FILTRATION, _UNION = "filtration", "union of it"
# Radii of atoms, and of a molecule of water, in angstroms.
_ATOMS, _PROBE = (1.2, 1.52, 1.55, 1.7), 1.4
# Atoms in a cubic angstrom.
_DENSITY = 0.1


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; 1 if a promise is broken."""
    options = options_of("unions", arguments)
    criteria = []
    for name, runs in (
        ("discs", dict(_discs(options.size, options.threads))),
        ("atoms", dict(_atoms(options.size, options.threads))),
    ):
        taken = measured(f"{options.size:,} {name}", runs, options.rounds, _error_of(runs))
        ratio, of_minima = (
            best(taken[_UNION]) / best(taken[_FILTRATION]) for best in (median, min)
        )
        what = f"{_UNION} over {_FILTRATION}, {name}"
        criteria.append(Criterion(what, ratio, 2.0, False, of_minima))
    print()
    for criterion in criteria:
        print(criterion)
    return 0 if options.tiny or all(criterion.passed for criterion in criteria) else 1


def _discs(size: int, threads: int) -> Iterator[tuple[str, Run]]:
    """Discs that cover about half of the unit square."""
    points: Points = np.random.default_rng(1).random((size, 2))
    radius = float(np.sqrt(0.7 / (np.pi * size)))
    yield from _ours(points, None, radius, "area", threads)
    try:
        shapely = import_module("shapely")
    except ImportError as error:
        print(f"left out: shapely: {error}")
        return

    def unite() -> float:
        discs = shapely.buffer(shapely.points(points), radius, quad_segs=16)
        return float(shapely.union_all(discs).area)

    yield "shapely, of polygons", unite


def _atoms(size: int, threads: int) -> Iterator[tuple[str, Run]]:
    """Atoms at random, as close as those of a protein, and what a solvent touches."""
    rng = np.random.default_rng(1)
    points: Points = rng.random((size, 3)) * (size / _DENSITY) ** (1 / 3)
    radii = rng.choice(_ATOMS, size)
    yield from _ours(points, (radii + _PROBE) ** 2, 0.0, "surface_area", threads)
    try:
        structure = import_module("biotite.structure")
    except ImportError as error:
        print(f"left out: biotite: {error}")
        return

    def count() -> float:
        atoms = structure.AtomArray(size)
        atoms.coord = points.astype(np.float32)
        areas = structure.sasa(
            atoms, probe_radius=_PROBE, vdw_radii=radii, point_number=1000, ignore_ions=False
        )
        return float(np.nansum(areas))

    yield "biotite, of dots", count


def _ours(
    points: Points, weights: Points | None, radius: float, measure: str, threads: int
) -> Iterator[tuple[str, Run]]:
    filtration = import_module("alphamesh.filtration").filtration
    union_of_balls = import_module("alphamesh.unions").union_of_balls
    made = filtration(points, weights=weights, threads=threads)

    def build() -> float:
        filtration(points, weights=weights, threads=threads)
        return float("nan")

    yield _FILTRATION, build
    yield _UNION, lambda: float(getattr(union_of_balls(made, radius, threads=threads), measure))


def _error_of(runs: Mapping[str, Run]) -> Callable[[str], str]:
    """Return what tells how far the result of a peer is from ours."""
    exact = runs[_UNION]()

    def error(key: str) -> str:
        if key in (_FILTRATION, _UNION):
            return ""
        return f"  {abs(runs[key]() / exact - 1):8.1e} off"

    return error


if __name__ == "__main__":
    raise SystemExit(main())
