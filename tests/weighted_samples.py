"""Weighted clouds that break careless geometry, and the compiled core's results by name."""

from __future__ import annotations

import numpy as np

from alphamesh._kernels import _core

NAMES_2 = [
    "dimension",
    "representative",
    "hidden",
    "triangles",
    "triangle_radii",
    "edges",
    "edge_radii",
    "edge_triangles",
    "vertices",
    "vertex_radii",
]

#: Weights by kind, for a cloud whose points lie about `spacing` apart.
WEIGHTS = {
    "none": lambda rng, n, spacing: np.zeros(n),
    "equal": lambda rng, n, spacing: np.full(n, spacing**2 / 4),
    "small": lambda rng, n, spacing: rng.random(n) * spacing**2 / 8,
    "as large as cells": lambda rng, n, spacing: rng.normal(size=n) * spacing**2,
    "many hidden": lambda rng, n, spacing: rng.exponential(size=n) * 20 * spacing**2,
    "integers": lambda rng, n, spacing: rng.integers(-3, 9, n).astype(float),
    "negative": lambda rng, n, spacing: -rng.random(n) * spacing**2,
    "extreme": lambda rng, n, spacing: spacing**2 * 10.0 ** rng.uniform(-12, 4, n),
    "hairs": lambda rng, n, spacing: rng.integers(0, 2, n) * spacing**2 * 2.0**-45,
}


def regular2(points, weights, threads=1):
    points = np.ascontiguousarray(points, dtype=float)
    weights = np.ascontiguousarray(weights, dtype=float)
    return dict(zip(NAMES_2, _core.regular2(points, weights, threads, None), strict=True))


def powers_of(result):
    """Return every simplex of a result in the plane with its signed root."""
    rows = (result["vertices"].reshape(-1, 1), result["edges"], result["triangles"])
    radii = (result["vertex_radii"], result["edge_radii"], result["triangle_radii"])
    return {
        tuple(simplex): value
        for simplices, values in zip(rows, radii, strict=True)
        for simplex, value in zip(simplices.tolist(), values.tolist(), strict=True)
    }
