"""``python -m benchmarks.accuracy``: how often each rule's radius has the right topology.

Masks of known components and holes are drawn and sampled in four ways: uniformly; with a
density that varies by a factor of 4 across the shape; with Gaussian noise of a quarter of
the spacing; with 2 % outliers. A rule succeeds if the complex at its radius has the mask's
numbers of components and holes. Components that hold outliers alone do not count for the
other rules; ``"topology"`` has to say itself which pieces are strays.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import alphamesh as am
from benchmarks.mask_clouds import KINDS, MaskCloud, outliers_of, sample_cloud, spacing
from benchmarks.masks import DEVELOPMENT, REPORT, Region, draw_mask, room
from benchmarks.tables import replace_between_markers

__all__ = [
    "RIVALS",
    "Outcome",
    "accuracy_table",
    "clear_sentence",
    "main",
    "measure",
    "report",
]

_HALVES: Mapping[str, Sequence[str]] = {"develop": tuple(DEVELOPMENT), "report": tuple(REPORT)}
_SIZES = (300, 1_000, 3_000, 10_000)
_TINY_SIZES = (300, 1_000)
_TOPOLOGY = "topology"
RIVALS = ("longest-interval", "all-points", "one-region", "regions")
# Sparsest density over the mean, where it varies by a factor of 4: log(4) / (4 - 1).
_SPARSEST = math.log(4) / 3


@dataclass(frozen=True)
class Outcome:
    """What became of one cloud.

    Attributes
    ----------
    family, kind : str
    n : int
    possible : bool
        Whether some radius gives the mask's numbers.
    resolved : bool
        Whether no feature of the mask is so fine that a random sample hides it.
    clear : bool
        Whether "topology" called its own answer clear.
    right : frozenset of str
        The rules whose radius gives the mask's numbers.
    """

    family: str
    kind: str
    n: int
    possible: bool
    resolved: bool
    clear: bool
    right: frozenset[str]


def measure(
    families: Iterable[str], seeds: Iterable[int], sizes: Sequence[int]
) -> Iterator[Outcome]:
    """Try every rule on clouds of every kind and size, of one mask per family and seed."""
    seeds = list(seeds)
    for family in families:
        for seed in seeds:
            mask, betti = draw_mask(family, seed)
            widest = math.ceil(spacing(mask, min(sizes)) * _void(min(sizes), "density"))
            wide = room(mask, betti, widest)
            for kind in KINDS:
                for n in sizes:
                    key = [seed, n, KINDS.index(kind), *family.encode()]
                    points = sample_cloud(mask, n, kind, np.random.default_rng(key))
                    cloud = MaskCloud.of(points, outliers_of(kind, n))
                    right, clear = _right_rules(cloud, betti)
                    yield Outcome(
                        family,
                        kind,
                        n,
                        cloud.succeeds(betti),
                        _resolved(mask, wide, n, kind),
                        clear,
                        right,
                    )


def _right_rules(cloud: MaskCloud, betti: tuple[int, int]) -> tuple[frozenset[str], bool]:
    choice = am.choose_radius(cloud.filtration, _TOPOLOGY)
    right = {_TOPOLOGY} if choice.betti == betti else set()
    for rule in RIVALS:
        options = {"regions": betti[0]} if rule == "regions" else {}
        radius = am.choose_radius(cloud.filtration, rule, **options).radius
        if cloud.at(radius) == betti:
            right.add(rule)
    return frozenset(right), choice.clear


def _resolved(mask: Region, wide: tuple[int, int], n: int, kind: str) -> bool:
    """Return whether holes and gaps are larger than chance voids, and bands than spacings."""
    apart = spacing(mask, n)
    return wide[0] >= apart * _void(n, kind) and wide[1] >= apart / 2


def _void(n: int, kind: str) -> float:
    """Return the radius of the largest empty disc in a random sample, in mean spacings.

    A sample of n points has ``n (1 + c) exp(-c)`` such discs with room for c points or
    more; this is where half a disc is left.
    """
    low, high = 0.0, 100.0
    for _ in range(60):
        c = (low + high) / 2
        low, high = (c, high) if n * (1 + c) * math.exp(-c) > 0.5 else (low, c)
    return math.sqrt(low / math.pi / (_SPARSEST if kind == "density" else 1.0))


# ---------------------------------------------------------------------- the report


def report(outcomes: Sequence[Outcome], half: str) -> str:
    """Return the tables in Markdown."""
    families = sorted({o.family for o in outcomes})
    sizes = sorted({o.n for o in outcomes})
    large = [o for o in outcomes if o.n >= 1_000] or list(outcomes)
    together = "≥ 1,000" if sizes[-1] >= 1_000 else "all"
    per_cell = len(outcomes) // max(len(sizes) * len(KINDS) * len(families), 1)
    intro = (
        f"{len(outcomes):,} clouds: {per_cell} masks of each family of the half "
        f"*{half}* ({', '.join(families)}), each sampled once for each kind and n. "
        "*Possible*: clouds for which some radius gives the mask's components and holes. "
        "The rules: percent of these that they get right. *Resolved*: percent of the "
        "clouds in which no hole, gap or band of the mask is so fine that a random sample "
        "hides it, and what `topology` gets right of these."
    )
    return "\n\n".join(
        (
            intro,
            accuracy_table([(kind, together, _of(large, kind=kind)) for kind in KINDS]),
            accuracy_table(
                [
                    (kind, f"{n:,}", _of(outcomes, kind=kind, n=n))
                    for kind in KINDS
                    for n in sizes
                ]
            ),
            clear_sentence(large),
        )
    )


def _of(outcomes: Iterable[Outcome], *, kind: str, n: int | None = None) -> list[Outcome]:
    return [o for o in outcomes if o.kind == kind and n in (None, o.n)]


def accuracy_table(
    rows: Iterable[tuple[str, str, list[Outcome]]], rivals: Sequence[str] = RIVALS
) -> str:
    """Return a table with a row for each kind and size of clouds, and its outcomes."""
    rules = (_TOPOLOGY, *rivals)
    head = ["cloud", "n", "clouds", "possible", *(f"`{rule}`" for rule in rules)]
    lines = [[*head, "resolved", "of these"], ["---", *["--:"] * (len(head) + 1)]]
    for kind, n, outcomes in rows:
        possible = [o for o in outcomes if o.possible]
        resolved = [o for o in outcomes if o.resolved]
        shares = [_percent(possible, lambda o, rule=rule: rule in o.right) for rule in rules]
        shares[0] = f"**{shares[0]}**"
        lines.append(
            [
                kind,
                n,
                f"{len(outcomes):,}",
                _percent(outcomes, lambda o: o.possible),
                *shares,
                _percent(outcomes, lambda o: o.resolved),
                _percent(resolved, lambda o: _TOPOLOGY in o.right),
            ]
        )
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def _percent(outcomes: Sequence[Outcome], holds: Callable[[Outcome], bool]) -> str:
    if not outcomes:
        return "-"
    return f"{100 * sum(map(holds, outcomes)) / len(outcomes):.1f}"


def clear_sentence(outcomes: Sequence[Outcome]) -> str:
    """Return how often the answers that "topology" calls clear are right."""
    clear = [o for o in outcomes if o.clear]
    unclear = [o for o in outcomes if not o.clear]
    return (
        f"`topology` called {_percent(outcomes, lambda o: o.clear)} % of its answers clear, "
        f"and {_percent(clear, lambda o: _TOPOLOGY in o.right)} % of these were right; of "
        f"the others, {_percent(unclear, lambda o: _TOPOLOGY in o.right)} %."
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line."""
    parser = argparse.ArgumentParser(
        "python -m benchmarks.accuracy",
        description="Measure how often the radius of each rule has the right topology.",
    )
    add = parser.add_argument
    add("--tiny", action="store_true", help="few small clouds, in seconds")
    add("--half", choices=sorted(_HALVES), default="report", help="which half of the shapes")
    add("--columns", type=int, choices=(2, 3), default=2, help="in the plane or in space")
    add("--masks", type=int, default=40, help="masks or solids of each family (default 40)")
    add("--first", type=int, default=0, help="seed of the first mask")
    add("--write-docs", type=Path, metavar="DIR", help="put the tables into radius.md in DIR")
    options = parser.parse_args(arguments)
    masks, sizes = (1, _TINY_SIZES) if options.tiny else (options.masks, _SIZES)
    seeds = range(options.first, options.first + masks)
    if options.columns == 3:
        text, markers = _in_space(options.half, seeds, sizes[1:]), "benchmark-space"
    else:
        text = report(list(measure(_HALVES[options.half], seeds, sizes)), options.half)
        markers = "benchmark"
    if options.write_docs:
        replace_between_markers(options.write_docs / "radius.md", text, markers)
    print(text)
    return 0


def _in_space(half: str, seeds: Sequence[int], sizes: Sequence[int]) -> str:
    from benchmarks import accuracy_space as space

    outcomes = [
        *space.measure_solids(space.HALVES[half], seeds, sizes),
        *space.measure_surfaces(seeds[: max(1, len(seeds) // 3)], sizes[:2]),
    ]
    return space.report_in_space(outcomes, half)


if __name__ == "__main__":
    raise SystemExit(main())
