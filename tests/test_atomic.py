"""Output files appear whole or not at all, and errors say what to do."""

from __future__ import annotations

import errno
import os
import shutil
import stat
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

from alphamesh.errors import AlphameshError, FileWriteError
from alphamesh.io._atomic import atomic_path, check_output

posix = pytest.mark.skipif(os.name != "posix", reason="POSIX permissions")


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def save(path: Path, content: bytes) -> None:
    with atomic_path(path) as temporary:
        temporary.write_bytes(content)


@pytest.fixture
def ordinary_user() -> Iterator[Path]:
    """Give a folder that all can reach, and be a user whom permissions bind."""
    folder = Path(tempfile.mkdtemp())
    folder.chmod(0o755)
    user = os.geteuid()
    try:
        if user == 0:
            os.seteuid(65534)
        yield folder
    finally:
        os.seteuid(user)
        for inner in folder.iterdir():
            inner.chmod(0o755)
        shutil.rmtree(folder)


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    """Mount a disk of 64 KiB, which only root can."""
    folder = tmp_path / "disk"
    folder.mkdir()
    command = ["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", str(folder)]
    if sys.platform != "linux" or shutil.which("mount") is None:
        pytest.skip("needs Linux's mount")
    if subprocess.run(command, capture_output=True, check=False).returncode:
        pytest.skip("needs the right to mount a disk")
    try:
        yield folder
    finally:
        subprocess.run(["umount", "-l", str(folder)], check=True)


def test_the_file_appears_only_when_the_block_ends(tmp_path: Path) -> None:
    target = tmp_path / "mesh.vtu"
    with atomic_path(target) as temporary:
        assert temporary.parent == tmp_path
        assert temporary.suffix == ".vtu"
        temporary.write_bytes(b"whole")
        assert not target.exists()
    assert target.read_bytes() == b"whole"
    assert names(tmp_path) == ["mesh.vtu"]


def test_an_older_file_is_replaced_in_one_step(tmp_path: Path) -> None:
    target = tmp_path / "mesh.vtu"
    target.write_bytes(b"old")
    with atomic_path(target) as temporary:
        temporary.write_bytes(b"new")
        assert target.read_bytes() == b"old"
    assert target.read_bytes() == b"new"


@pytest.mark.parametrize("name", ["no extension", "Höhe 3.vtu", ".hidden", "a.b.c", "x" * 255])
def test_any_name_will_do(tmp_path: Path, name: str) -> None:
    save(tmp_path / name, b"whole")
    assert names(tmp_path) == [name]


