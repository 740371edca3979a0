"""What goes wrong with mesh files, and what is said then."""

from __future__ import annotations

import dataclasses
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from alphamesh.errors import (
    FileReadError,
    FileWriteError,
    MissingLibraryError,
    ParameterError,
)
from alphamesh.io.meshes import MESH_FORMATS, Mesh, mesh_format, read_mesh, write_mesh
from mesh_samples import (
    EXTENSIONS,
    FULL,
    SQUARE,
    TRIANGLES,
    WITH_MESHIO,
    names,
    written,
)


class TestNames:
    def test_the_extension_decides_whatever_its_case(self) -> None:
        assert mesh_format("a/b.c/mesh.VTU").name == "VTU"
        assert mesh_format("mesh.vtu", "stl").name == "STL"
        assert mesh_format("mesh", ".PLY").name == "PLY"

    @pytest.mark.parametrize(
        ("name", "message"),
        [
            (
                "mesh.docx",
                r"cannot write '.*mesh\.docx': the extension '\.docx' is no mesh format",
            ),
            (
                "mesh",
                "the name has no extension; choose one of .vtu, .vtk, .msh, .npz, .ply, .obj",
            ),
            ("mesh.vtu.gz", r"the extension '\.gz' is no mesh format"),
        ],
    )
    def test_an_unknown_extension(self, tmp_path: Path, name: str, message: str) -> None:
        with pytest.raises(FileWriteError, match=message):
            write_mesh(SQUARE, tmp_path / name)
        with pytest.raises(FileReadError, match=message.replace("write", "read")):
            read_mesh(tmp_path / name)
        assert names(tmp_path) == []

    def test_an_unknown_format(self, tmp_path: Path) -> None:
        with pytest.raises(
            ParameterError, match=r"unknown mesh format 'docx'; there are \.vtu"
        ):
            write_mesh(SQUARE, tmp_path / "mesh.vtu", file_format="docx")

    @pytest.mark.parametrize("extension", EXTENSIONS)
    def test_a_given_format_goes_before_the_name(self, tmp_path: Path, extension: str) -> None:
        given_name = written(SQUARE, tmp_path / "mesh.dat", file_format=extension[1:])
        own_name = written(SQUARE, tmp_path / f"mesh{extension}")
        assert given_name.read_bytes() == own_name.read_bytes()
        assert names(tmp_path) == ["mesh.dat", f"mesh{extension}"]


