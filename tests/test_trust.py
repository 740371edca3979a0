"""A small part of each campaign in trust/ finds nothing, and would find something."""

from __future__ import annotations

import sys

import numpy as np
import pytest
from trust import __main__ as record
from trust import clouds, predicates, readers


@pytest.mark.skipif(predicates.compiler() is None, reason="no C++ compiler")
def test_predicates_against_whole_numbers():
    results = predicates.campaign(20_000, seed=77)
    assert {result["campaign"] for result in results} == {
        *("orient", "dot", "in_circle"),
        *("orient3", "dot3", "in_sphere", "circumcentre_side"),
        *("power_record", "in_power_sphere", "orthocentre_side"),
        *("orthocentre_side of triangles", "orthocentre_side of edges"),
    }
    for result in results:
        assert result["wrong"] == 0
        # All stages are reached, and ties are met.
        assert result["cases"] == 20_000
        # A record leaves ties to the perturbation.
        least = 500 if result["campaign"] != "power_record" else 20
        assert result["beyond_filter"] > result["beyond_double_double"] > least
        assert result["zero"] > 1000


@pytest.mark.parametrize("dimension", [2, 3])
def test_nasty_clouds_are_proved(dimension):
    tally, failures = clouds._batch(range(5_000_000, 5_000_300), dimension)
    assert failures == []
    assert tally["proved"] > 250
    families = {clouds.cloud(seed, dimension)[0] for seed in range(200)}
    assert families == set(clouds.FAMILIES)


def test_a_failure_is_noticed(monkeypatch):
    def broken(cx):
        raise ValueError("broken")

    monkeypatch.setattr(clouds.check, "check_filtration", broken)
    tally, failures = clouds._batch(range(3), 2)
    assert tally["failed"] == len(failures) == 3
    assert "dimension 2, seed 0: ValueError('broken')" in failures


@pytest.mark.skipif(sys.platform == "win32", reason="no signals to stop a slow reader there")
def test_damaged_files_are_read_or_refused(monkeypatch):
    pytest.importorskip("pyarrow")
    monkeypatch.setattr(readers, "_limit", lambda: None)  # not for this process
    tally, failures = readers._batch((7_000_000, 200))
    assert failures == []
    assert tally["read"] > 10
    assert tally["refused"] > 80


def test_damage_is_the_same_for_a_seed():
    content = bytes(range(200))
    damaged = [readers.damaged(content, np.random.default_rng(seed)) for seed in (1, 1, 2)]
    assert damaged[0] == damaged[1] != damaged[2]


def test_record_becomes_a_table():
    text = record.table(
        {
            "orient": {
                "campaign": "orient",
                "cases": 1000,
                "wrong": 0,
                "zero": 7,
                "beyond_filter": 30,
                "beyond_double_double": 20,
            },
            "clouds in 2D": {"cases": 5000, "proved": 4990, "refused": 10, "failed": 0},
        }
    )
    assert "| `orient` | 1,000 | 7 | 30 | 20 | 0 |" in text
    assert "| clouds in 2D | 5,000 | 4,990 | 10 | 0 |" in text
