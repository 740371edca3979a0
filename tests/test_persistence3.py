"""Pairs, diagrams, Betti numbers and cycles in space, against matrix reduction and gudhi."""

from __future__ import annotations

import heapq
import json
import math
from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import given

import alphamesh as am
from alphamesh.errors import DimensionError, ParameterError
from reduction import check_pairs, pair_set
from strategies3 import clouds3, complex_of

RNG = np.random.default_rng(23)


def sphere(n, radius=1.0):
    points = RNG.standard_normal((n, 3))
    return radius * points / np.linalg.norm(points, axis=1)[:, np.newaxis]


def torus(n):
    u, v = 2 * np.pi * RNG.random((2, n))
    return np.column_stack(
        ((3 + np.cos(v)) * np.cos(u), (3 + np.cos(v)) * np.sin(u), np.sin(v))
    )


def voxels():
    """Return the lattice points of a block with a tunnel and a cavity: a mask in space."""
    block = np.ones((12, 9, 9), dtype=bool)
    block[2:5, 3:6, :] = False
    block[7:10, 3:6, 3:6] = False
    return np.argwhere(block).astype(float)


PLANE = np.array([[1.0, 2.0, 0.5], [-1.0, 0.5, 3.0]])
CLOUDS = {
    "random": RNG.random((300, 3)),
    "grid": np.array(list(product(range(5), repeat=3)), dtype=float),
    "few integers": RNG.integers(0, 4, (60, 3)).astype(float),
    "torus": torus(400),
    "sphere": sphere(300),
    "voxels": voxels(),
    "hub": np.concatenate((np.zeros((1, 3)), sphere(200))),
    "plane": RNG.random((200, 2)) @ PLANE,
    "grid in a plane": np.array(list(product(range(7), range(6), [2])), dtype=float),
    "line": np.outer(RNG.integers(0, 50, 20), [1.0, 2.0, -1.0]),
    "one": np.array([[3.0, 4.0, 5.0]]),
}


@pytest.fixture(name="ring", scope="module")
def make_ring():
    return am.AlphaComplex(torus(2000))


@given(clouds3())
def test_pairs_are_those_of_matrix_reduction(points):
    check_pairs(complex_of(points).persistence())


@pytest.mark.parametrize("name", ["random", "grid", "torus", "hub", "grid in a plane"])
def test_pairs_of_larger_clouds_are_those_of_matrix_reduction(name):
    check_pairs(am.AlphaComplex(CLOUDS[name][:250]).persistence())


@given(clouds3())
def test_betti_numbers_at_and_between_critical_radii(points):
    cx = complex_of(points)
    found = cx.persistence()
    critical = cx.critical_radii()
    radii = np.concatenate((critical, np.nextafter(critical[1:], 0.0), [math.inf]))
    numbers = found.betti_numbers(radii)
    curve, euler = found.betti_curve(), found.euler_curve()
    for radius, (b0, b1, b2) in zip(radii.tolist(), numbers.tolist(), strict=True):
        shape = cx.at(radius)
        assert shape.betti == (b0, b1, b2)
        assert shape.euler_characteristic == b0 - b1 + b2
        for steps, expected in ((curve, [b0, b1, b2]), (euler, b0 - b1 + b2)):
            step = int(np.searchsorted(steps.radii, radius, side="right")) - 1
            assert steps.values[step].tolist() == expected


@pytest.mark.parametrize("name", CLOUDS)
def test_diagrams_are_those_of_gudhi(name):
    gudhi = pytest.importorskip("gudhi")
    points = np.unique(CLOUDS[name], axis=0)
    tree = gudhi.AlphaComplex(points=points, precision="exact").create_simplex_tree()
    tree.compute_persistence(homology_coeff_field=2, persistence_dim_max=True)
    diagrams = am.AlphaComplex(CLOUDS[name]).persistence().diagrams(squared=True)
    assert len(diagrams) == 3
    for k, mine in enumerate(diagrams):
        theirs = tree.persistence_intervals_in_dimension(k).reshape(-1, 2)
        # Classes that live for less than gudhi's rounding are of no account.
        lasting = [
            rows[rows[:, 1] - rows[:, 0] > 1e-9 * rows[:, 1].clip(max=1e9)]
            for rows in (mine, theirs)
        ]
        assert len(lasting[0]) == len(lasting[1])
        np.testing.assert_allclose(*map(in_order, lasting), rtol=1e-9)


def in_order(rows):
    return rows[np.lexsort((rows[:, 1], np.round(rows[:, 0], 9)))]


