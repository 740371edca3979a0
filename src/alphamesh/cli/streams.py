"""Standard input and output in the place of files."""

from __future__ import annotations

import shutil
import struct
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import click

from alphamesh.errors import FileReadError

__all__ = ["STDIN", "from_standard_input", "sniffed", "to_standard_output"]

STDIN = "-"

# How files of each format begin; what begins otherwise is a table in text.
_SIGNATURES = (
    (b"\x93NUMPY", ".npy"),
    (b"PK\x03\x04", ".npz"),
    (b"PAR1", ".parquet"),
    (b"\x1f\x8b", ".csv.gz"),
    (b"\x89PNG", ".png"),
    (b"\xff\xd8\xff", ".jpg"),
    (b"GIF8", ".gif"),
    (b"BM", ".bmp"),
    (b"II*\x00", ".tif"),
    (b"MM\x00*", ".tif"),
    (b"SQLite format 3\x00", ".gpkg"),
    (b"fgb", ".fgb"),
    (b"# .PCD", ".pcd"),
    (b"LASF", ".las"),
    (b"<?xml", ".vtu"),
    (b"<VTKFile", ".vtu"),
    (b"# vtk DataFile", ".vtk"),
    (b"$MeshFormat", ".msh"),
    (b"OFF", ".off"),
    (b"solid ", ".stl"),
    (b"v ", ".obj"),
    (b"{", ".geojson"),
)
_LONGEST = 64

# Bytes of a binary STL file before its triangles, and of each triangle.
_STL_HEAD, _STL_TRIANGLE = 84, 50

# Formats that may be shown on a terminal.
_TEXT = frozenset({".csv", ".tsv", ".txt", ".xyz", ".obj", ".off", ".geojson", ".wkt", ".json"})


def sniffed(head: bytes) -> str:
    """Return the extension of files that begin with `head`, ``.csv`` for other text."""
    if head[:4] in {b"ply\n", b"ply\r"}:
        return ".ply"
    for signature, suffix in _SIGNATURES:
        if head.startswith(signature):
            return suffix
    return ".csv"


@contextmanager
def from_standard_input(suffix: str | None = None) -> Iterator[Path]:
    """Give a file with what comes from standard input, named by what it is.

    Parameters
    ----------
    suffix : str, optional
        Extension of the format; by default it is found in the first bytes.

    Raises
    ------
    FileReadError
        If nothing comes, or the block raises one; the message speaks of standard input.
    """
    if sys.stdin is None or sys.stdin.closed:
        raise FileReadError("standard input is closed; name a file instead of -")
    source = sys.stdin.buffer
    head = source.read(_LONGEST)
    if not head:
        raise FileReadError("standard input is empty; pipe a file into it")
    with tempfile.TemporaryDirectory(prefix="alphamesh-") as folder:
        path = Path(folder) / f"input{suffix or sniffed(head)}"
        with path.open("wb") as file:
            file.write(head)
            shutil.copyfileobj(source, file)
        if suffix is None and _is_stl(path):
            path = path.rename(path.with_suffix(".stl"))
        try:
            yield path
        except FileReadError as error:
            said = str(error).replace(f"'{path}'", str(path))
            raise FileReadError(
                said.replace(str(path), "standard input"), rows=error.rows
            ) from error


def _is_stl(path: Path) -> bool:
    """Return whether a file is as long as the count in it makes a binary STL file."""
    with path.open("rb") as file:
        head = file.read(_STL_HEAD)
    if len(head) < _STL_HEAD:
        return False
    (count,) = struct.unpack("<I", head[80:])
    return path.stat().st_size == _STL_HEAD + _STL_TRIANGLE * int(count)


def to_standard_output(write: Callable[[Path], None], suffix: str) -> None:
    """Send the file that `write` makes to standard output, once it is whole.

    Raises
    ------
    click.UsageError
        If it is binary and would fill a terminal, or several files.
    """
    if suffix == ".shp":
        raise click.UsageError("a shapefile is several files; choose --to zip, or name a file")
    if suffix not in _TEXT and sys.stdout.isatty():
        raise click.UsageError(
            f"{suffix.removeprefix('.').upper()} is binary and would fill the terminal; "
            "pipe it on, or name a file with -o"
        )
    with tempfile.TemporaryDirectory(prefix="alphamesh-") as folder:
        path = Path(folder) / f"output{suffix}"
        write(path)
        target = sys.stdout.buffer
        with path.open("rb") as file:
            shutil.copyfileobj(file, target)
        target.flush()
