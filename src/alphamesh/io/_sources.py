"""Where bytes come from: a file, a pipe or standard input, opened as often as needed."""

from __future__ import annotations

import errno
import gzip
import io
import os
import stat
import sys
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from alphamesh.errors import FileReadError

__all__ = ["Source", "open_source", "read_failure"]

# What a broken file makes gzip raise.
_GZIP_ERRORS = (gzip.BadGzipFile, EOFError, zlib.error)


class Source:
    """A named run of bytes that can be opened several times.

    Attributes
    ----------
    name : str
        How messages call it.
    path : Path or None
        The regular file behind it; None for a pipe or standard input, whose bytes are
        kept in memory.
    compressed : bool
        Whether :meth:`open` unpacks gzip.
    """

    def __init__(
        self,
        name: str,
        *,
        path: Path | None = None,
        data: bytes = b"",
        compressed: bool = False,
    ) -> None:
        self.name = name
        self.path = path
        self.compressed = compressed
        self._data = data

    @property
    def size(self) -> int:
        """Number of bytes, before any decompression."""
        return len(self._data) if self.path is None else self.path.stat().st_size

    @contextmanager
    def open(self) -> Iterator[BinaryIO]:
        """Open for reading from the start; every failure is a FileReadError."""
        try:
            with self._raw() as raw:
                if not self.compressed:
                    yield raw
                    return
                with gzip.GzipFile(fileobj=raw) as unpacked:
                    yield unpacked  # type: ignore[misc]
        except FileReadError:
            raise
        except _GZIP_ERRORS as error:
            raise self.failure(
                f"is not a complete gzip file ({error}); copy or download it again"
            ) from error
        except OSError as error:
            raise read_failure(self.name, error) from error

    def failure(self, what: str) -> FileReadError:
        """Return the error that says `what` of this source."""
        return FileReadError(f"{self.name} {what}")

    def _raw(self) -> BinaryIO:
        return io.BytesIO(self._data) if self.path is None else self.path.open("rb")


def open_source(path: str | os.PathLike[str]) -> Source:
    """Return the source at `path`, ``"-"`` being standard input.

    Raises
    ------
    FileReadError
        If there is no such file, or it cannot be read, or it is empty.
    """
    name = os.fspath(path)
    if name == "-":
        return Source("standard input", data=_read_stdin())
    try:
        mode = Path(name).stat().st_mode
        if stat.S_ISDIR(mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), name)
        packed = name.lower().endswith(".gz")
        if not stat.S_ISREG(mode):
            # A pipe can be read only once.
            with Path(name).open("rb") as pipe:
                source = Source(name, data=pipe.read(), compressed=packed)
        else:
            with Path(name).open("rb"):
                source = Source(name, path=Path(name), compressed=packed)
    except (OSError, ValueError) as error:
        raise read_failure(name, error) from error
    if source.size == 0:
        raise source.failure("is empty (0 bytes); was it written to the end?")
    return source


def read_failure(name: str, error: OSError | ValueError) -> FileReadError:
    """Return the error for a file that the system will not open or read."""
    if isinstance(error, FileNotFoundError | NotADirectoryError):
        what = "does not exist; check the name and the current folder"
    elif isinstance(error, IsADirectoryError):
        what = "is a folder; name a file in it"
    elif isinstance(error, PermissionError):
        what = "may not be read by this user; change its permissions"
    else:
        reason = getattr(error, "strerror", None) or str(error)
        what = f"cannot be read: {reason}"
    return FileReadError(f"{name} {what}")


def _read_stdin() -> bytes:
    if sys.stdin is None or sys.stdin.closed:
        raise FileReadError("standard input is closed; name a file instead of -")
    data = sys.stdin.buffer.read()
    if not data:
        raise FileReadError("standard input is empty; pipe a table of points into it")
    return data