def test_shapes_of_known_topology(ring):
    assert ring.at(0.6).betti == (1, 2, 1)
    assert am.AlphaComplex(CLOUDS["voxels"]).at(0.9).betti == (1, 1, 1)
    nested = np.concatenate((sphere(800), sphere(3000, 2.0)))
    assert am.AlphaComplex(nested).at(0.4).betti == (2, 0, 2)
    linked = np.concatenate((torus(4000), torus(4000)[:, [0, 2, 1]] + [3.0, 0.0, 0.0]))
    assert am.AlphaComplex(linked).at(0.45).betti == (2, 4, 2)


def test_a_shape_has_as_many_voids_as_its_second_betti_number():
    shape = am.AlphaComplex(RNG.random((2000, 3))).at(0.06)
    assert shape.betti[2] == len(shape.voids) > 10


def test_the_result_depends_neither_on_threads_nor_on_duplicates():
    points = RNG.random((12_000, 3))
    built = am.filtration(points)
    one, three = (
        am.persistence(am.filtration(points), threads=threads).pairs for threads in (1, 3)
    )
    for k in range(3):
        assert np.array_equal(one[k], three[k])
    twice = am.filtration(np.concatenate((points, points[::-1])))
    pairs = am.persistence(twice).pairs
    # A vertex is named by its position among the distinct ones.
    assert np.array_equal(pairs[0], one[0])
    assert len(twice.simplices[0]) == len(built.simplices[0]) == len(points)


def test_everything_but_one_component_comes_and_goes(ring):
    found = ring.persistence()
    vertices, edges, triangles, tetrahedra = (len(rows) for rows in ring.simplices)
    assert [len(rows) for rows in found.essential] == [1, 0, 0]
    assert len(found.pairs[0]) == vertices - 1
    assert len(found.pairs[1]) == edges - vertices + 1
    assert len(found.pairs[2]) == tetrahedra
    assert len(found.pairs[1]) + tetrahedra == triangles
    assert found.births[2].shape == found.deaths[2].shape == (tetrahedra,)
    assert repr(found).startswith("<Persistence: 2,000 components, ")


# Cycles


def shortest_way(filtration, creator):
    """Return the length of the shortest way around, by Dijkstra's algorithm."""
    radii, edges = filtration.radii[1], filtration.simplices[1]
    older = (radii < radii[creator]) | (
        (radii == radii[creator]) & (np.arange(len(radii)) < creator)
    )
    roads = {}
    for a, b in edges[older].tolist():
        length = math.dist(filtration.points[a], filtration.points[b])
        roads.setdefault(a, []).append((b, length))
        roads.setdefault(b, []).append((a, length))
    start, goal = edges[creator].tolist()
    best, queue = {}, [(0.0, start)]
    while goal not in best:
        length, here = heapq.heappop(queue)
        if here not in best:
            best[here] = length
            for there, step in roads.get(here, ()):
                heapq.heappush(queue, (length + step, there))
    return best[goal]


@pytest.mark.parametrize("name", ["random", "few integers", "torus", "grid in a plane"])
def test_loops_are_the_shortest_through_the_edge_that_closes_them(name):
    found = am.AlphaComplex(CLOUDS[name]).persistence()
    filtration = found.filtration
    number = {tuple(row): i for i, row in enumerate(filtration.simplices[1].tolist())}
    classes = np.flatnonzero(found.births[1] < found.deaths[1])[::7]
    loops = found.loops(classes)
    assert np.array_equal(loops.classes, classes)
    for loop, creator in zip(loops, found.pairs[1][classes, 0].tolist(), strict=True):
        path = loop.tolist()
        assert len(set(path)) == len(path) >= 3
        steps = [number[tuple(sorted(step))] for step in pairwise(path)]
        assert number[path[0], path[-1]] == creator
        order = [(filtration.radii[1][edge], edge) for edge in (creator, *steps)]
        assert max(order) == order[0]
        length = sum(
            math.dist(filtration.points[a], filtration.points[b]) for a, b in pairwise(path)
        )
        assert math.isclose(length, shortest_way(filtration, creator), rel_tol=1e-12)


def turns(angles):
    """Return how often a closed path winds around, from its angle at each corner."""
    steps = np.diff(np.append(angles, angles[0]))
    return round(np.sum((steps + np.pi) % (2 * np.pi) - np.pi) / (2 * np.pi))


def test_the_loops_of_a_torus_go_around_its_tube_and_its_hole(ring):
    found = ring.persistence()
    winding = []
    for loop in found.loops(found.alive(0.6)):
        x, y, z = ring.points[loop].T
        winding.append((turns(np.arctan2(y, x)), turns(np.arctan2(z, np.hypot(x, y) - 3))))
    # A basis: no sum of them over Z/2 goes around nothing.
    (a, b), (c, d) = winding
    assert (a * d - b * c) % 2 == 1
    assert {(abs(u), abs(v)) for u, v in winding} >= {(0, 1)}


