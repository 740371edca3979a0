"""Clouds on disk that are read a chunk at a time."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.errors import FileReadError, MissingLibraryError, NonFiniteError, rows_text
from alphamesh.io._columns import Columns, Wanted, choose_columns, wanted_columns
from alphamesh.io._laz import laz_backend
from alphamesh.io._scans import refuse_counts
from alphamesh.io._sources import open_source

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray

__all__ = ["DATASET_FORMATS", "Chunk", "Dataset", "dataset"]

DATASET_FORMATS: tuple[str, ...] = ("npy", "parquet", "las", "laz")
"""Extensions of files that :func:`dataset` reads; a folder holds files of one of them."""

_CHUNK = 2_000_000
_AXES = ("x", "y", "z")


@dataclass(frozen=True, slots=True)
class Chunk:
    """Some rows of a dataset, which any process can read by itself.

    Attributes
    ----------
    number : int
    path : str
    first_row : int
        Of the whole dataset.
    start, count : int
        Which rows of the file.
    part : int
        Row group of a Parquet file.
    columns : tuple of int
        Numbers of the columns that are the coordinates.
    """

    number: int
    path: str
    first_row: int
    start: int
    count: int
    part: int
    columns: tuple[int, ...]

    def read(self) -> FloatArray:
        """Return the points of the chunk, ``(count, d)`` float64.

        Raises
        ------
        FileReadError
            If the file is damaged, or has changed since the dataset was described.
        NonFiniteError
            If a coordinate is NaN or infinite; the message names rows of the dataset.
        """
        points = np.ascontiguousarray(self._points(), dtype=np.float64)
        if not np.isfinite(points).all():
            poor = np.flatnonzero(~np.isfinite(points).all(axis=1))
            rows = poor[:6] + self.first_row
            raise NonFiniteError(
                f"NaN or infinite coordinates in {rows_text(rows, total=len(poor))} of "
                f"{self.path}; remove these rows",
                rows=rows,
            )
        return points

    def sample(self, count: int) -> FloatArray:
        """Return some points of the chunk, the same ones each time.

        Parameters
        ----------
        count : int

        Returns
        -------
        (k, d) float64
            No more than `count`, a few less as a rule.
        """
        points = self._points()
        if count < self.count:
            rng = np.random.default_rng(self.number)
            points = points[np.unique(rng.integers(0, self.count, count))]
        points = np.array(points, dtype=np.float64)
        # Others are named when the chunk is read.
        return points.compress(np.isfinite(points).all(axis=1), axis=0)

    def _points(self) -> Any:
        """Return the rows of the chunk, perhaps not read yet."""
        try:
            points = _READERS[_kind(self.path)](self)
        except (OSError, ValueError) as error:
            if isinstance(error, FileReadError):
                raise
            raise FileReadError(f"{self.path} cannot be read: {error}") from error
        if len(points) != self.count:
            raise FileReadError(
                f"{self.path} has changed: rows {self.first_row:,} and following are missing; "
                "start again with overwrite=True"
            )
        return points


@dataclass(frozen=True, slots=True)
class Dataset:
    """A cloud on disk, described but not read.

    Attributes
    ----------
    chunks : tuple of Chunk
        In the order of the rows: files by name, rows as in the files.
    count : int
        Number of points.
    dimension : {2, 3}
        How many coordinates a point has.
    digest : str
        Changes when a file is added, removed or changed.
    """

    chunks: tuple[Chunk, ...]
    count: int
    dimension: int
    digest: str


def dataset(
    path: str | os.PathLike[str],
    *,
    columns: Columns = None,
    dimension: int | None = None,
    chunk_points: int = _CHUNK,
) -> Dataset:
    """Describe a cloud on disk: a file, or a folder of files with equal columns.

    Parameters
    ----------
    path : path-like
        NPY, Parquet, LAS or LAZ (COPC among them), or a folder of such files. Hidden
        files and those that begin with "_" are left out.
    columns : sequence of str or int, or str, optional
        Of Parquet files, see :func:`alphamesh.read_points`; of NPY files, numbers.
    dimension : {2, 3}, optional
        How many coordinates to read: by default as many as `columns`, else 2.
    chunk_points : int
        How many rows to read at a time; of Parquet, whole row groups.

    Returns
    -------
    Dataset

    Raises
    ------
    FileReadError
        If there is no such file, or it is not what its name says.
    MissingLibraryError
        If the format needs a library that is not installed.
    """
    files = _files(Path(path))
    described: list[Chunk] = []
    wanted = wanted_columns(columns, dimension)._replace(space=False)
    digest = hashlib.sha256(repr(wanted).encode())
    row = 0
    for file in files:
        state = file.stat()
        digest.update(f"{file.name} {state.st_size} {state.st_mtime_ns}".encode())
        for start, count, part, chosen in _PARTS[_kind(file)](file, wanted, chunk_points):
            if count:
                described.append(
                    Chunk(len(described), str(file), row, start, count, part, chosen)
                )
            row += count
    return Dataset(tuple(described), row, wanted.dimension, digest.hexdigest())


def _files(path: Path) -> list[Path]:
    if path.is_dir():
        files = sorted(
            file
            for file in path.rglob("*")
            if file.is_file()
            and _kind(file) in DATASET_FORMATS
            and not file.name.startswith((".", "_"))
        )
        kinds = {_kind(file) for file in files}
        if not files or len(kinds) > 1:
            found = ", ".join(sorted(kinds)) or "none"
            raise FileReadError(
                f"{path} must hold files of one of the formats "
                f"{', '.join(DATASET_FORMATS)}; found: {found}"
            )
        return files
    if _kind(path) not in DATASET_FORMATS:
        raise FileReadError(
            f"{path} is not of a format that is read a chunk at a time; these are: "
            f"{', '.join(DATASET_FORMATS)}. Convert it: alphamesh convert"
        )
    open_source(path)  # says clearly what is wrong with it
    return [path.absolute()]


def _kind(path: str | Path) -> str:
    return Path(path).suffix.lower().removeprefix(".")


# Each returns or yields start, count, part and columns of the chunks of a file.
Parts = Iterator[tuple[int, int, int, tuple[int, ...]]]


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
        return np.stack([np.asarray(part[_AXES[k]]) for k in chunk.columns], axis=1)


_PARTS = {
    "npy": _npy_parts,
    "parquet": _parquet_parts,
    "las": _las_parts,
    "laz": _las_parts,
}
_READERS = {"npy": _read_npy, "parquet": _read_parquet, "las": _read_las, "laz": _read_las}
