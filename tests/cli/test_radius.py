"""``alphamesh radius``."""

from __future__ import annotations

from pathlib import Path

import alphamesh as am
from cli_tools import facts, ok, refused, run


def test_radius_tells_what_is_chosen_and_why(points):
    choice = am.AlphaComplex(points).choose_radius()
    out = facts("radius", "points.csv")
    assert out["radius"] == choice.radius
    assert out["reason"] == choice.reason
    assert tuple(out["betti"]) == choice.betti
    said = " ".join(ok("radius", "points.csv").split())
    assert choice.reason in said
    assert f"({choice.rule})" in said


def test_radius_passes_options_to_its_rule(points):
    choice = am.AlphaComplex(points).choose_radius("regions", regions=2)
    out = facts("radius", "points.csv", "--rule", "regions", "--regions", "2")
    assert out["radius"] == choice.radius
    wrong = refused(2, "radius", "points.csv", "--rule", "all-points", "--regions", "2")
    assert "no option 'regions'" in wrong
    assert "all-points" in refused(2, "radius", "points.csv", "--rule", "best")
    assert "such as 1,2" in refused(2, "radius", "points.csv", "--betti", "3")


def test_radius_of_no_points_is_refused(folder):
    Path("none.csv").write_text("x,y\n")
    assert run("radius", "none.csv").exit_code == 1
