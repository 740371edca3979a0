"""Sets of triangles for tests: from pictures, at random; and their parts by definition."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st

import alphamesh as am
from complexes import complexes, shapes


def from_picture(lines):
    """Return the squares marked ``#`` of a picture, one unit each, y up from the last line."""
    rows, columns = len(lines), len(lines[0])
    y, x = np.mgrid[0 : rows + 1, 0 : columns + 1]
    corners = np.column_stack((x.ravel(), y.ravel())).astype(float)
    filtration = am.filtration(corners)
    middles = corners[filtration.simplices[2]].mean(axis=1).astype(int)
    marked = np.array([[mark == "#" for mark in line] for line in lines[::-1]])
    return am.Selection(filtration, np.inf, marked[middles[:, 1], middles[:, 0]])


def random_selection(filtration, rng):
    """Return about a share of the triangles: many pinches, holes and islands."""
    share = rng.choice([0.3, 0.5, 0.7, 0.9])
    return am.Selection(filtration, np.inf, rng.random(len(filtration.simplices[2])) < share)


@st.composite
def selections(draw):
    filtration = draw(complexes()).filtration
    count = len(filtration.simplices[2])
    marks = draw(st.lists(st.booleans(), min_size=count, max_size=count))
    return am.Selection(filtration, np.inf, np.array(marks, dtype=bool))


def planar_shapes():
    """Return alpha shapes, and any triangles of nasty clouds."""
    return st.one_of(shapes(), selections())


def rows(array):
    return [tuple(row) for row in array.tolist()]


def inside_rows(shape):
    """Return the rows of the filtration's triangles that the shape has."""
    return np.flatnonzero(shape.kinds[2]).tolist()


def components(members, edge_triangles):
    """Return the sets of triangles, of those given, that are connected by edges."""
    members, parts = set(members), []
    across = {t: [] for t in members}
    for s, t in edge_triangles.tolist():
        if s in members and t in members:
            across[s].append(t)
            across[t].append(s)
    while members:
        part, front = set(), [members.pop()]
        while front:
            part.add(t := front.pop())
            new = [other for other in across[t] if other in members]
            members.difference_update(new)
            front += new
        parts.append(part)
    return parts


def regions_by_definition(shape):
    return components(inside_rows(shape), shape.filtration.edge_triangles)


def holes_by_definition(shape):
    """Return connected sets of other triangles that no hull edge opens to the outside."""
    edge_triangles = shape.filtration.edge_triangles
    others = set(range(len(shape.filtration.simplices[2]))) - set(inside_rows(shape))
    at_hull = {t for t, other in edge_triangles.tolist() if other < 0}
    return [part for part in components(others, edge_triangles) if not part & at_hull]
