"""How often each rule's radius has the right topology in space: solids and surfaces.

Run by ``python -m benchmarks.accuracy --columns 3``. Solids of known Betti numbers are drawn
on a grid of voxels and sampled uniformly, with Gaussian noise of a quarter of the spacing,
and with 2 % outliers. Surfaces are those of the demo solids.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

import alphamesh as am
from alphamesh.sampling import add_noise, add_outliers
from benchmarks.accuracy import Outcome, accuracy_table, clear_sentence
from benchmarks.mask_clouds import NOISE, MaskCloud, outliers_of
from benchmarks.solid_masks import DEVELOPMENT, REPORT, SIZE, Region, draw_solid, solid_room

__all__ = ["HALVES", "measure_solids", "measure_surfaces", "report_in_space", "sample_solid"]

HALVES = {"develop": tuple(DEVELOPMENT), "report": tuple(REPORT)}
RIVALS = ("all-points", "one-region", "regions")
_KINDS = ("uniform", "noise", "outliers")
_SURFACES = "surfaces"


def measure_solids(
    families: Iterable[str], seeds: Iterable[int], sizes: Sequence[int], size: int = SIZE
) -> Iterator[Outcome]:
    """Try every rule on clouds of every kind and size, of one solid per family and seed."""
    seeds = list(seeds)
    for family in families:
        for seed in seeds:
            solid, betti = draw_solid(family, seed, size)
            wide = solid_room(solid, betti, math.ceil(_spacing(solid, min(sizes)) * 2))
            for kind in _KINDS:
                for n in sizes:
                    rng = np.random.default_rng([seed, n, _KINDS.index(kind), *family.encode()])
                    points = sample_solid(solid, n, kind, rng)
                    apart = _spacing(solid, n)
                    resolved = wide[0] >= apart * _void(n) and wide[1] >= apart / 2
                    outliers = outliers_of(kind, n)
                    yield _outcome(
                        (family, kind), points, betti, resolved=resolved, outliers=outliers
                    )


def measure_surfaces(seeds: Iterable[int], sizes: Sequence[int]) -> Iterator[Outcome]:
    """Try every rule on samples of the surfaces of the demo solids.

    Whether these are resolved is not known.
    """
    seeds = list(seeds)
    for name, solid in am.DEMO_SOLIDS.items():
        shells, handles = len(solid.genera), sum(solid.genera)
        for n in sizes:
            for seed in seeds:
                points = am.sample_solid(name, n, seed=seed, surface=True)
                betti = (shells, 2 * handles, shells)
                yield _outcome((name, _SURFACES), points, betti, resolved=False)


def _outcome(
    name: tuple[str, str],
    points: NDArray[np.float64],
    betti: tuple[int, ...],
    *,
    resolved: bool,
    outliers: int = 0,
) -> Outcome:
    cloud = MaskCloud.of(points, outliers)
    choice = am.choose_radius(cloud.filtration)
    right = {choice.rule} if choice.betti == betti else set()
    for rule in RIVALS:
        options = {"regions": betti[0]} if rule == "regions" else {}
        radius = am.choose_radius(cloud.filtration, rule, **options).radius
        if cloud.at(radius) == betti:
            right.add(rule)
    possible = cloud.succeeds(betti)
    return Outcome(*name, len(points), possible, resolved, choice.clear, frozenset(right))


def sample_solid(
    solid: Region, n: int, kind: str, rng: np.random.Generator
) -> NDArray[np.float64]:
    """Draw n points of a solid, spoilt as `kind` says; outliers are the last rows."""
    voxels = np.argwhere(solid)
    extra = outliers_of(kind, n)
    points = voxels[rng.integers(len(voxels), size=n - extra)] + rng.random((n - extra, 3))
    if kind == "noise":
        return add_noise(points, NOISE * _spacing(solid, n), seed=rng)
    return add_outliers(points, extra, seed=rng) if extra else points


def _spacing(solid: Region, n: int) -> float:
    return float((np.count_nonzero(solid) / n) ** (1 / 3))


def _void(n: int) -> float:
    """Return the radius of the largest empty ball in a random sample, in mean spacings.

    This is where half a void is left of those of a sample of n points, see the rule.
    """
    low, high = 0.0, 100.0
    for _ in range(60):
        c = (low + high) / 2
        left = n * 3 * math.pi**2 / 16 * (1 + c + c * c / 2) * math.exp(-c)
        low, high = (c, high) if left > 0.5 else (low, c)
    return (low * 3 / (4 * math.pi)) ** (1 / 3)


def report_in_space(outcomes: Sequence[Outcome], half: str) -> str:
    """Return the tables in Markdown."""
    solids = [o for o in outcomes if o.kind != _SURFACES]
    surfaces = [o for o in outcomes if o.kind == _SURFACES]
    sizes = sorted({o.n for o in solids})
    families = sorted({o.family for o in solids})
    intro = (
        f"{len(solids):,} clouds of solids of the half *{half}* ({', '.join(families)}), and "
        f"{len(surfaces):,} of the surfaces of the demo solids. The columns are those of the "
        "table for the plane; it was not looked at which surfaces are resolved."
    )
    rows = [
        (kind, f"{n:,}", [o for o in solids if o.kind == kind and o.n == n])
        for kind in _KINDS
        for n in sizes
    ]
    rows += [
        (_SURFACES, f"{n:,}", [o for o in surfaces if o.n == n])
        for n in sorted({o.n for o in surfaces})
    ]
    return "\n\n".join((intro, accuracy_table(rows, RIVALS), clear_sentence(outcomes)))
