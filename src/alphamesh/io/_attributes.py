"""The columns of point files besides the coordinates, each as an array."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.errors import FileReadError, MissingLibraryError
from alphamesh.io._columns import Wanted, choose_columns
from alphamesh.io._layout import TextOptions, is_missing, is_number
from alphamesh.io._npy import read_arrays
from alphamesh.io._ply import read_ply, vertex_properties
from alphamesh.io._scans import las_table, pcd_table
from alphamesh.io._sources import Source
from alphamesh.io._text import layout_of, read_cells
from alphamesh.io.molecules import MOLECULE_FORMATS, molecule_table

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["OF", "is_geoparquet", "of_text"]


def of_text(
    source: Source, wanted: Wanted, options: TextOptions, usual_delimiter: str | None
) -> dict[str, NDArray[Any]]:
    """Return the other columns of a text table that have names.

    Numbers become int64 where all are whole, else float64 with NaN for what is missing;
    a column with anything else stays text.
    """
    encoding, layout = layout_of(source, wanted, options, usual_delimiter)
    names = layout.names
    others = tuple(
        k for k, name in enumerate(names) if k not in layout.columns and name.strip()
    )
    if not others:
        return {}
    # Decimal commas are those of numbers alone, not of text.
    cells = read_cells(source, encoding, replace(layout, columns=others, decimal="."))
    made: dict[str, NDArray[Any]] = {}
    for i, k in enumerate(others):
        if names[k] not in made:  # the first of several columns of one name
            made[names[k]] = _numbers(cells[:, i], layout.decimal)
    return made


def _numbers(cells: NDArray[Any], decimal: str) -> NDArray[Any]:
    """Return cells as numbers if they are; else as they are."""
    texts = [cell.strip() for cell in cells.tolist()]
    missing = np.array([not text or is_missing(text) for text in texts], dtype=np.bool_)
    given = [text for text, gone in zip(texts, missing, strict=True) if not gone]
    if not given or not all(is_number(text, decimal) for text in given):
        return np.array(texts, dtype=np.object_)
    plain = [text.replace(",", ".") for text in given] if decimal == "," else given
    if not missing.any():
        try:
            return np.array([int(text) for text in plain], dtype=np.int64)
        except (ValueError, OverflowError):
            pass  # not whole, or too large: float64 it is
    made = np.full(len(texts), np.nan)
    made[~missing] = [float(text) for text in plain]
    return made


def _of_ply(source: Source, wanted: Wanted, key: str | None) -> dict[str, NDArray[Any]]:
    """Return the other properties of the vertices, in the types of the file."""
    types = vertex_properties(source)
    names = list(types)
    others = _others(source, wanted, names)
    if not others:
        return {}
    found = read_ply(source, Wanted(tuple(others), len(others)))
    return {name: found[:, k].astype(types[name]) for k, name in enumerate(others)}


def _of_npy(source: Source, wanted: Wanted, key: str | None) -> dict[str, NDArray[Any]]:
    """Return the other fields of a structured array; plain tables have none."""
    return _fields(source, wanted, next(iter(read_arrays(source).values())))


def _of_npz(source: Source, wanted: Wanted, key: str | None) -> dict[str, NDArray[Any]]:
    """Return the other fields, or the arrays called ``points.NAME``."""
    arrays = read_arrays(source)
    key = key or ("points" if "points" in arrays else next(iter(arrays)))
    main = arrays[key]
    siblings = {
        name.removeprefix(f"{key}."): values
        for name, values in arrays.items()
        if name.startswith(f"{key}.") and values.shape == main.shape[:1]
    }
    return _fields(source, wanted, main) | siblings


def _fields(source: Source, wanted: Wanted, array: NDArray[Any]) -> dict[str, NDArray[Any]]:
    names = array.dtype.names
    if names is None or array.ndim != 1:
        return {}
    return {
        name: array[name]
        for name in _others(source, wanted, names)
        if array.dtype[name].subdtype is None
    }


def _of_las(source: Source, wanted: Wanted, key: str | None) -> dict[str, NDArray[Any]]:
    """Return the other dimensions of the points: intensity, classification and so on."""
    return _of_table(source, wanted, *las_table(source))


def _of_pcd(source: Source, wanted: Wanted, key: str | None) -> dict[str, NDArray[Any]]:
    """Return the other fields of the points."""
    return _of_table(source, wanted, *pcd_table(source))


def _of_molecule(source: Source, wanted: Wanted, key: str | None) -> dict[str, NDArray[Any]]:
    """Return what is known of the atoms: weights, radii, elements and so on."""
    return _of_table(source, wanted, *molecule_table(source))


def _of_table(
    source: Source, wanted: Wanted, names: Sequence[str], table: Any
) -> dict[str, NDArray[Any]]:
    return {name: np.asarray(table[name]) for name in _others(source, wanted, names)}


def _of_parquet(source: Source, wanted: Wanted, key: str | None) -> dict[str, NDArray[Any]]:
    """Return all columns but the coordinates."""
    with _parquet(source) as table:
        others = _others(source, wanted, table.schema_arrow.names)
        if not others:
            return {}
        columns = table.read(columns=list(others))
    return {name: columns.column(name).to_numpy() for name in others}


def is_geoparquet(source: Source) -> bool:
    """Whether a Parquet file says that one of its columns holds geometries."""
    with _parquet(source) as table:
        return b"geo" in (table.schema_arrow.metadata or {})


@contextmanager
def _parquet(source: Source) -> Iterator[Any]:
    """Open a Parquet file by pyarrow."""
    try:
        import pyarrow as pa
        import pyarrow.parquet as pq
    except ImportError as error:
        raise MissingLibraryError.of("pyarrow", "io", "reading Parquet files") from error
    with source.open() as file:
        try:
            yield pq.ParquetFile(file)
        except FileReadError:
            raise
        except (pa.ArrowException, OSError, ValueError) as error:
            raise source.failure(
                f"is not a complete Parquet file ({error}); write or copy it again"
            ) from error


def _others(source: Source, wanted: Wanted, names: Sequence[str]) -> list[str]:
    """Return the names of the columns that are no coordinates."""
    chosen = choose_columns(source, wanted, names, len(names))
    return [name for k, name in enumerate(names) if k not in chosen]


OF: dict[str, Callable[[Source, Wanted, str | None], dict[str, NDArray[Any]]]] = {
    "las": _of_las,
    "laz": _of_las,
    "npy": _of_npy,
    "npz": _of_npz,
    "parquet": _of_parquet,
    "pcd": _of_pcd,
    "ply": _of_ply,
    **dict.fromkeys(MOLECULE_FORMATS, _of_molecule),
}
"""What returns the other columns, by format."""
