"""Clouds in NumPy's own files: NPY and NPZ, never unpickled, never larger than they claim."""

from __future__ import annotations

import math
import tokenize
import warnings
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from typing import IO, TYPE_CHECKING, Any

import numpy as np

from alphamesh.errors import FileReadError
from alphamesh.io._columns import Wanted, choose_columns, exact_floats, stack
from alphamesh.io._sources import Source

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from alphamesh._arrays import FloatArray

__all__ = ["read_arrays", "read_npy", "read_npz"]

# Deflate packs a byte into no less than this part of one.
_BEST_COMPRESSION = 1100


def read_npy(source: Source, wanted: Wanted) -> FloatArray:
    """Read the coordinates in an NPY file.

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
        If it is not a complete NPY file, or does not hold such a table.
    """
    with source.open() as file, _translated(source, "NPY"):
        array = _array(source, file, source.size)
    return _table(source, array, wanted)


def read_npz(source: Source, wanted: Wanted, key: str | None) -> FloatArray:
    """Read the coordinates in one array of an NPZ file.

    Parameters
    ----------
    source : Source
    wanted : Wanted
        As from :func:`wanted_columns`.
    key : str or None
        The array; None for ``points``, or the only one there is.

    Returns
    -------
    (n, dimension) float64 array

    Raises
    ------
    FileReadError
        If it is not a complete NPZ file, has no such array, or the array is no table.
    """
    with (
        source.open() as file,
        _translated(source, "NPZ"),
        zipfile.ZipFile(file) as archive,
    ):
        members = {info.filename.removesuffix(".npy"): info for info in archive.infolist()}
        info = members[_choose_key(source, list(members), key)]
        if info.file_size > _BEST_COMPRESSION * source.size:
            raise source.failure("is damaged: it claims more data than it can hold")
        with archive.open(info) as member:
            array = _array(source, member, info.file_size)
    return _table(source, array, wanted)


def read_arrays(source: Source) -> dict[str, NDArray[Any]]:
    """Return all arrays of an NPZ file by name; that of an NPY file has an empty one.

    Raises
    ------
    FileReadError
        If it is neither, not complete, or holds Python objects.
    """
    with source.open() as file:
        packed = file.read(2) == b"PK"
    if not packed:
        with source.open() as file, _translated(source, "NPY"):
            return {"": _array(source, file, source.size)}
    with (
        source.open() as file,
        _translated(source, "NPZ"),
        zipfile.ZipFile(file) as archive,
    ):
        found = {}
        for info in archive.infolist():
            if info.file_size > _BEST_COMPRESSION * source.size:
                raise source.failure("is damaged: it claims more data than it can hold")
            with archive.open(info) as member:
                name = info.filename.removesuffix(".npy")
                found[name] = _array(source, member, info.file_size)
        return found


def _choose_key(source: Source, keys: list[str], key: str | None) -> str:
    listed = ", ".join(repr(name) for name in keys[:12]) or "none"
    if key is not None:
        if key in keys:
            return key
        raise source.failure(f"has no array {key!r}; choose with key= one of: {listed}")
    if "points" in keys:
        return "points"
    if len(keys) == 1:
        return keys[0]
    raise source.failure(
        f"has no array 'points' and not just one array; choose with key= one of: {listed}"
    )


def _array(source: Source, file: IO[bytes], size: int) -> NDArray[Any]:
    """Read the array in `size` bytes, after a look whether they hold what they promise."""
    with warnings.catch_warnings():
        # Files that were written by Python 2 are as good as others.
        warnings.filterwarnings("ignore", "Reading .* additional header parsing", UserWarning)
        # So are those whose text goes by an old name.
        warnings.filterwarnings("ignore", "Data type alias", DeprecationWarning)
        return _parsed(source, file, size)


def _parsed(source: Source, file: IO[bytes], size: int) -> NDArray[Any]:
    version = np.lib.format.read_magic(file)
    # Versions 2 and 3 differ in the names of fields alone, which are read later.
    read_header = (
        np.lib.format.read_array_header_1_0
        if version == (1, 0)
        else np.lib.format.read_array_header_2_0
    )
    shape, _, dtype = read_header(file)
    if dtype.hasobject:
        raise source.failure(
            "holds Python objects, which are not read because they could run code; save "
            "points.astype(float)"
        )
    promised = math.prod(shape) * dtype.itemsize
    if promised < 0 or file.tell() + promised > size:
        raise source.failure(
            f"is cut off or damaged: its header promises {promised} bytes of data and "
            f"{size - file.tell()} follow; write or copy it again"
        )
    file.seek(0)
    array: NDArray[Any] = np.lib.format.read_array(file, allow_pickle=False)
    return array


def _table(source: Source, array: NDArray[Any], wanted: Wanted) -> FloatArray:
    """Return the chosen columns of a 2D array, or fields of a structured one."""
    names = array.dtype.names
    if names is not None and array.ndim == 1:
        chosen = choose_columns(source, wanted, names, len(names))
        return stack([exact_floats(source, array[names[k]], names[k]) for k in chosen])
    if array.ndim != 2:
        raise source.failure(
            f"holds an array of shape {array.shape}, not a table; save points of shape (n, 2)"
        )
    width = array.shape[1]
    if not wanted.columns and width not in (2, 3):
        swapped = "; if it is transposed, save points.T" if array.shape[0] in (2, 3) else ""
        raise source.failure(
            f"holds an array of shape {array.shape}; choose the coordinates among its "
            f"{width} columns with columns=, such as columns=(0, 1){swapped}"
        )
    chosen = choose_columns(source, wanted, None, width)
    return stack([exact_floats(source, array[:, k], k) for k in chosen])


@contextmanager
def _translated(source: Source, what: str) -> Iterator[None]:
    """Turn what broken files make NumPy and zipfile raise into a FileReadError."""
    try:
        yield
    except (FileReadError, OSError):
        raise
    except (
        ValueError,
        TypeError,
        KeyError,
        EOFError,
        SyntaxError,
        RuntimeError,
        MemoryError,
        tokenize.TokenError,
        zipfile.BadZipFile,
        zlib.error,
    ) as error:
        raise source.failure(
            f"is not a complete {what} file ({error}); write or copy it again"
        ) from error
