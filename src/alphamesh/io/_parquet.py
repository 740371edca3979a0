"""Clouds in Parquet files, read by pyarrow: only the columns that are needed."""

from __future__ import annotations

from collections.abc import Mapping
from typing import IO, TYPE_CHECKING, Any

import numpy as np

from alphamesh.errors import FileReadError, MissingLibraryError, rows_text
from alphamesh.io._columns import Wanted, choose_columns, exact_floats, stack
from alphamesh.io._sources import Source

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray

__all__ = ["read_parquet", "write_parquet"]


def read_parquet(source: Source, wanted: Wanted) -> FloatArray:
    """Read the coordinates in a Parquet file.

    Parameters
    ----------
    source : Source
    wanted : Wanted
        As from :func:`wanted_columns`.

    Returns
    -------
    (n, dimension) float64 array

    Raises
    ------
    FileReadError
        If it is not a complete Parquet file, or a column is missing, holds no numbers
        or has empty cells.
    MissingLibraryError
        If pyarrow is not installed.
    """
    try:
        import pyarrow as pa
        import pyarrow.parquet as pq
    except ImportError as error:
        raise MissingLibraryError.of("pyarrow", "io", "reading Parquet files") from error
    with source.open() as file:
        try:
            table = pq.ParquetFile(file)
            names = table.schema_arrow.names
            chosen = choose_columns(source, wanted, names, len(names))
            _refuse_twins(source, names, chosen)
            columns = table.read(columns=[names[k] for k in chosen])
        except FileReadError:
            raise
        except (pa.ArrowException, OSError, ValueError) as error:
            raise source.failure(
                f"is not a complete Parquet file ({error}); write or copy it again"
            ) from error
    return stack([_floats(source, columns.column(names[k]), names[k]) for k in chosen])


def write_parquet(columns: Mapping[str, Any], file: IO[bytes]) -> None:
    """Write columns of equal length.

    Parameters
    ----------
    columns : mapping of str to (m,) array
    file : binary file

    Raises
    ------
    MissingLibraryError
        If pyarrow is not installed.
    """
    try:
        import pyarrow as pa
        import pyarrow.parquet as pq
    except ImportError as error:
        raise MissingLibraryError.of("pyarrow", "io", "Writing Parquet files") from error
    arrays = {name: np.ascontiguousarray(values) for name, values in columns.items()}
    pq.write_table(pa.table(arrays), file)


def _refuse_twins(source: Source, names: list[str], chosen: tuple[int, ...]) -> None:
    """Refuse columns that share their name, since Parquet finds them by name."""
    for number in chosen:
        if names.count(names[number]) > 1:
            raise source.failure(
                f"has several columns named {names[number]!r}; give them different names"
            )


def _floats(source: Source, column: Any, name: str) -> FloatArray:
    """Return a pyarrow column as float64."""
    import pyarrow as pa

    if column.null_count:
        empty = np.flatnonzero(column.is_null().to_numpy())
        raise source.failure(
            f"has no number in column {name!r} in {rows_text(empty[:6], total=len(empty))}; "
            "fill in or delete these rows"
        )
    kind = column.type
    if pa.types.is_decimal(kind):
        column = column.cast(pa.float64())
    elif not (pa.types.is_floating(kind) or pa.types.is_integer(kind)):
        raise source.failure(
            f"holds {kind} in column {name!r}, which are no coordinates; "
            "choose columns of numbers with columns="
        )
    return exact_floats(source, column.to_numpy(), name)
