"""Weighted clouds in the plane: triangulation, values and hidden points by definition."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import oracles_weighted
from strategies import FAMILIES
from weighted_samples import WEIGHTS, powers_of, regular2

#: Relative, of a radius.
PROMISED = 1e-14


def assert_by_definition(points, weights):
    result = regular2(points, weights)
    truth = oracles_weighted.weighted_complex(points, weights)
    assert result["dimension"] == truth.dimension
    assert representatives(result, len(points)) == truth.representative
    assert result["hidden"].tolist() == truth.hidden
    values = powers_of(result)
    assert values.keys() == truth.powers.keys()
    for simplex, power in truth.powers.items():
        error = oracles_weighted.relative_error(values[simplex], power)
        assert error <= PROMISED or oracles_weighted.within_a_subnormal(values[simplex], power)
    assert_flat_arrays(result)


def representatives(result, n):
    merged = result["representative"]
    return list(range(n)) if merged is None else merged.tolist()


def assert_flat_arrays(result):
    """Rows ascend, cofaces are right, and values never decrease from face to coface."""
    edges, triangles = result["edges"], result["triangles"]
    assert (np.diff(edges) > 0).all() and (np.diff(triangles) > 0).all()
    assert (np.diff(result["vertices"]) > 0).all() and (np.diff(result["hidden"]) > 0).all()
    at = {edge: i for i, edge in enumerate(map(tuple, edges.tolist()))}
    found = [[] for _ in at]
    for t, (a, b, c) in enumerate(triangles.tolist()):
        for edge in ((a, b), (b, c), (a, c)):
            found[at[edge]].append(t)
            assert result["edge_radii"][at[edge]] <= result["triangle_radii"][t]
    for cofaces, row in zip(found, result["edge_triangles"].tolist(), strict=True):
        assert sorted(cofaces) == sorted(t for t in row if t >= 0)
    place = np.searchsorted(result["vertices"], edges)
    assert np.array_equal(result["vertices"][place], edges)
    if len(edges):
        assert (result["vertex_radii"][place].max(axis=1) <= result["edge_radii"]).all()


def spacing_of(points):
    spread = np.ptp(points, axis=0).max() if len(points) else 1.0
    return (spread or 1.0) / max(1.0, len(points) ** 0.5)


def in_weighted_range(points, weights):
    """Tell whether all lies in the narrower range of weighted clouds, with room to spare."""
    sizes = np.concatenate([np.abs(points).ravel(), np.sqrt(np.abs(weights))])
    sizes = sizes[sizes > 0]
    return not sizes.size or sizes.max() < 2.0**200 * sizes.min()


@pytest.mark.parametrize("kind", WEIGHTS)
@settings(max_examples=25)
@given(data=st.data(), seed=st.integers(0, 2**32 - 1))
def test_is_the_definition(kind, data, seed):
    points = data.draw(st.one_of(*FAMILIES.values()))[:9]
    weights = WEIGHTS[kind](np.random.default_rng(seed), len(points), spacing_of(points))
    if in_weighted_range(points, weights):
        assert_by_definition(points, weights)
