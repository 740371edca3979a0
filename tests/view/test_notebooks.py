"""What notebooks show of complexes and shapes."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import numpy as np
import pytest

import alphamesh as am
from view_facts import CASES, SPACE, box_of


@pytest.mark.parametrize("points", [*CASES.values(), *SPACE.values()])
def test_notebooks_show_every_complex_and_shape(points):
    cx = am.AlphaComplex(points)
    for text in (cx._repr_html_(), cx.at(0)._repr_html_(), cx.at(np.inf)._repr_html_()):
        root = ET.fromstring(text)
        told = {row[0].text: row[1].text for row in root.iter("tr")}
        assert (root.find("{*}svg") is not None) == (len(points) > 0)
        assert (
            not set("".join(root.itertext()).split()) & {"nan", "inf", "None"}
            or "inf" in told["radius"]
        )


def test_notebooks_show_the_facts():
    cx = am.AlphaComplex(CASES["shape"])
    shape = cx.at(8.0)
    root = ET.fromstring(shape._repr_html_())
    told = {row[0].text: row[1].text for row in root.iter("tr")}
    assert told["triangles"] == f"{len(shape.triangles):,}"
    assert told["area"] == f"{shape.area:.6g}"
    filled = root.find("{*}svg/{*}path").get("d")
    assert filled.count("M") == filled.count("Z") == len(shape.rings)
    assert ET.fromstring(cx._repr_html_()).find(".//strong").text == "AlphaComplex"


def test_huge_clouds_are_told_of_without_a_picture():
    cx = am.AlphaComplex(np.random.default_rng(0).random((60_000, 2)))
    assert len(cx._repr_html_()) < 1000
    assert "<svg" not in cx.at(0.004)._repr_html_()


def test_notebooks_tell_of_boxes():
    told = ET.fromstring(box_of("cube")._repr_html_())
    rows = {row[0].text: row[1].text for row in told.iter("tr")}
    assert rows["periodic box"] == "1 x 1 x 1"
    assert rows["loops"].isdigit()
    assert told.find(".//strong").text == "PeriodicComplex"
