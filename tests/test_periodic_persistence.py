"""Persistence on the torus: pairs are those of the whole boundary matrix."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings

import alphamesh as am
from alphamesh.errors import EmptyCloudError, ParameterError, PeriodicError
from alphamesh.periodic import periodic_persistence
from periodic_oracle import matrix_pairs
from reduction import pair_set
from test_periodic import boxes, grid


def check_pairs(points, periods):
    made = am.AlphaComplex(points, periods=periods)
    pairs, staying = matrix_pairs(made.filtration)
    found = made.persistence()
    for k in range(len(periods) + 1):
        assert pair_set(found.pairs[k]) == pairs[k]
        assert set(found.essential[k].tolist()) == staying[k]


@settings(max_examples=60, deadline=None)
@given(boxes(most=10))
def test_pairs_are_those_of_the_matrix(box):
    check_pairs(*box)


@pytest.mark.parametrize(
    ("points", "periods"),
    [
        (np.random.default_rng(1).random((60, 2)), (1, 1)),
        (np.random.default_rng(2).random((40, 3)), (1, 1, 1)),
        (np.random.default_rng(3).random((40, 3)), (1, 1, None)),
        (np.random.default_rng(4).random((40, 3)), (None, 1, None)),
        (grid((3, 3, 3)), (3, 3, 3)),
        (grid((4, 3)), (4, None)),
    ],
)
def test_pairs_of_larger_clouds_are_those_of_the_matrix(points, periods):
    check_pairs(points, periods)


def test_diagrams_end_with_the_classes_of_the_torus():
    points = np.random.default_rng(5).random((200, 3))
    made = am.AlphaComplex(points, periods=(1, 1, 1))
    diagrams = made.persistence().diagrams()
    assert [int(np.isinf(rows[:, 1]).sum()) for rows in diagrams] == [1, 3, 3, 1]
    # The last class is born when the last hollow is filled.
    assert diagrams[3][0, 0] == made.radii[3].max()
    curve = made.persistence().betti_curve()
    assert curve.values[-1].tolist() == [1, 3, 3, 1]
    assert curve.values[0].tolist() == [200, 0, 0, 0]
    assert made.persistence().euler_curve().values[-1] == 0
    for radius in (0.05, 0.09, 0.12):
        shape = made.at(radius)
        assert sum((-1) ** k * b for k, b in enumerate(shape.betti)) == shape.euler
        assert tuple(made.persistence().betti_numbers(radius)) == shape.betti


def test_squared_diagrams_are_those_of_gudhi_on_the_same_complex():
    gudhi = pytest.importorskip("gudhi")
    made = am.AlphaComplex(np.random.default_rng(6).random((80, 2)), periods=(1, 1))
    tree = made.to_gudhi(squared=True)
    assert isinstance(tree, gudhi.SimplexTree)
    tree.compute_persistence(
        homology_coeff_field=2, min_persistence=-1, persistence_dim_max=True
    )
    for k in range(3):
        own = made.persistence().diagram(k, squared=True)
        theirs = tree.persistence_intervals_in_dimension(k)
        theirs = theirs[theirs[:, 0] < theirs[:, 1]]
        theirs = theirs[np.lexsort((theirs[:, 1], theirs[:, 0]))]
        assert np.allclose(own, theirs, rtol=1e-14)


def test_what_is_no_simplicial_complex_is_no_tree():
    pytest.importorskip("gudhi")
    made = am.AlphaComplex([[0.1, 0.2]], periods=(1, 1))
    with pytest.raises(PeriodicError, match="tiled"):
        made.to_gudhi()
    tree = made.tiled(3).to_gudhi()
    tree.compute_persistence(homology_coeff_field=2, persistence_dim_max=True)
    assert tree.betti_numbers() == [1, 2, 1]


def test_bad_questions():
    found = am.AlphaComplex([[0.1, 0.2]], periods=(1, 1)).persistence()
    with pytest.raises(ParameterError, match="0, 1, 2"):
        found.diagram(3)
    with pytest.raises(ParameterError, match="periodic"):
        periodic_persistence(am.AlphaComplex([[0.1, 0.2]]).filtration)
    assert (
        repr(found)
        == "<PeriodicPersistence: 0 components, 0 loops that end; 1, 2, 1 that stay>"
    )


# Radii


def test_radii_are_chosen_by_homology():
    ring = np.linspace(0, 1, 40, endpoint=False)
    points = np.column_stack((ring, np.full(40, 0.5)))
    made = am.AlphaComplex(points, periods=(1, 1))
    chosen = made.choose_radius("longest-interval")
    assert chosen.betti == (1, 1, 0)
    assert chosen.interval[0] == pytest.approx(1 / 80)
    percolates = made.choose_radius("percolation")
    assert percolates.radius == pytest.approx(1 / 80)
    assert percolates.betti[1] == 1
    connected = made.choose_radius()
    assert connected.rule == "connected"
    assert connected.radius == pytest.approx(1 / 80)
    assert connected.betti[0] == 1
    assert made.at().radius == connected.radius


def test_the_longest_interval_comes_after_points_have_met():
    made = am.AlphaComplex(np.random.default_rng(7).random((40, 3)), periods=(1, 1, 1))
    chosen = made.choose_radius("longest-interval")
    assert chosen.radius > made.radii[1].min()
    low, high = chosen.interval
    widths = np.diff(made.persistence().betti_curve().radii)[1:]
    assert high - low == pytest.approx(widths.max(), rel=1e-12)


def test_rules_without_meaning_are_refused():
    made = am.AlphaComplex([[0.1, 0.2]], periods=(1, 1))
    with pytest.raises(PeriodicError, match="without periods"):
        made.choose_radius("topology")
    with pytest.raises(ParameterError, match="percolation"):
        made.choose_radius("nonsense")
    with pytest.raises(ParameterError, match="no option"):
        made.choose_radius("connected", holes=2)
    with pytest.raises(EmptyCloudError):
        am.AlphaComplex(np.empty((0, 2)), periods=(1, 1)).choose_radius()