class TestFailures:
    @pytest.mark.parametrize("extension", EXTENSIONS)
    def test_a_disk_that_fills_up(self, tmp_path: Path, extension: str) -> None:
        resource = pytest.importorskip("resource")
        points = np.random.default_rng(0).random((3000, 2))
        mesh = Mesh(points, {"triangle": np.arange(3000).reshape(-1, 3)})
        path = tmp_path / f"mesh{extension}"
        path.write_bytes(b"old")
        before = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, before[1]))
        try:
            with pytest.raises(FileWriteError, match=re.escape(f"cannot write '{path}': ")):
                write_mesh(mesh, path)
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, before)
        assert path.read_bytes() == b"old"
        assert names(tmp_path) == [path.name]

    @pytest.mark.parametrize("extension", EXTENSIONS)
    def test_a_missing_folder(self, tmp_path: Path, extension: str) -> None:
        with pytest.raises(FileWriteError, match=r"missing' does not exist .* create it first"):
            written(SQUARE, tmp_path / "missing" / f"mesh{extension}")

    def test_an_interruption_in_the_middle(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        def interrupted(_: Mesh, path: Path) -> None:
            path.write_bytes(b"half")
            raise KeyboardInterrupt

        chosen = dataclasses.replace(MESH_FORMATS[".vtu"], write=interrupted)
        monkeypatch.setitem(MESH_FORMATS, ".vtu", chosen)
        (tmp_path / "mesh.vtu").write_bytes(b"old")
        with pytest.raises(KeyboardInterrupt):
            write_mesh(SQUARE, tmp_path / "mesh.vtu")
        assert (tmp_path / "mesh.vtu").read_bytes() == b"old"
        assert names(tmp_path) == ["mesh.vtu"]

    @pytest.mark.parametrize("extension", WITH_MESHIO)
    def test_without_meshio(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, extension: str
    ) -> None:
        monkeypatch.setitem(sys.modules, "meshio", None)
        with pytest.raises(MissingLibraryError, match=r'pip install "alphamesh\[io\]"'):
            write_mesh(SQUARE, tmp_path / f"mesh{extension}")
        assert names(tmp_path) == []
        (tmp_path / f"mesh{extension}").write_bytes(b"something")
        with pytest.raises(MissingLibraryError, match="needs meshio"):
            read_mesh(tmp_path / f"mesh{extension}")

    def test_the_others_need_numpy_alone(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setitem(sys.modules, "meshio", None)
        for extension in set(EXTENSIONS) - set(WITH_MESHIO):
            assert written(SQUARE, tmp_path / f"mesh{extension}").stat().st_size > 0

    def test_importing_the_module_imports_no_optional_library(self) -> None:
        code = (
            "import sys, alphamesh.io.meshes; "
            "print(sorted({'meshio', 'pandas', 'rich', 'matplotlib'} & set(sys.modules)))"
        )
        command = [sys.executable, "-c", code]
        environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
        done = subprocess.run(
            command, capture_output=True, text=True, check=True, env=environment
        )
        assert done.stdout.strip() == "[]"


class TestReading:
    @pytest.mark.parametrize("extension", EXTENSIONS)
    @pytest.mark.parametrize("content", [b"", b"no mesh at all\n" * 9, bytes(range(256)) * 4])
    def test_a_foreign_file(self, tmp_path: Path, extension: str, content: bytes) -> None:
        path = tmp_path / f"mesh{extension}"
        path.write_bytes(content)
        with pytest.raises(FileReadError, match=rf"cannot read '.*mesh\{extension}' as [A-Z]+"):
            read_mesh(path)

    @pytest.mark.parametrize("extension", (*FULL, ".ply", ".off"))
    def test_a_truncated_file(self, tmp_path: Path, extension: str) -> None:
        path = written(TRIANGLES, tmp_path / f"mesh{extension}")
        content = path.read_bytes()
        path.write_bytes(content[: len(content) * 2 // 3])
        with pytest.raises(FileReadError, match="cannot read"):
            read_mesh(path)

    def test_a_missing_file(self, tmp_path: Path) -> None:
        with pytest.raises(FileReadError, match=r"mesh\.vtu': No such file or directory"):
            read_mesh(tmp_path / "mesh.vtu")

    def test_other_cells_are_named(self, tmp_path: Path) -> None:
        (tmp_path / "quad.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")
        with pytest.raises(FileReadError, match="as OBJ: it has quad cells; convert them"):
            read_mesh(tmp_path / "quad.obj")

    def test_blocks_of_one_kind_are_joined(self, tmp_path: Path) -> None:
        (tmp_path / "groups.obj").write_text(
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng left\nf 1 2 3\ng right\nf 1/1 3/2 4/3\n"
        )
        mesh = read_mesh(tmp_path / "groups.obj")
        assert mesh.cells["triangle"].tolist() == [[0, 1, 2], [0, 2, 3]]
        assert mesh.cell_data == {}


def test_gmsh_tags_far_beyond_the_file_are_refused(tmp_path: Path) -> None:
    """Found by fuzzing: meshio makes a table of all tags up to the largest."""
    path = tmp_path / "tags.msh"
    write_mesh(TRIANGLES, path)
    data = path.read_bytes()
    first = data.index(b"$Nodes\n") + 7 + 32 + 20
    assert data[first : first + 8] == (1).to_bytes(8, "little")
    path.write_bytes(data[:first] + (10**12).to_bytes(8, "little") + data[first + 8 :])
    with pytest.raises(FileReadError, match="tag 1,000,000,000,000"):
        read_mesh(path)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"OFF", "no numbers of vertices, faces and edges"),
        (b"OFF\n# nothing\n\n", "no numbers of vertices, faces and edges"),
        (b"OFF\n3 1\n", "no numbers of vertices, faces and edges"),
        (b"OFF\n3 1000000000000 0\n0 0 0\n", "promises 3 vertices and 1,000,000,000,000"),
    ],
)
def test_off_files_that_are_cut_off(tmp_path, content, said):
    path = tmp_path / "a.off"
    path.write_bytes(content)
    with pytest.raises(FileReadError, match=said):
        read_mesh(path)
