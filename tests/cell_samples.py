"""Clouds whose cells several tests look at, and their cells."""

from __future__ import annotations

import numpy as np

from alphamesh.filtration import filtration
from alphamesh.restricted import restricted_voronoi


def grid(columns, rows, factor=1.0):
    y, x = np.mgrid[0:rows, 0:columns]
    return np.column_stack((x.ravel(), y.ravel())) * factor


def random_cloud(n=400, seed=1):
    return np.random.default_rng(seed).random((n, 2))


def cells_of(points, radius):
    return restricted_voronoi(filtration(points), radius)
