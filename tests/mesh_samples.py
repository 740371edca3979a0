"""Meshes to write, and ways to compare them, for the tests of mesh files."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import numpy as np
from hypothesis import strategies as st

from alphamesh.errors import LossyFormatWarning
from alphamesh.io._mesh import CELL_CORNERS
from alphamesh.io.meshes import MESH_FORMATS, Mesh, write_mesh

FULL = (".vtu", ".vtk", ".msh", ".npz")
WITH_MESHIO = (".vtu", ".vtk")
EXTENSIONS = tuple(MESH_FORMATS)

# Two triangles of a square, an edge away from it, a point on its own, and two unused points.
POINTS = np.array(
    [[0.1, 0.2], [9, 9], [1, 0], [1, 1 / 3], [-0.0, 1], [2e-9, 3e9], [5, 5], [9, 9]]
)
SQUARE = Mesh(
    POINTS,
    {"triangle": np.array([[0, 2, 3], [0, 3, 4]]), "line": np.array([[2, 5]]), "vertex": [6]},
    {"height": np.linspace(0, 1, 8), "label": np.arange(8)[::-1]},
    {"radius": {"vertex": [0.0], "line": [0.7], "triangle": [0.5, 1 / 3]}},
)
TRIANGLES = SQUARE.only(("triangle",))
KEPT = [0, 2, 3, 4, 5, 6]


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def written(mesh: Mesh, path: Path, **options: Any) -> Path:
    """Write a mesh, whatever is lost."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", LossyFormatWarning)
        write_mesh(mesh, path, **options)
    return path


def same(left: Any, right: Any) -> bool:
    """Compare float64 arrays bit by bit: -0.0 is not 0.0."""
    left, right = (
        np.ascontiguousarray(left, np.float64),
        np.ascontiguousarray(right, np.float64),
    )
    return left.shape == right.shape and bool(np.array_equal(left.view("i8"), right.view("i8")))


def in_space(points: np.ndarray) -> np.ndarray:
    return points if points.shape[1] == 3 else np.column_stack([points, np.zeros(len(points))])


@st.composite
def meshes(
    draw: st.DrawFn, kinds: tuple[str, ...] = tuple(CELL_CORNERS), least: int = 0
) -> Mesh:
    """Return any mesh at all: cells may be degenerate, points far apart or equal."""
    n = draw(st.integers(1, 9))
    real = st.floats(allow_nan=False, allow_infinity=False)
    dimension = draw(st.sampled_from([2, 3]))
    points = np.array(draw(st.lists(real, min_size=n * dimension, max_size=n * dimension)))
    row = st.integers(0, n - 1)
    cells, radii = {}, {}
    for kind in draw(st.permutations(kinds)):
        corners = CELL_CORNERS[kind]
        cell = st.lists(row, min_size=corners, max_size=corners)
        rows = draw(st.lists(cell, min_size=least, max_size=4))
        cells[kind] = np.array(rows, dtype=draw(st.sampled_from(["i4", "i8", "u2"])))
        radii[kind] = np.array(draw(st.lists(real, min_size=len(rows), max_size=len(rows))))
    number = st.integers(-(2**31), 2**31 - 1)
    labels = np.array(draw(st.lists(number, min_size=n, max_size=n)))
    return Mesh(points.reshape(n, dimension), cells, {"label": labels}, {"radius": radii})
