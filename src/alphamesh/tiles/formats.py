"""Files whose rows are read a chunk at a time, one format after the other."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from alphamesh.errors import FileReadError, MissingLibraryError
from alphamesh.io._columns import Wanted, choose_columns
from alphamesh.io._laz import laz_backend
from alphamesh.io._scans import refuse_counts
from alphamesh.io._sources import open_source

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray
    from alphamesh.tiles.dataset import Chunk

__all__ = ["FORMATS", "Format", "kind_of"]

_AXES = ("x", "y", "z")


def kind_of(path: str | Path) -> str:
    """Return the format of a file, by its name."""
    return Path(path).suffix.lower().removeprefix(".")


Parts = Iterator[tuple[int, int, int, tuple[int, ...]]]
"""Start, count, part and columns of the chunks of a file."""


def _slices(count: int, size: int, columns: tuple[int, ...]) -> Parts:
    for start in range(0, count, size):
        yield start, min(size, count - start), 0, columns


def _open_npy(path: str | Path) -> Any:
    try:
        array = np.load(path, mmap_mode="r", allow_pickle=False)
    except (ValueError, EOFError, OSError) as error:
        raise FileReadError(f"{path} is not a complete NPY file: {error}") from error
    if array.ndim != 2 or array.shape[1] < 2 or array.dtype.kind not in "fiu":
        raise FileReadError(
            f"{path} holds {array.dtype} of shape {array.shape}; needed is a table of "
            "numbers, two columns or more"
        )
    return array


def _npy_parts(path: Path, wanted: Wanted, size: int) -> Parts:
    array = _open_npy(path)
    chosen = choose_columns(open_source(path), wanted, None, array.shape[1])
    return _slices(len(array), size, chosen)


def _read_npy(chunk: Chunk) -> Any:
    array = _open_npy(chunk.path)
    part = array[chunk.start : chunk.start + chunk.count]
    first, last = chunk.columns[0], chunk.columns[-1]
    if chunk.columns == tuple(range(first, last + 1)):
        return part[:, first : last + 1]
    return part[:, list(chunk.columns)]


def _parquet(path: str | Path) -> Any:
    try:
        import pyarrow as pa
        import pyarrow.parquet as pq
    except ImportError as error:
        raise MissingLibraryError.of("pyarrow", "tiles", "reading Parquet files") from error
    try:
        return pq.ParquetFile(path)
    except (pa.ArrowException, OSError, ValueError) as error:
        raise FileReadError(f"{path} is not a complete Parquet file ({error})") from error


def _parquet_parts(path: Path, wanted: Wanted, size: int) -> Parts:
    table = _parquet(path)
    names = table.schema_arrow.names
    chosen = choose_columns(open_source(path), wanted, names, len(names))
    groups = (table.metadata.row_group(k).num_rows for k in range(table.num_row_groups))
    return ((0, count, part, chosen) for part, count in enumerate(groups))


def _read_parquet(chunk: Chunk) -> FloatArray:
    table = _parquet(chunk.path)
    names = table.schema_arrow.names
    wanted = [names[k] for k in chunk.columns]
    group = table.read_row_group(chunk.part, columns=wanted)
    return np.stack([np.asarray(group.column(name).to_numpy(), float) for name in wanted], 1)


def _las(path: str | Path) -> Any:
    try:
        import laspy
    except ImportError as error:
        raise MissingLibraryError.of("laspy", "tiles", "reading LAS files") from error
    try:
        with Path(path).open("rb") as file:
            backend = laz_backend(file)
        return laspy.open(path, **backend)
    except (laspy.errors.LaspyException, OSError, ValueError) as error:
        raise FileReadError(f"{path} is not a complete LAS file ({error})") from error


def _las_parts(path: Path, wanted: Wanted, size: int) -> Parts:
    source = open_source(path)
    with source.open() as head:
        refuse_counts(source, head)
    chosen = choose_columns(source, wanted, _AXES, len(_AXES))
    with _las(path) as file:
        return _slices(int(file.header.point_count), size, chosen)


def _read_las(chunk: Chunk) -> FloatArray:
    with _las(chunk.path) as file:
        file.seek(chunk.start)
        part = file.read_points(chunk.count)
        names = _las_columns(file)
        return np.stack([np.asarray(part[names[k]]) for k in chunk.columns], axis=1)


def _las_columns(file: Any) -> tuple[str, ...]:
    """Return the coordinates, then all that a point has besides."""
    raw = {"X", "Y", "Z"}  # coordinates before they are scaled
    return (*_AXES, *(n for n in file.header.point_format.dimension_names if n not in raw))


def _names_npy(path: Path) -> tuple[None, int]:
    return None, _open_npy(path).shape[1]


def _names_parquet(path: Path) -> tuple[list[str], int]:
    names = _parquet(path).schema_arrow.names
    return names, len(names)


def _names_las(path: Path) -> tuple[tuple[str, ...], int]:
    with _las(path) as file:
        names = _las_columns(file)
        return names, len(names)


class Format(NamedTuple):
    """What can be done with the files of one format."""

    parts: Callable[[Path, Wanted, int], Parts]
    """the chunks of a file, of at most so many rows"""
    read: Callable[[Chunk], Any]
    """the columns of a chunk, perhaps not read yet"""
    names: Callable[[Path], tuple[Sequence[str] | None, int]]
    """the names of all columns, if they have any, and how many there are"""


_LAS = Format(_las_parts, _read_las, _names_las)
FORMATS = {
    "npy": Format(_npy_parts, _read_npy, _names_npy),
    "parquet": Format(_parquet_parts, _read_parquet, _names_parquet),
    "las": _LAS,
    "laz": _LAS,
}
"""By extension."""
