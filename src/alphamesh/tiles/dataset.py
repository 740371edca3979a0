"""Clouds on disk that are read a chunk at a time."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.errors import (
    FileReadError,
    NonFiniteError,
    ParameterError,
    WeightsError,
    rows_text,
)
from alphamesh.io._columns import Columns, find_column, wanted_columns
from alphamesh.io._sources import open_source
from alphamesh.periodic import as_periods
from alphamesh.tiles.formats import FORMATS, kind_of

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray

__all__ = ["DATASET_FORMATS", "Chunk", "Dataset", "dataset"]

DATASET_FORMATS: tuple[str, ...] = tuple(FORMATS)
"""Extensions of files that :func:`dataset` reads; a folder holds files of one of them."""

_CHUNK = 5_000_000


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
    weight : int or None
        Number of the column of weights, if there is one.
    """

    number: int
    path: str
    first_row: int
    start: int
    count: int
    part: int
    columns: tuple[int, ...]
    weight: int | None = None

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
        self._refuse_poor(points, NonFiniteError, "coordinates")
        return points

    def read_weighted(self) -> FloatArray:
        """Return the points and, if there are weights, these as one column more.

        Returns
        -------
        (count, d) or (count, d + 1) float64

        Raises
        ------
        FileReadError, NonFiniteError
            See :meth:`read`.
        WeightsError
            If a weight is NaN or infinite; the message names rows of the dataset.
        """
        if self.weight is None:
            return self.read()
        table = np.ascontiguousarray(self._with(*self.columns, self.weight)._points(), float)
        self._refuse_poor(table[:, :-1], NonFiniteError, "coordinates")
        self._refuse_poor(table[:, -1:], WeightsError, "weights")
        return table

    def read_weights(self) -> FloatArray:
        """Return the weights alone, ``(count,)`` float64; none if there are none.

        Raises
        ------
        FileReadError, WeightsError
            See :meth:`read_weighted`.
        """
        if self.weight is None:
            return np.empty(0)
        table = np.ascontiguousarray(self._with(self.weight)._points(), dtype=np.float64)
        self._refuse_poor(table, WeightsError, "weights")
        return table[:, 0]

    def _with(self, *columns: int) -> Chunk:
        return replace(self, columns=columns, weight=None)

    def _refuse_poor(
        self, table: FloatArray, error: type[NonFiniteError | WeightsError], what: str
    ) -> None:
        """Raise if a number is NaN or infinite."""
        if np.isfinite(table).all():
            return
        poor = np.flatnonzero(~np.isfinite(table).all(axis=1))
        rows = poor[:6] + self.first_row
        raise error(
            f"NaN or infinite {what} in {rows_text(rows, total=len(poor))} of "
            f"{self.path}; remove these rows",
            rows=rows,
        )

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
            points = FORMATS[kind_of(self.path)].read(self)
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
    weights : str or None
        The column of weights, by its name or its number, if there is one.
    periods : tuple of float or None
        The side lengths of a periodic box, None for open directions; None if there is none.
    """

    chunks: tuple[Chunk, ...]
    count: int
    dimension: int
    digest: str
    weights: str | None = None
    periods: tuple[float | None, ...] | None = None


def dataset(  # noqa: PLR0913 (what a file does not tell by itself)
    path: str | os.PathLike[str],
    *,
    columns: Columns = None,
    dimension: int | None = None,
    weights: str | int | None = None,
    periods: Sequence[float | None] | None = None,
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
    weights : str or int, optional
        The column, by name or by number from 0, of the squared radii of balls, of any sign:
        then the complex is the weighted one. By default all balls are of equal size.
    periods : sequence of float or None, optional
        The side lengths of the periodic box that the points are in, None for open
        directions; see :class:`alphamesh.PeriodicComplex`.
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
    ParameterError
        If `columns`, `dimension` and `weights` do not fit together.
    PeriodsError
        If `periods` are not the sides of a box that has a periodic direction.
    """
    files = _files(Path(path))
    described: list[Chunk] = []
    wanted = wanted_columns(columns, dimension)._replace(space=False)
    heavy = None if weights is None else _column_of_weights(weights)
    digest = hashlib.sha256(repr(wanted if heavy is None else (wanted, heavy)).encode())
    row = 0
    for file in files:
        state = file.stat()
        digest.update(f"{file.name} {state.st_size} {state.st_mtime_ns}".encode())
        weight = None
        for start, count, part, chosen in FORMATS[kind_of(file)].parts(
            file, wanted, chunk_points
        ):
            if heavy is not None and weight is None:
                weight = _find_weights(file, heavy, chosen)
            if count:
                described.append(
                    Chunk(len(described), str(file), row, start, count, part, chosen, weight)
                )
            row += count
    box = None if periods is None else as_periods(periods, wanted.dimension)
    return Dataset(tuple(described), row, wanted.dimension, digest.hexdigest(), heavy, box)


def _column_of_weights(weights: object) -> str:
    if isinstance(weights, bool) or not isinstance(weights, str | int | np.integer):
        raise ParameterError(
            "weights must be the name of a column of the files, or its number from 0; got "
            f"{type(weights).__name__}. Weights in memory: write them beside the points"
        )
    return str(weights)


def _find_weights(file: Path, name: str, columns: tuple[int, ...]) -> int:
    """Return the number of the column of weights in a file."""
    names, width = FORMATS[kind_of(file)].names(file)
    found = find_column(open_source(file), name, names, width, "weights")
    if found in columns:
        raise ParameterError(
            f"weights={name!r} is a column of coordinates of {file}; weights need a column of "
            "their own, and columns= tells which are the coordinates"
        )
    return found


def _files(path: Path) -> list[Path]:
    if path.is_dir():
        files = sorted(
            file
            for file in path.rglob("*")
            if file.is_file()
            and kind_of(file) in DATASET_FORMATS
            and not file.name.startswith((".", "_"))
        )
        kinds = {kind_of(file) for file in files}
        if not files or len(kinds) > 1:
            found = ", ".join(sorted(kinds)) or "none"
            raise FileReadError(
                f"{path} must hold files of one of the formats "
                f"{', '.join(DATASET_FORMATS)}; found: {found}"
            )
        return files
    if kind_of(path) not in DATASET_FORMATS:
        raise FileReadError(
            f"{path} is not of a format that is read a chunk at a time; these are: "
            f"{', '.join(DATASET_FORMATS)}. Convert it: alphamesh convert"
        )
    open_source(path)  # says clearly what is wrong with it
    return [path.absolute()]
