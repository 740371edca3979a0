"""Large files that go past the system's cache, which they would only flood.

A run writes and reads each byte once, and more bytes than the memory has. In the cache, a
page for each 4096 of them has to be found, cleared, filled and dropped again, which may take
as long as the triangulation. Past it, the disk takes and gives whole blocks. Where the
system cannot do that, files are written and read as usual.
"""

from __future__ import annotations

import errno
import mmap
import os
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from io import FileIO
from pathlib import Path

from alphamesh._kernels.tiles import checksum

__all__ = ["BLOCK", "DirectReader", "DirectWriter", "checksum_of", "read_direct", "write_direct"]

BLOCK = 1 << 22
"""Bytes written or read at a time; files that are smaller go through the cache."""

# Places in files and in memory must be multiples of this: no disk has larger sectors.
_SECTOR = 4096

# Bytes that a checksum takes at a time: they stay in the processor's cache.
_SUMMED = 1 << 20

# Zero where systems do not know of such files.
_DIRECT: int = getattr(os, "O_DIRECT", 0)
_REFUSED = {errno.EINVAL, errno.ENOTSUP}

_ours = threading.local()


class DirectWriter:
    """A file that is written from its beginning to its end; see :func:`write_direct`.

    Attributes
    ----------
    size : int
        Bytes so far.
    sum : int
        Of the blocks that are written; at the end, what :func:`checksum_of` finds if all
        of them are there.
    """

    def __init__(self, file: _File, block: memoryview) -> None:
        self.size = 0
        self.sum = 0
        self._file = file
        self._block = block

    def write(self, content: bytes | memoryview) -> None:
        """Add some bytes."""
        done = 0
        while done < len(content):
            at = self.size % BLOCK
            count = min(len(content) - done, BLOCK - at)
            self._block[at : at + count] = content[done : done + count]
            self.size += count
            done += count
            if at + count == BLOCK:
                self._put(BLOCK, direct=True)

    def finish(self) -> None:
        """Write what is left."""
        self._put(self.size % BLOCK, direct=self.size > BLOCK)

    def _put(self, count: int, *, direct: bool) -> None:
        content = self._block[:count]
        self.sum = _sum_of(content, self.sum)
        whole = count // _SECTOR * _SECTOR if direct else 0
        done = self._file.move(self._file.write, content[:whole], direct=True)
        done += self._file.move(self._file.write, content[whole:], direct=False)
        if done < count:
            raise OSError(errno.EIO, os.strerror(errno.EIO))


class DirectReader:
    """A file that is read anywhere; see :func:`read_direct`."""

    def __init__(self, file: _File, block: memoryview) -> None:
        self.size = os.fstat(file.fileno()).st_size
        self._file = file
        self._block = block

    def read(self, start: int, count: int) -> Iterator[memoryview]:
        """Yield some bytes in parts, each of which the next one overwrites.

        At the end of the file, there are less of them.
        """
        end = min(start + count, self.size)
        while start < end:
            skip = start % _SECTOR
            sectors = -(-(skip + end - start) // _SECTOR)
            block = self._block[: min(BLOCK, sectors * _SECTOR)]
            self._file.seek(start - skip)
            found = self._file.move(self._file.readinto, block, direct=self.size > BLOCK)
            part = block[skip : min(found, skip + end - start)]
            if not part:  # somebody has cut it off
                return
            yield part
            start += len(part)

    def read_into(self, start: int, *targets: memoryview) -> bool:
        """Fill memory, one view after the other; tell whether there was enough."""
        left = [target for target in targets if target]
        for part in self.read(start, sum(map(len, left))):
            done = 0
            while done < len(part):
                count = min(len(part) - done, len(left[0]))
                left[0][:count] = part[done : done + count]
                left[0] = left[0][count:]
                done += count
                if not left[0]:
                    del left[0]
        return not left


@contextmanager
def write_direct(path: Path) -> Iterator[DirectWriter]:
    """Open a file to write it anew.

    Parameters
    ----------
    path : Path

    Yields
    ------
    DirectWriter
    """
    with _lent_block() as block, _File(path, "wb") as file:
        writer = DirectWriter(file, block)
        yield writer
        writer.finish()


@contextmanager
def read_direct(path: Path) -> Iterator[DirectReader]:
    """Open a file to read it.

    Parameters
    ----------
    path : Path

    Yields
    ------
    DirectReader
    """
    with _lent_block() as block, _File(path, "rb") as file:
        yield DirectReader(file, block)


def checksum_of(path: Path) -> int:
    """Return the checksum of a file as it is read back."""
    with read_direct(path) as file:
        total = 0
        for part in file.read(0, file.size):
            total = _sum_of(part, total)
        return total


def _sum_of(content: memoryview, before: int) -> int:
    for start in range(0, len(content), _SUMMED):
        before = checksum(content[start : start + _SUMMED], before)
    return before


@contextmanager
def _lent_block() -> Iterator[memoryview]:
    """Lend this thread the memory that it had before, which is quicker than new one."""
    block = getattr(_ours, "block", None) or mmap.mmap(-1, BLOCK)  # begins at a page
    _ours.block = None  # whoever else asks meanwhile gets another one
    try:
        with memoryview(block) as view:
            yield view
    finally:
        _ours.block = block


class _File(FileIO):
    """A file that is read and written past the cache, or through it."""

    _direct = False
    _refused = False

    def move(
        self, transfer: Callable[[memoryview], int | None], content: memoryview, *, direct: bool
    ) -> int:
        """Read or write all of a view, or as much as there is; return how much.

        Parameters
        ----------
        transfer : callable
            The method to do it with.
        content : memoryview
        direct : bool
            Whether memory and place in the file allow to pass the cache.
        """
        done = 0
        while done < len(content):
            self._switch(direct and done % _SECTOR == 0)
            try:
                count = transfer(content[done:])
            except OSError as error:
                if not self._direct or error.errno not in _REFUSED:
                    raise
                self._refused = True
                continue
            if not count:
                break
            done += count
        return done

    def _switch(self, direct: bool) -> None:
        direct = direct and not self._refused
        if direct == self._direct or not _DIRECT:
            return
        import fcntl

        flags = fcntl.fcntl(self.fileno(), fcntl.F_GETFL)
        try:
            fcntl.fcntl(
                self.fileno(), fcntl.F_SETFL, flags | _DIRECT if direct else flags & ~_DIRECT
            )
        except OSError as error:
            if error.errno not in _REFUSED:
                raise
            self._refused = True
        else:
            self._direct = direct
