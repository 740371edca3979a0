"""Output files that appear whole or not at all."""

from __future__ import annotations

import errno
import os
import secrets
import shutil
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from alphamesh.errors import FileWriteError

__all__ = ["atomic_path", "check_output"]

# Some systems lack some of these numbers; NumPy's `tofile` reports none at all.
_FULL = {getattr(errno, name, None) for name in ("ENOSPC", "EDQUOT")} - {None}
_FORBIDDEN = {errno.EACCES, errno.EPERM}
_NEARLY_FULL = 1 << 16


@contextmanager
def atomic_path(path: str | os.PathLike[str], *, forced: bool = True) -> Iterator[Path]:
    """Give a file beside `path` to write into; it takes the name `path` if all goes well.

    The file given is empty, has the same extension and stands in the same folder. When
    the block ends, its bytes are forced to the disk and it replaces `path` in one step.
    If anything interrupts the block, Ctrl-C included, it is removed, and an older file at
    `path` stays as it was. Links are followed; permissions are those of the older file,
    or those of any newly opened file.

    Parameters
    ----------
    path : path-like
        Where the output shall be.
    forced : bool
        Whether to wait for the disk. If not, what is there after a power failure has to
        be checked by other means.

    Yields
    ------
    pathlib.Path
        The file to write.

    Raises
    ------
    FileWriteError
        If the folder is missing or not writable, `path` is a folder, a device or a
        read-only file, or writing fails: the disk is full, for instance.
    """
    try:
        target = _target(path)
        temporary = _create_beside(target)
    except OSError as error:
        raise _explained(error, path) from error
    try:
        yield temporary
        if forced:
            with temporary.open("rb+") as written:
                os.fsync(written.fileno())
        temporary.replace(target)
    except BaseException as error:
        # Explained first: once the file is gone, a full disk does not look full.
        explained = _explained(error, path) if isinstance(error, OSError) else error
        with suppress(OSError):  # what went wrong before matters more than what is left
            temporary.unlink(missing_ok=True)
        if explained is error:
            raise
        raise explained from error


def check_output(path: str | os.PathLike[str]) -> None:
    """Make sure that `path` can be written, before a long computation and not after it.

    Parameters
    ----------
    path : path-like
        Where the output shall be; left as it is.

    Raises
    ------
    FileWriteError
        If :func:`atomic_path` could not begin.
    """
    try:
        _create_beside(_target(path)).unlink()
    except OSError as error:
        raise _explained(error, path) from error


def _target(path: str | os.PathLike[str]) -> Path:
    """Return the file that `path` stands for, links followed, if it may be replaced."""
    target = Path(path).resolve()
    try:
        mode = target.stat().st_mode
    except FileNotFoundError:
        return target
    if stat.S_ISDIR(mode):
        raise FileWriteError(f"cannot write {_shown(path)}: it is a folder; add a file name")
    if not stat.S_ISREG(mode):
        raise FileWriteError(
            f"cannot write {_shown(path)}: it is a device or a pipe, not an ordinary file; "
            "write a file, then copy it there"
        )
    try:
        os.close(os.open(target, os.O_WRONLY))  # opened, not changed
    except PermissionError as error:
        raise FileWriteError(
            f"cannot write {_shown(path)}: the file there is write-protected; "
            "choose another name, or allow writing to it"
        ) from error
    return target


def _create_beside(target: Path) -> Path:
    """Return a new empty file in the folder of `target`, with its permissions."""
    temporary = target.with_name(f".alphamesh-{secrets.token_hex(8)}{target.suffix}")
    flags = os.O_CREAT | os.O_EXCL | os.O_WRONLY
    # Not `tempfile`: its files are private, while those of `open` obey the umask.
    os.close(os.open(temporary, flags, 0o666))
    try:
        if target.exists():
            temporary.chmod(stat.S_IMODE(target.stat().st_mode))
    except BaseException:
        temporary.unlink()
        raise
    return temporary


def _explained(error: OSError, path: str | os.PathLike[str]) -> FileWriteError:
    """Return `error` as an error that says what to do."""
    if isinstance(error, FileWriteError):
        return error
    explained = FileWriteError(f"cannot write {_shown(path)}: {_reason(error, Path(path))}")
    explained.errno = error.errno
    return explained


def _reason(error: OSError, path: Path) -> str:
    folder = _shown(path.parent.absolute())
    if error.errno in _FORBIDDEN:
        return (
            f"no permission to create files in the folder {folder}; "
            "choose another folder, or allow writing to it"
        )
    if error.errno == errno.EROFS:
        return f"the folder {folder} is on a read-only disk; choose another folder"
    if error.errno == errno.ENAMETOOLONG:
        return "the name is too long for this disk; choose a shorter one"
    if not path.parent.is_dir():
        return _missing(path.parent)
    free = shutil.disk_usage(path.parent).free
    if error.errno in _FULL or (error.errno is None and free < _NEARLY_FULL):
        return (
            f"the disk of the folder {folder} is full ({free:,} bytes free); "
            "make room or choose another disk. Nothing was changed there"
        )
    return f"{error.strerror or error} (folder {folder}). Nothing was changed there"


def _missing(folder: Path) -> str:
    """Say how much of the path to `folder` exists."""
    present = folder.absolute()
    while not present.exists():
        present = present.parent
    if present.is_dir():
        return (
            f"the folder {_shown(folder)} does not exist (but {_shown(present)} does); "
            "create it first, or correct the path"
        )
    return f"{_shown(present)} is a file, not a folder; correct the path"


def _shown(path: str | os.PathLike[str]) -> str:
    return f"'{os.fspath(path)}'"
