"""The compiled core in space, its results by name."""

from __future__ import annotations

import numpy as np

from alphamesh._kernels import _core

NAMES = [
    "dimension",
    "representative",
    "tetrahedra",
    "tetrahedron_radii",
    "triangles",
    "triangle_radii",
    "triangle_tetrahedra",
    "edges",
    "edge_radii",
]
WEIGHTED = [
    "dimension",
    "representative",
    "hidden",
    *NAMES[2:],
    "vertices",
    "vertex_radii",
]


def alpha3(points, threads=1):
    points = np.ascontiguousarray(points, dtype=float)
    return dict(zip(NAMES, _core.alpha3(points, threads, None), strict=True))


def regular3(points, weights, threads=1):
    points = np.ascontiguousarray(points, dtype=float)
    weights = np.ascontiguousarray(weights, dtype=float)
    return dict(zip(WEIGHTED, _core.regular3(points, weights, threads, None), strict=True))


def row_set(rows):
    return {tuple(row) for row in np.sort(rows, axis=1).tolist()}