def test_paths_may_be_text_and_relative(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with atomic_path("mesh.vtu") as temporary:
        temporary.write_bytes(b"whole")
    assert Path("mesh.vtu").read_bytes() == b"whole"


@posix
@pytest.mark.parametrize("umask", [0o022, 0o077, 0o000])
def test_a_new_file_has_the_permissions_of_an_opened_one(tmp_path: Path, umask: int) -> None:
    before = os.umask(umask)
    try:
        save(tmp_path / "ours", b"whole")
        with (tmp_path / "plain").open("wb"):
            pass
    finally:
        os.umask(before)
    assert (tmp_path / "ours").stat().st_mode == (tmp_path / "plain").stat().st_mode


@posix
def test_an_older_file_keeps_its_permissions(tmp_path: Path) -> None:
    target = tmp_path / "mesh.vtu"
    target.write_bytes(b"old")
    target.chmod(0o604)
    save(target, b"new")
    assert stat.S_IMODE(target.stat().st_mode) == 0o604


@posix
def test_links_are_followed(tmp_path: Path) -> None:
    (tmp_path / "real").mkdir()
    link = tmp_path / "link.vtu"
    link.symlink_to(tmp_path / "real" / "mesh.vtu")
    save(link, b"whole")
    assert link.is_symlink()
    assert (tmp_path / "real" / "mesh.vtu").read_bytes() == b"whole"
    assert names(tmp_path / "real") == ["mesh.vtu"]


@pytest.mark.parametrize(
    "problem", [KeyboardInterrupt, SystemExit, ValueError("bug"), MemoryError]
)
@pytest.mark.parametrize("older", [None, b"old"])
def test_an_interruption_leaves_all_as_it_was(
    tmp_path: Path, problem: type[BaseException], older: bytes | None
) -> None:
    target = tmp_path / "mesh.vtu"
    if older is not None:
        target.write_bytes(older)
    with (
        pytest.raises(problem if isinstance(problem, type) else type(problem)),
        atomic_path(target) as temporary,
    ):
        temporary.write_bytes(b"half")
        raise problem
    assert names(tmp_path) == ([] if older is None else ["mesh.vtu"])
    assert older is None or target.read_bytes() == older


def test_a_missing_folder_is_named_with_what_exists(tmp_path: Path) -> None:
    target = tmp_path / "results" / "june" / "mesh.vtu"
    with pytest.raises(FileWriteError) as caught:
        save(target, b"whole")
    assert str(caught.value) == (
        f"cannot write '{target}': the folder '{target.parent}' does not exist "
        f"(but '{tmp_path}' does); create it first, or correct the path"
    )
    assert caught.value.errno == errno.ENOENT
    assert isinstance(caught.value, AlphameshError)
    assert isinstance(caught.value, OSError)


def test_a_missing_relative_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(
        FileWriteError, match=r"cannot write 'out.x.vtu': the folder 'out' does "
    ):
        save(Path("out") / "x.vtu", b"whole")


def test_a_file_in_place_of_the_folder(tmp_path: Path) -> None:
    (tmp_path / "results").write_bytes(b"a file")
    with pytest.raises(FileWriteError, match=r"results' is a file, not a folder; correct"):
        save(tmp_path / "results" / "mesh.vtu", b"whole")
    assert (tmp_path / "results").read_bytes() == b"a file"


def test_a_folder_in_place_of_the_file(tmp_path: Path) -> None:
    with pytest.raises(FileWriteError, match="it is a folder; add a file name"):
        save(tmp_path, b"whole")


@posix
def test_devices_and_pipes_are_not_replaced(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    for path in (tmp_path / "pipe", Path(os.devnull)):
        with pytest.raises(FileWriteError, match="a device or a pipe, not an ordinary file"):
            save(path, b"whole")
    assert Path(os.devnull).is_char_device()
    assert (tmp_path / "pipe").is_fifo()


def test_a_name_that_is_too_long(tmp_path: Path) -> None:
    with pytest.raises(FileWriteError, match=r"name is too long.*choose a shorter one"):
        save(tmp_path / ("x" * 5000), b"whole")


def as_owner(action: Callable[[], object]) -> None:
    """Prepare something as the user who runs the tests."""
    effective = os.geteuid()
    os.seteuid(os.getuid())
    try:
        action()
    finally:
        os.seteuid(effective)


@posix
def test_a_folder_without_permission(ordinary_user: Path) -> None:
    closed = ordinary_user / "closed"
    as_owner(lambda: closed.mkdir(mode=0o555))
    with pytest.raises(FileWriteError) as caught:
        save(closed / "mesh.vtu", b"whole")
    assert str(caught.value).endswith(
        f"no permission to create files in the folder '{closed}'; "
        "choose another folder, or allow writing to it"
    )
    assert names(closed) == []


@posix
def test_a_folder_that_cannot_be_entered(ordinary_user: Path) -> None:
    as_owner(lambda: (ordinary_user / "closed").mkdir(mode=0o000))
    with pytest.raises(FileWriteError, match="no permission to create files in the folder"):
        save(ordinary_user / "closed" / "mesh.vtu", b"whole")


@posix
def test_a_write_protected_file(ordinary_user: Path) -> None:
    folder, target = ordinary_user / "open", ordinary_user / "open" / "mesh.vtu"

    def prepare() -> None:
        folder.mkdir()
        folder.chmod(0o777)
        target.write_bytes(b"old")
        target.chmod(0o444)

    as_owner(prepare)
    with pytest.raises(FileWriteError, match="the file there is write-protected"):
        save(target, b"new")
    assert target.read_bytes() == b"old"


def test_a_read_only_disk(small_disk: Path) -> None:
    (small_disk / "mesh.vtu").write_bytes(b"old")
    subprocess.run(["mount", "-o", "remount,ro", str(small_disk)], check=True)
    with pytest.raises(FileWriteError, match="is on a read-only disk; choose another folder"):
        save(small_disk / "new.vtu", b"whole")
    with pytest.raises(FileWriteError, match="is on a read-only disk; choose another folder"):
        save(small_disk / "mesh.vtu", b"new")
    assert names(small_disk) == ["mesh.vtu"]


# NumPy's `tofile` reports a full disk without an error number.
@pytest.mark.parametrize("with_numpy", [False, True])
def test_a_full_disk(small_disk: Path, with_numpy: bool) -> None:
    target = small_disk / "mesh.vtu"
    target.write_bytes(b"old")
    with pytest.raises(FileWriteError) as caught, atomic_path(target) as temporary:
        if with_numpy:
            np.zeros(1 << 20).tofile(temporary)
        else:
            temporary.write_bytes(bytes(1 << 20))
    message = f"the disk of the folder '{small_disk}' is full (0 bytes free); make room or"
    assert message in str(caught.value)
    assert caught.value.errno == (None if with_numpy else errno.ENOSPC)
    assert names(small_disk) == ["mesh.vtu"]
    assert target.read_bytes() == b"old"


@pytest.mark.parametrize("function", ["fsync", "replace"])
def test_a_disk_that_fills_up_at_the_last_moment(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, function: str
) -> None:
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    (tmp_path / "mesh.vtu").write_bytes(b"old")
    monkeypatch.setattr(*((os, "fsync") if function == "fsync" else (Path, "replace")), full)
    with pytest.raises(FileWriteError, match=r"is full \([0-9,]+ bytes free\); make room"):
        save(tmp_path / "mesh.vtu", b"new")
    assert names(tmp_path) == ["mesh.vtu"]
    assert (tmp_path / "mesh.vtu").read_bytes() == b"old"


@posix
def test_a_limit_on_the_size_of_files(tmp_path: Path) -> None:
    resource = pytest.importorskip("resource")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, before[1]))
    try:
        with pytest.raises(FileWriteError, match=r"File too large \(folder '.*Nothing was"):
            save(tmp_path / "mesh.vtu", bytes(20_000))
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert names(tmp_path) == []


def test_an_output_can_be_checked_before_the_work(tmp_path: Path) -> None:
    (tmp_path / "old.vtu").write_bytes(b"old")
    check_output(tmp_path / "new.vtu")
    check_output(tmp_path / "old.vtu")
    assert names(tmp_path) == ["old.vtu"]
    assert (tmp_path / "old.vtu").read_bytes() == b"old"
    with pytest.raises(FileWriteError, match="does not exist"):
        check_output(tmp_path / "missing" / "new.vtu")
    with pytest.raises(FileWriteError, match="it is a folder"):
        check_output(tmp_path)


def test_an_explained_error_is_not_explained_again(tmp_path: Path) -> None:
    with pytest.raises(FileWriteError, match=r"^already clear$"), atomic_path(tmp_path / "a"):
        raise FileWriteError("already clear")
    assert names(tmp_path) == []
