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

from alphamesh._kernels.tiles import checksum

__all__ = ["BLOCK", "DirectReader", "DirectWriter", "checksum_of", "lent_block", "write_direct"]

BLOCK = 1 << 22
"""Bytes written or read at a time; files that are smaller go through the cache."""

# Places in files and in memory must be multiples of this: no disk has larger sectors.
_SECTOR = 4096

# Bytes that a checksum takes at a time: they stay in the processor's cache.
_SUMMED = 1 << 20

# Zero where systems do not know of such files.
_DIRECT: int = getattr(os, "O_DIRECT", 0)
_REFUSALS = {errno.EINVAL, errno.ENOTSUP}

_ours = threading.local()


@contextmanager
def lent_block() -> Iterator[memoryview]:
    """Lend this thread the memory that it had before: fresh memory is slow.

    Yields
    ------
    memoryview
        Of `BLOCK` bytes, the first of them where a page begins.
    """
    block = getattr(_ours, "block", None) or mmap.mmap(-1, BLOCK)
    _ours.block = None  # whoever else asks meanwhile gets another one
    try:
        with memoryview(block) as view:
            yield view
    finally:
        _ours.block = block


class _File(FileIO):
    """A file that is read and written past the cache, or through it."""

    _direct = False
    _refused = not _DIRECT

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
            Whether memory, size and place in the file allow to pass the cache.
        """
        done = 0
        while done < len(content):
            self._switch(direct and not self._refused and done % _SECTOR == 0)
            try:
                count = transfer(content[done:])
            except OSError as error:
                if not self._direct or error.errno not in _REFUSALS:
                    raise
                self._refused = True
                continue
            if not count:
                break
            done += count
        return done

    def _switch(self, direct: bool) -> None:
        if direct == self._direct:
            return
        import fcntl

        try:
            # No other flag that can be changed is set.
            fcntl.fcntl(self.fileno(), fcntl.F_SETFL, _DIRECT if direct else 0)
        except OSError as error:
            if not direct or error.errno not in _REFUSALS:
                raise
            self._refused = True
        else:
            self._direct = direct


class DirectWriter:
    """A file that is written from its beginning to its end; see :func:`write_direct`.

    Attributes
    ----------
    size : int
        Bytes so far.
    sum : int
        Once the file is written, what :func:`checksum_of` finds if all of it is there; 0 if
        nobody will ask.
    """

    def __init__(self, file: _File, block: memoryview, *, summed: bool) -> None:
        self.size = 0
        self.sum = 0
        self._file = file
        self._block = block
        self._summed = summed

    def write(self, content: bytes | memoryview) -> None:
        """Add some bytes."""
        done, size = 0, len(content)
        while done < size:
            at = self.size % BLOCK
            count = min(size - done, _SUMMED - at % _SUMMED)
            self._block[at : at + count] = content[done : done + count]
            self.size += count
            done += count
            at += count
            if at % _SUMMED == 0:  # while it is in the processor's cache
                self._add(at - _SUMMED, at)
            if at == BLOCK:
                self._put(BLOCK, direct=True)

    def finish(self) -> None:
        """Write what is left."""
        count = self.size % BLOCK
        if rest := count % _SUMMED:
            self._add(count - rest, count)
        self._put(count, direct=self.size > BLOCK)

    def _add(self, start: int, end: int) -> None:
        if self._summed:
            self.sum = checksum(self._block[start:end], self.sum)

    def _put(self, count: int, *, direct: bool) -> None:
        whole = count // _SECTOR * _SECTOR if direct else 0
        done = self._file.move(self._file.write, self._block[:whole], direct=True)
        done += self._file.move(self._file.write, self._block[whole:count], direct=False)
        if done < count:
            raise OSError(errno.EIO, os.strerror(errno.EIO))


@contextmanager
def write_direct(
    path: str | os.PathLike[str], *, summed: bool = True
) -> Iterator[DirectWriter]:
    """Open a file to write it anew.

    Parameters
    ----------
    path : path-like
    summed : bool
        Whether to find the checksum of the file.

    Yields
    ------
    DirectWriter
    """
    with lent_block() as block, _File(os.fspath(path), "wb") as file:
        writer = DirectWriter(file, block, summed=summed)
        yield writer
        writer.finish()


class DirectReader(_File):
    """A file that is read anywhere, a few bytes through the cache, many past it.

    Parameters
    ----------
    path : path-like
    block : memoryview
        From :func:`lent_block`.

    Attributes
    ----------
    size : int
        Of the file.
    """

    def __init__(self, path: str | os.PathLike[str], block: memoryview) -> None:
        super().__init__(os.fspath(path), "rb")
        self.size = os.fstat(self.fileno()).st_size
        self._block = block

    def peek(self, start: int, count: int) -> bytes:
        """Return a few bytes that others look for, too; less at the end of the file."""
        self.seek(start)
        found = bytearray(count)
        return bytes(found[: self.move(self.readinto, memoryview(found), direct=False)])

    def parts(self, start: int, count: int) -> Iterator[memoryview]:
        """Yield some bytes in parts, each of which the next one overwrites.

        At the end of the file, there are less of them.
        """
        end = min(start + count, self.size)
        while start < end:
            skip = start % _SECTOR
            sectors = -(-(skip + end - start) // _SECTOR)
            block = self._block[: min(BLOCK, sectors * _SECTOR)]
            self.seek(start - skip)
            found = self.move(self.readinto, block, direct=self.size > BLOCK)
            part = block[skip : min(found, skip + end - start)]
            if not part:  # somebody has cut it off
                return
            yield part
            start += len(part)

    def fill(self, start: int, *targets: memoryview) -> bool:
        """Fill memory, one view after the other; tell whether there was enough."""
        left = [target for target in targets if target]
        for part in self.parts(start, sum(map(len, left))):
            done = 0
            while done < len(part):
                count = min(len(part) - done, len(left[0]))
                left[0][:count] = part[done : done + count]
                left[0] = left[0][count:]
                done += count
                if not left[0]:
                    del left[0]
        return not left


def checksum_of(path: str | os.PathLike[str]) -> int:
    """Return the checksum of a file as it is read back."""
    total = 0
    with lent_block() as block, DirectReader(path, block) as file:
        for part in file.parts(0, file.size):
            for start in range(0, len(part), _SUMMED):
                total = checksum(part[start : start + _SUMMED], total)
    return total
