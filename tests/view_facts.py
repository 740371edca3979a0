"""Clouds that the view must show, and what its own code tells of them."""

from __future__ import annotations

import json

import numpy as np

import alphamesh as am
from alphamesh.view import payload
from node import SCRIPTS, run_node

GRID = np.stack(np.meshgrid(np.arange(5.0), np.arange(4.0)), axis=-1).reshape(-1, 2)


CASES = {
    "random": np.random.default_rng(3).random((300, 2)) * [3, 1] + [1e4, -7],
    "shape": am.demo_cloud("target", 500, seed=2),
    "grid": GRID,
    "duplicates": np.concatenate([GRID, GRID[::-1], GRID[3:5]]),
    "line": np.arange(7.0)[:, None] * [1, 2],
    "two": np.array([[0.0, 0], [3, 4]]),
    "one": np.array([[5.0, 5]]),
    "same": np.full((3, 2), 2.0),
    "none": np.empty((0, 2)),
    "tiny": np.random.default_rng(0).random((40, 2)) * 1e-140,
    "large": np.random.default_rng(0).random((40, 2)) * 1e140,
}


# Points with weights: some are hidden, some come late, some are heavier than all else.
_HEAVY = np.random.default_rng(8).lognormal(-3.2, 0.8, 120) ** 2


WEIGHTED = {
    "random": (np.random.default_rng(7).random((120, 2)), _HEAVY),
    "hidden": (np.random.default_rng(7).random((60, 2)), np.repeat([0.01, -3.0], 30)),
    "grid": (GRID, np.tile([0.25, -1.0], 10)),
    "duplicates": (np.repeat(GRID, 2, axis=0), np.arange(40) / 32),
    "equal": (GRID * 0.7, np.full(20, 0.3)),
    "zero": (GRID, np.zeros(20)),
    "negative": (CASES["random"][:40], np.linspace(-5, -1, 40)),
    "line": (CASES["line"], np.array([0, 3, 0, 1, 1, 0.5, 9])),
    "one": (CASES["one"], [4.0]),
    "none": (CASES["none"], []),
    "space": (np.random.default_rng(9).random((90, 3)), _HEAVY[:90]),
    "one in space": ([[1.0, 2, 3]], [-4.0]),
}


SPACE = {
    "random": np.random.default_rng(4).random((150, 3)) * [1, 2, 3] + [5, -1, 1e3],
    "grid": np.stack(np.meshgrid(*[np.arange(4.0)] * 3), axis=-1).reshape(-1, 3),
    "duplicates": np.repeat(np.random.default_rng(5).random((12, 3)), 2, axis=0)[::-1],
    "plane": np.column_stack((np.random.default_rng(6).random((30, 2)), np.zeros(30))),
    "line": np.arange(5.0)[:, None] * [1, 2, 3],
    "one": np.array([[5.0, 5, 5]]),
    "none": np.empty((0, 3)),
}


def packed(cx, **options):
    choice = cx.choose_radius() if len(cx.points) else None
    return payload(cx.persistence(), choice, **options)


def told(cx, radii, folder):
    """Return what the page would show, told by its own code."""
    file = folder / "data.bin"
    file.write_bytes(packed(cx))
    return json.loads(run_node(SCRIPTS / "facts.js", file, *[repr(float(r)) for r in radii]))


def radii_of(cx):
    """Return radii at, just below and between changes."""
    changes = cx.critical_radii()
    some = changes[:: max(1, len(changes) // 25)]
    last = changes[-1:] * 2
    return np.unique(np.concatenate((some, np.nextafter(some, 0)[1:], some * 1.01, last)))


def numbers_of(facts):
    """Return what has to agree to the last digit."""
    vertices, edges, triangles = facts["present"]
    return {
        "vertices": vertices,
        "edges": edges,
        "triangles": triangles,
        "singular_edges": facts["singularEdges"],
        "regular_edges": facts["boundary"],
        "interior_edges": facts["interior"],
        "isolated_vertices": facts["isolated"],
    }


BOXES = {
    "square": ((1, 1), 60, False),
    "strip": ((None, 2), 30, False),
    "weighted": ((1, 1), 50, True),
    "two": ((1, 2), 2, False),
    "one": ((1, 1), 1, False),
    "cube": ((1, 1, 1), 70, False),
    "slab": ((1, 1, None), 60, True),
    "few": ((1, 1, 1), 2, True),
    "flat": ((1, 1, None), 9, False),
    "none": ((1, 1, 1), 0, False),
}


def box_of(name):
    periods, count, weighted = BOXES[name]
    rng = np.random.default_rng(11)
    points = rng.random((count, len(periods)))
    if name == "flat":
        points[:, 2] = 0.5
    weights = rng.random(count) / 20 if weighted else None
    return am.AlphaComplex(points, periods=periods, weights=weights)
