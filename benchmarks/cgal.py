"""The peer CGAL, compiled on the spot where its headers and a compiler are there."""

from __future__ import annotations

import ctypes
import os
import shutil
import subprocess
import tempfile
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

__all__ = ["cgal_delaunay3"]

_SOURCE = Path(__file__).with_name("cgal.cpp")
_FLAGS = ("-O3", "-DNDEBUG", "-std=c++17", "-frounding-math", "-shared", "-fPIC")


def cgal_delaunay3(points: np.ndarray[Any, np.dtype[np.float64]]) -> int:
    """Triangulate points in space with CGAL; return the number of tetrahedra.

    Raises
    ------
    ImportError
        If CGAL cannot be compiled here.
    """
    coordinates = np.ascontiguousarray(points, dtype=np.float64)
    found = _library().cgal_delaunay3(coordinates.ctypes.data, len(coordinates))
    return int(found)


@cache
def _library() -> Any:
    compiler = os.environ.get("CXX") or shutil.which("c++") or shutil.which("g++")
    if compiler is None:
        raise ImportError("there is no C++ compiler")
    folder = tempfile.mkdtemp()
    try:
        built = Path(folder) / "cgal.so"
        command = [compiler, *_FLAGS, str(_SOURCE), "-o", str(built), "-lgmp", "-lmpfr"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            raise ImportError("CGAL and its headers are not installed, or too old")
        library = ctypes.CDLL(str(built))
    finally:
        shutil.rmtree(folder)  # loaded, it needs no file
    library.cgal_delaunay3.argtypes = [ctypes.c_void_p, ctypes.c_long]
    library.cgal_delaunay3.restype = ctypes.c_long
    return library
