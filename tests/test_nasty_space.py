"""Clouds in space that are meant to break things, each checked by the definition."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nasty_space import KINDS, check_cloud, check_tetrahedra, nasty_cloud
from space_core import alpha3


@pytest.mark.parametrize("kind", range(len(KINDS)), ids=[kind.__name__ for kind in KINDS])
def test_nasty_clouds(kind):
    for seed in range(kind, kind + 20 * len(KINDS), len(KINDS)):
        check_cloud(*nasty_cloud(seed))


@settings(deadline=None, max_examples=60)
@given(st.lists(st.tuples(*[st.integers(-2, 2)] * 3), min_size=1, max_size=12))
def test_any_small_integers(points):
    check_cloud(np.array(points))


def test_the_check_sees_what_is_wrong():
    points = [(0, 0, 0), (4, 0, 0), (0, 4, 0), (0, 0, 4), (2, 2, 3)]
    right = alpha3(points)["tetrahedra"].tolist()
    check_tetrahedra(points, right)
    flipped = [[0, 1, 2, 4], [0, 1, 3, 4], [0, 2, 3, 4], [1, 2, 3, 4]]
    for wrong in (right[1:], [*right, right[0]], flipped, [[0, 1, 2, 3]]):
        with pytest.raises(AssertionError):
            check_tetrahedra(points, wrong)
