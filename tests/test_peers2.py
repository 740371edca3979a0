"""Other programs agree, where they are installed and as far as they promise to."""

from __future__ import annotations

import numpy as np
import pytest

import oracles
from alphamesh.delaunay import delaunay
from alphamesh.filtration import filtration
from strategies import CIRCLES


def random_cloud(kind, n, seed=0):
    rng = np.random.default_rng(seed)
    return {
        "uniform": lambda: rng.uniform(size=(n, 2)),
        "normal": lambda: rng.normal(size=(n, 2)),
        "clusters": lambda: rng.normal(size=(n, 2)) * 10.0 ** rng.integers(-3, 3, (n, 1)),
        "ring": lambda: (
            rng.normal(size=(n, 2)) * 0.01
            + np.exp(1j * rng.uniform(0, 7, n)).view(float).reshape(-1, 2)
        ),
        "far off": lambda: rng.uniform(size=(n, 2)) + 1e4,
        "flat": lambda: rng.uniform(size=(n, 2)) * [1.0, 1e-3],
    }[kind]()


KINDS = ("uniform", "normal", "clusters", "ring", "far off", "flat")


# What Qhull, in plain floating point, can be trusted with.
EASY = ("uniform", "normal", "ring", "flat")


@pytest.mark.parametrize("kind", EASY)
@pytest.mark.parametrize("n", [30, 3000])
def test_triangles_of_scipy(kind, n):
    """Without ties there is one Delaunay triangulation."""
    spatial = pytest.importorskip("scipy.spatial")
    points = random_cloud(kind, n)
    peer = spatial.Delaunay(points)
    ours = delaunay(points)
    assert oracles.row_set(np.sort(peer.simplices, axis=1)) == oracles.row_set(ours.triangles)
    # SciPy's neighbours too are numbered by the opposite vertex.
    turn = np.argsort(peer.simplices, axis=1)
    theirs = np.take_along_axis(peer.simplices, turn, axis=1)
    rows = [np.lexsort(t.T[::-1]) for t in (theirs, ours.triangles)]
    to_ours = np.empty(len(theirs) + 1, dtype=int)
    to_ours[rows[0]], to_ours[-1] = rows[1], -1
    neighbors = to_ours[np.take_along_axis(peer.neighbors, turn, axis=1)]
    assert np.array_equal(neighbors[rows[0]], ours.neighbors[rows[1]])


@pytest.mark.parametrize("kind", sorted(set(KINDS) - set(EASY)))
def test_where_scipy_differs_its_circles_hold_a_point(kind):
    spatial = pytest.importorskip("scipy.spatial")
    points = random_cloud(kind, 3000)
    theirs = oracles.row_set(np.sort(spatial.Delaunay(points).simplices, axis=1))
    ours = oracles.row_set(delaunay(points).triangles)
    exact, _ = oracles.lattice(points)
    assert len(theirs - ours) < 100
    for i, j, k in theirs - ours:
        a, b, c = exact[i], exact[j], exact[k]
        if oracles.orient(a, b, c) < 0:
            b, c = c, b
        flat = oracles.orient(a, b, c) == 0
        assert flat or any(oracles.in_circle(a, b, c, d) > 0 for d in exact)


@pytest.mark.parametrize("kind", KINDS)
def test_hull_of_scipy(kind):
    spatial = pytest.importorskip("scipy.spatial")
    points = random_cloud(kind, 3000)
    ours = delaunay(points)
    row, corner = np.nonzero(ours.neighbors < 0)
    hull = {
        (*np.delete(ours.triangles[t], c).tolist(),) for t, c in zip(row, corner, strict=True)
    }
    assert hull == oracles.row_set(np.sort(spatial.ConvexHull(points).simplices, axis=1))


def gudhi_values(points, precision):
    """Return the squared values of gudhi by dimension: simplices and values."""
    gudhi = pytest.importorskip("gudhi")
    # The tree must be kept: what get_filtration() returns does not keep it alive.
    tree = gudhi.AlphaComplex(points=points, precision=precision).create_simplex_tree()
    found = [[], [], []]
    for simplex, value in tree.get_filtration():
        found[len(simplex) - 1].append((*sorted(simplex), value))
    return [np.array(sorted(rows)).reshape(len(rows), k + 2) for k, rows in enumerate(found)]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("precision", "error"), [("exact", 1e-13), ("safe", 1e-5)])
