"""``alphamesh filtration``: every simplex, and the radius from which on it is there."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from alphamesh.cli.building import Job, cloud_options, source_argument
from alphamesh.cli.command import Command
from alphamesh.cli.files import TableFile
from alphamesh.cli.outputs import Output, Outputs, check_targets, output_options
from alphamesh.cli.periods import periods_option
from alphamesh.cli.progress import Steps
from alphamesh.cli.summary import length_text
from alphamesh.cli.tables import write_table
from alphamesh.cli.types import MostRadius

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["command"]

_NAMES = (
    ("vertices", "vertex"),
    ("edges", "edge"),
    ("triangles", "triangle"),
    ("tetrahedra", "tetrahedron"),
)

_EXAMPLES = (
    "alphamesh filtration points.csv -o simplices.csv",
    "alphamesh filtration points.csv --max-radius 2 -o simplices.parquet",
    "alphamesh sample demo:annulus -o - | alphamesh filtration - --squared -o -",
)


@click.command("filtration", cls=Command, examples=_EXAMPLES)
@source_argument
@output_options(TableFile(".csv"), "Write the simplices here", name="tables")
@click.option(
    "--max-radius",
    type=MostRadius(),
    metavar="R",
    help="Leave out simplices that come later; at least 0 without --weights.  [default: none]",
)
@click.option("--squared", is_flag=True, help="Write squared radii, the values of GUDHI.")
@periods_option
@cloud_options
def command(
    source: str,
    tables: tuple[Path, ...],
    max_radius: float | None,
    squared: bool,
    **options: Any,
) -> None:
    """List every simplex and the radius from which on the complex has it.

    INPUT is a mask image, a file of points, "-" for standard input, or demo:NAME
    for a built-in shape. A table has one line for each simplex, in the order in
    which they come: dimension, its vertices as rows of INPUT counted from 0 (-1
    where there are fewer), and the radius; with --periods also how many periods
    the second and further vertices lie from their places in the box. NPZ has
    arrays for each dimension, and the points.
    """
    check_targets(tables, source)
    outputs = Outputs()
    with Steps(quiet=options["quiet"]) as steps:
        job = Job.begin(source, options, steps, space=True)
        found = _Simplices(job.complex.filtration, max_radius, squared)
        outputs.write([Output(path, found.write) for path in tables], steps)
    job.tell(*found.told(), outputs)


class _Simplices:
    """Simplices up to a radius, ready to be written."""

    def __init__(self, given: Any, most: float | None, squared: bool) -> None:
        self.given = given
        self.squared = squared
        kept = [
            np.ones(len(radii), dtype=bool) if most is None else radii <= most
            for radii in given.radii
        ]
        pairs = zip(given.simplices, kept, strict=True)
        self.simplices = [rows.compress(keep, axis=0) for rows, keep in pairs]
        values = zip(given.radii, kept, strict=True)
        self.radii = [radii.compress(keep) for radii, keep in values]
        offsets = getattr(given, "offsets", None)
        self.offsets: list[NDArray[np.int8]] | None = None
        if offsets is not None:
            moved = zip(offsets, kept, strict=True)
            self.offsets = [moves.compress(keep, axis=0) for moves, keep in moved]

    def told(self) -> tuple[dict[str, Any], dict[str, str]]:
        """Return how many there are, and when the last one comes."""
        counts = {
            plural: len(rows) for (plural, _), rows in zip(_NAMES, self.simplices, strict=False)
        }
        last = max((float(radii.max()) for radii in self.radii if len(radii)), default=0.0)
        lines = {name.capitalize(): f"{count:,}" for name, count in counts.items()}
        lines["Last comes at"] = length_text(last)
        return {**counts, "dimension": self.given.dimension, "last_radius": last}, lines

    def write(self, path: Path) -> None:
        """Write a table, or all arrays."""
        if path.suffix.lower() == ".npz":
            write_table(path, {}, self._arrays())
        else:
            write_table(path, self._columns())

    def _values(self) -> list[NDArray[np.float64]]:
        if not self.squared:
            return self.radii
        from alphamesh._weights import signed_square

        return [signed_square(radii) for radii in self.radii]

    def _columns(self) -> dict[str, NDArray[Any]]:
        """Return one entry for each simplex; those of equal radius by dimension."""
        counts = [len(rows) for rows in self.simplices]
        dimension = np.repeat(np.arange(len(counts)), counts)
        values = np.concatenate(self._values())
        order = np.lexsort((dimension, values))
        columns: dict[str, NDArray[Any]] = {"dimension": dimension[order]}
        for corner in range(len(counts)):
            parts = [
                rows[:, corner] if corner < rows.shape[1] else np.full(len(rows), -1, np.int32)
                for rows in self.simplices
            ]
            columns[f"vertex_{corner}"] = np.concatenate(parts)[order]
        if self.offsets is not None:
            columns |= _offset_columns(self.offsets, order)
        columns["radius_squared" if self.squared else "radius"] = values[order]
        return columns

    def _arrays(self) -> dict[str, NDArray[Any]]:
        arrays: dict[str, NDArray[Any]] = {
            "points": self.given.points,
            "representative": self.given.representative,
        }
        if self.given.weights is not None:
            arrays |= {"weights": self.given.weights, "hidden": self.given.hidden}
        ending = "radii_squared" if self.squared else "radii"
        parts = zip(_NAMES, self.simplices, self._values(), strict=False)
        for (plural, singular), rows, values in parts:
            arrays[plural] = rows
            arrays[f"{singular}_{ending}"] = values
        if self.offsets is not None:
            names = (f"{singular}_offsets" for _, singular in _NAMES)
            arrays |= dict(zip(names, self.offsets, strict=False))
            arrays["positions"] = self.given.positions
            arrays["periods"] = np.array([side or np.inf for side in self.given.periods])
        return arrays


def _offset_columns(
    offsets: list[NDArray[np.int8]], order: NDArray[np.intp]
) -> dict[str, NDArray[Any]]:
    """Return how many periods each corner but the first lies from its place in the box."""
    columns = {}
    for corner in range(1, len(offsets)):
        for axis, name in zip(range(len(offsets) - 1), "xyz", strict=False):
            parts = [
                moves[:, corner, axis]
                if corner < moves.shape[1]
                else np.zeros(len(moves), np.int8)
                for moves in offsets
            ]
            columns[f"offset_{corner}_{name}"] = np.concatenate(parts)[order]
    return columns
