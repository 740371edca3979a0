"""Outlines of restricted cells, as SVG paths and Bezier curves, enclose them."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

from cell_samples import cells_of, random_cloud

FULL = 2 * math.pi


NUMBER = r"-?[\d.]+(?:e[-+]\d+)?"


def parsed(path):
    """Return the ends of an SVG path and, for arcs, radius and flags."""
    assert re.fullmatch(rf"M{NUMBER} {NUMBER}(?:[LA]{NUMBER}(?: {NUMBER})*)*Z", path)
    commands = re.findall(rf"([MLA])({NUMBER}(?: {NUMBER})*)", path)
    return [(name, [float(word) for word in words.split()]) for name, words in commands]


def swept_area(start, command):
    """Return the area between a piece and the origin, the arc's sector put on its chord."""
    name, numbers = command
    end = numbers[-2:]
    area = (start[0] * end[1] - start[1] * end[0]) / 2
    if name == "A":
        radius, _, turned, large, sweep = numbers[:5]
        assert (turned, large, sweep) == (0, 0, 1)
        half = min(1.0, math.dist(start, end) / 2 / radius)
        angle = 2 * math.asin(half)
        area += radius**2 * (angle - math.sin(angle)) / 2
    return end, area


@pytest.mark.parametrize("radius", [0.02, 0.04, 0.3])
def test_svg_paths_enclose_the_cells(radius):
    cells = cells_of(random_cloud(), radius)
    for row, path in enumerate(cells.svg_paths(17)):
        commands = parsed(path)
        start, total = commands[0][1], 0.0
        first = start
        for command in commands[1:]:
            start, area = swept_area(start, command)
            total += area
        assert start == first
        assert total == pytest.approx(cells.area[row], rel=1e-7)


def test_a_disc_is_two_arcs_in_svg():
    assert cells_of([[1.0, 1.0]], 2.0).svg_paths() == ["M3 1A2 2 0 0 1 -1 1A2 2 0 0 1 3 1Z"]
    touching = cells_of([[0.0, 0.0], [2.0, 0.0]], 1.0).svg_paths(4)
    assert touching[0].startswith("M1 0L1 0A1 1 0 0 1 -1 ")
    assert touching[0].endswith("A1 1 0 0 1 1 0Z")


def test_bezier_paths_follow_the_border():
    path_module = pytest.importorskip("matplotlib.path")
    cells = cells_of(random_cloud(), 0.04)
    vertices, codes, offset = cells.bezier_paths()
    assert codes.dtype == np.uint8
    for row in range(0, len(cells.points), 7):
        part = slice(offset[row], offset[row + 1])
        path = path_module.Path(vertices[part], codes[part])
        (polygon,) = path_module.Path(path.vertices * 1e6, path.codes).to_polygons()
        x, y = (polygon / 1e6 - cells.points[row]).T
        area = (x[:-1] * y[1:] - x[1:] * y[:-1]).sum() / 2
        assert area == pytest.approx(cells.area[row], rel=1e-4)
        assert np.hypot(x, y).max() <= 0.04 * (1 + 1e-5)
    # Where each piece begins, the path has exactly that point.
    places = {tuple(v) for v in vertices.tolist()}
    assert {tuple(v) for v in cells.start.tolist()} <= places


def test_bezier_curves_are_round():
    cells = cells_of([[3.0, 4.0]], 2.0)
    vertices, codes, _ = cells.bezier_paths()
    assert codes.tolist() == [1] + [4] * 24 + [79]
    ends = vertices[:-1]
    t = np.linspace(0, 1, 50)[:, None]
    for k in range(0, 24, 3):
        a, b, c, d = ends[k : k + 4]
        curve = (1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t**2 * (1 - t) * c + t**3 * d
        assert np.hypot(*(curve - [3.0, 4.0]).T) == pytest.approx(2.0, rel=5e-6)
