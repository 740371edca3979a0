"""The option --weights: the column of a table that holds squared radii of balls."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from alphamesh.cli.types import ColumnType
from alphamesh.errors import FileReadError, ParameterError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from alphamesh.cli.inputs import InputOptions
    from alphamesh.table import PointTable

__all__ = ["weights_of", "weights_option"]

# Eager: what a radius may be depends on it.
weights_option = click.option(
    "--weights",
    type=ColumnType(),
    metavar="COLUMN",
    default=None,
    is_eager=True,
    help="Table: the column, by name or by number from 0, of the weights of the points: "
    "squared radii of balls, of any sign.  [default: balls of equal size]",
)


def weights_of(
    source: str, options: InputOptions, table: PointTable | None = None
) -> NDArray[Any] | None:
    """Return the column of weights that `options` name, None if they name none.

    Parameters
    ----------
    source : str
        A file of points.
    options : InputOptions
    table : PointTable, optional
        What is in the file, if it was read with all its columns.

    Raises
    ------
    ParameterError
        If there is no such column, or it does not hold numbers.
    """
    column = options.weights
    if column is None:
        return None
    if isinstance(column, int):
        return _numbered(source, options, column)
    if table is None:
        from alphamesh.io.points import read_table

        table = read_table(source, **options.table())
    if column not in table.columns:
        listed = ", ".join(map(repr, table.columns)) or "none that have names"
        raise ParameterError(
            f"--weights: there is no column {column!r} besides the coordinates; "
            f"there are: {listed}"
        )
    found = table.columns[column]
    if found.dtype.kind not in "iuf":
        raise ParameterError(f"--weights: the column {column!r} does not hold numbers alone")
    return found


def _numbered(source: str, options: InputOptions, column: int) -> NDArray[Any]:
    """Return the column of a number; tables are read by two columns at least."""
    from alphamesh.io.points import read_points

    given = options.table()
    chosen = given.pop("columns", None) or (0, 1)
    given.pop("dimension", None)
    beside = next(name for name in chosen if name != column)
    try:
        return read_points(source, columns=(column, beside), **given)[:, 0]
    except FileReadError as error:
        raise ParameterError(f"--weights {column}: {error}") from error