def volume(points, triangles):
    """Return the volume that closed surfaces enclose."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def test_shells_go_around_the_voids_of_nested_spheres():
    cx = am.AlphaComplex(np.concatenate((sphere(600), sphere(2400, 2.0))))
    found = cx.persistence()
    shells = found.voids(found.alive(0.4, dimension=2))
    ball = 4 / 3 * np.pi
    sizes = sorted(volume(cx.points, shell) for shell in shells)
    assert len(shells) == len(sizes) == 2
    assert 0.95 * ball < sizes[0] < ball  # within the inner sphere
    assert 0.93 * 7 * ball < sizes[1] < 7.2 * ball  # between the two, which it touches
    inner, outer = (np.unique(shell) for shell in sorted(shells, key=len))
    assert set(inner.tolist()) < set(outer.tolist()) == set(range(3000))


@given(clouds3())
def test_shells_are_closed_and_older_than_the_void(points):
    found = complex_of(points).persistence()
    filtration = found.filtration
    number = {tuple(row): i for i, row in enumerate(filtration.simplices[2].tolist())}
    for row, shell in enumerate(found.voids(range(len(found.pairs[2])))):
        creator = int(found.pairs[2][row, 0])
        named = [number[tuple(sorted(triangle))] for triangle in shell.tolist()]
        assert creator in named
        order = [(filtration.radii[2][t], t) for t in (creator, *named)]
        assert max(order) == order[0]
        # Each edge is run along as often one way as the other.
        balance = {}
        for a, b, c in shell.tolist():
            for u, v in ((a, b), (b, c), (c, a)):
                edge = min(u, v), max(u, v)
                balance[edge] = balance.get(edge, 0) + (1 if u < v else -1)
        assert not any(balance.values())


def test_shells_enclose_what_fills_them():
    found = am.AlphaComplex(RNG.random((150, 3))).persistence()
    filtration = found.filtration
    for row in range(0, len(found.pairs[2]), 5):
        shell = found.voids(row)[0]
        filled = filtration.tetrahedron_volumes[found.pairs[2][row, 1]]
        assert volume(filtration.points, shell) >= filled * (1 - 1e-9)


def test_no_classes_give_no_cycles(ring):
    found = ring.persistence()
    assert len(found.loops([])) == len(found.voids([])) == 0
    assert found.voids([]).triangles.shape == (0, 3)


def test_what_is_wrong_is_named(ring):
    found = ring.persistence()
    with pytest.raises(ParameterError, match=r"dimension must be 0 .* got 3"):
        found.diagram(3)
    with pytest.raises(ParameterError, match=r"there is no class 1000000000: pairs\[2\]"):
        found.voids(10**9)
    with pytest.raises(ParameterError, match=r"rows of pairs\[2\]"):
        found.voids([0.5])
    with pytest.raises(DimensionError, match="in the plane alone"):
        found.holes(0)
    flat = am.AlphaComplex(RNG.random((20, 2))).persistence()
    with pytest.raises(DimensionError, match="in space alone"):
        flat.voids(0)
    assert pair_set(flat.pairs[2]) == set()


# What is slow


def test_progress_rises_to_one_and_an_error_in_it_ends_the_work():
    built = am.filtration(RNG.random((60_000, 3)))
    shares = []
    am.persistence(built, progress=shares.append)
    assert shares == sorted(shares)
    assert shares[-1] == 1.0

    def stop(share):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        am.persistence(am.filtration(built.points), progress=stop)


# From the shell


def test_the_command_tells_of_loops_and_voids(tmp_path):
    testing = pytest.importorskip("click.testing")
    pytest.importorskip("rich")
    pytest.importorskip("matplotlib")
    from alphamesh.cli.app import app

    cloud, table, picture = (tmp_path / name for name in ("a.npy", "pairs.csv", "bars.png"))
    np.save(cloud, CLOUDS["sphere"])
    words = ["persistence", cloud, "--squared", "-o", table, "--plot", picture, "-r", "0.5"]
    words = [str(word) for word in (*words, "--plot-as", "barcode")]
    told = testing.CliRunner().invoke(app, words)
    assert told.exit_code == 0, told.output
    assert "\nLoops " in told.stdout and "\nLongest voids " in told.stdout
    assert picture.stat().st_size > 5000
    squares = am.AlphaComplex(CLOUDS["sphere"]).persistence().diagrams(squared=True)
    rows = np.loadtxt(table, delimiter=",", skiprows=1)
    assert np.array_equal(rows[:, 0], np.repeat([0, 1, 2], [len(d) for d in squares]))
    assert np.array_equal(rows[:, 1:], np.concatenate(squares))
    facts = json.loads(testing.CliRunner().invoke(app, [*words[:2], "--json"]).stdout)
    assert [facts[name] for name in ("components", "loops", "voids")] == list(map(len, squares))
    longest = max(facts["longest_voids"], key=lambda life: life[1] - life[0])
    assert facts["longest_voids"][0] == longest
    assert longest[1] == pytest.approx(1.0)
