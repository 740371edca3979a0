"""What an input is: a demo shape, an image, a mesh or a file of points."""

from __future__ import annotations

import zipfile
from pathlib import Path, PurePath

__all__ = [
    "DEMO",
    "DEMO_PREFIX",
    "IMAGE",
    "MESH",
    "POINTS",
    "holds",
    "kind_of",
    "ply_elements",
]

DEMO, IMAGE, MESH, POINTS = "demo", "image", "mesh", "points"

_HEADER_BYTES = 1 << 16
DEMO_PREFIX = "demo:"
_IMAGE_SUFFIXES = frozenset(
    {".avif", ".bmp", ".gif", ".ico", ".jp2", ".jpeg", ".jpg", ".pbm", ".pcx", ".pgm", ".png"}
    | {".pnm", ".ppm", ".qoi", ".tga", ".tif", ".tiff", ".webp"}
)
_MESH_SUFFIXES = frozenset({".vtu", ".vtk", ".msh", ".obj", ".off", ".stl"})


def kind_of(source: str, file_format: str | None = None) -> str:
    """Return what `source` is by its name: "demo", "image", "mesh" or "points"."""
    if source.startswith(DEMO_PREFIX):
        return DEMO
    suffix = PurePath(source).suffix.lower()
    if file_format is not None:
        suffix = f".{file_format.lower().removeprefix('.')}"
    if suffix in _IMAGE_SUFFIXES:
        return IMAGE
    return MESH if suffix in _MESH_SUFFIXES else POINTS


def holds(source: str, file_format: str | None = None) -> str:
    """Return what is in a file, "mesh" or "points" also where its format can hold both."""
    kind = kind_of(source, file_format)
    suffix = PurePath(source).suffix.lower()
    if kind != POINTS or file_format is not None or not Path(source).is_file():
        return kind
    if suffix == ".npz":
        return MESH if _is_mesh_archive(source) else POINTS
    if suffix == ".ply":
        elements = ply_elements(source)
        return MESH if elements.get("face", 0) or elements.get("edge", 0) else POINTS
    return kind


def ply_elements(source: str) -> dict[str, int]:
    """Return the count of each element that the header of a PLY file tells."""
    with Path(source).open("rb") as file:
        words = file.read(_HEADER_BYTES).partition(b"end_header")[0].split()
    return {
        name.decode(errors="replace"): int(count)
        for word, name, count in zip(words, words[1:], words[2:], strict=False)
        if word == b"element" and count.isdigit()
    }


def _is_mesh_archive(source: str) -> bool:
    """Return whether an NPZ file holds a mesh, not just points."""
    try:
        with zipfile.ZipFile(source) as archive:
            return "triangles.npy" in archive.namelist()
    except zipfile.BadZipFile:
        return False  # whoever reads it next explains