def test_values_of_gudhi(kind, precision, error):
    """Simplex by simplex; gudhi's default, "safe", promises five digits."""
    points = random_cloud(kind, 400, seed=1)
    ours = filtration(points)
    for k, theirs in enumerate(gudhi_values(points, precision)):
        order = np.lexsort(ours.simplices[k].T[::-1])
        assert np.array_equal(ours.simplices[k][order], theirs[:, :-1])
        np.testing.assert_allclose(ours.radii[k][order] ** 2, theirs[:, -1], rtol=error)


def tied_clouds():
    y, x = np.mgrid[0:12, 0:15]
    grid = np.column_stack((x.ravel(), y.ravel())).astype(float)
    rng = np.random.default_rng(2)
    return {
        "grid": grid,
        "grid with holes": grid[rng.uniform(size=len(grid)) < 0.6],
        "turned grid": grid @ np.array([[2.0, 1.0], [-1.0, 2.0]]),
        "hexagons": np.array(
            [(2 * x + y % 2, 2 * y) for y in range(8) for x in range(8)], float
        ),
        "circle": np.array(CIRCLES[65], dtype=float),
        "circle and centre": np.array([*CIRCLES[65], (0, 0)], dtype=float),
    }


@pytest.mark.parametrize("name", tied_clouds())
def test_values_of_gudhi_with_ties(name):
    """Each may choose its own diagonals, but their values are the same."""
    points = tied_clouds()[name]
    ours = filtration(points)
    for k, theirs in enumerate(gudhi_values(points, "exact")):
        np.testing.assert_allclose(
            np.sort(ours.radii[k]) ** 2, np.sort(theirs[:, -1]), rtol=1e-13
        )


def test_gabriel_simplices_of_gudhi_with_ties():
    """What does not depend on the diagonals must be there in both."""
    points = tied_clouds()["grid with holes"]
    ours = filtration(points)
    theirs = gudhi_values(points, "exact")
    lengths = np.hypot(*(points[ours.simplices[1][:, 0]] - points[ours.simplices[1][:, 1]]).T)
    sure = ours.simplices[1][(ours.radii[1] == lengths / 2) & (lengths < 1.2)]
    peer = {tuple(row) for row in theirs[1][:, :-1].astype(int).tolist()}
    assert len(sure) > 100
    assert oracles.row_set(sure) <= peer


def test_persistence_of_gudhi():
    """Our values as a simplex tree: a filtration, with gudhi's own diagram."""
    gudhi = pytest.importorskip("gudhi")
    points = random_cloud("ring", 300, seed=3)
    ours = filtration(points)
    tree = gudhi.SimplexTree()
    for simplices, radii in zip(ours.simplices, ours.radii, strict=True):
        tree.insert_batch(np.ascontiguousarray(simplices.T), radii)
    assert not tree.make_filtration_non_decreasing()
    peer = gudhi.AlphaComplex(points=points, precision="exact").create_simplex_tree()
    tree.compute_persistence()
    peer.compute_persistence()
    for dimension in (0, 1):
        found = tree.persistence_intervals_in_dimension(dimension)
        expected = np.sqrt(peer.persistence_intervals_in_dimension(dimension))
        long = [i[i[:, 1] - i[:, 0] > 1e-9] for i in (found, expected)]
        np.testing.assert_allclose(*(i[np.lexsort(i.T)] for i in long), rtol=1e-12)


@pytest.mark.parametrize("kind", ["uniform", "clusters", "far off"])
def test_simplices_of_shull(kind):
    shull = pytest.importorskip("shull")
    points = random_cloud(kind, 2000, seed=4)
    peer = np.asarray(shull.Delaunay(points).simplices)
    assert oracles.row_set(np.sort(peer, axis=1)) == oracles.row_set(delaunay(points).triangles)


@pytest.mark.parametrize("kind", ["uniform", "clusters"])
def test_values_of_diode(kind):
    diode = pytest.importorskip("diode")
    points = random_cloud(kind, 500, seed=5)
    peer = {tuple(sorted(s)): v for s, v in diode.fill_alpha_shapes(points, exact=True)}
    ours = filtration(points)
    count = 0
    for simplices, radii in zip(ours.simplices, ours.radii, strict=True):
        for simplex, radius in zip(simplices.tolist(), radii.tolist(), strict=True):
            assert peer[tuple(simplex)] == pytest.approx(radius**2, rel=1e-12)
            count += 1
    assert count == len(peer)


def test_a_line_that_qhull_refuses():
    spatial = pytest.importorskip("scipy.spatial")
    line = np.arange(10.0)[:, np.newaxis] * [1.0, 1.0]
    with pytest.raises(spatial.QhullError):
        spatial.Delaunay(line)
    result = filtration(line)
    assert result.radii[1].tolist() == [np.sqrt(0.5)] * 9
    assert len(result.simplices[2]) == 0
