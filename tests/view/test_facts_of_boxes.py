"""What the page counts and draws of periodic boxes, told by its own code."""

from __future__ import annotations

import itertools
import json
import zlib

import numpy as np
import pytest

from alphamesh.view.boxes import box_arrays
from alphamesh.view.placing import Frame, Order
from view_facts import BOXES, box_of, packed, told


@pytest.mark.parametrize("name", BOXES)
def test_the_page_counts_what_a_periodic_box_holds(name, tmp_path):
    cx = box_of(name)
    values = np.unique(np.concatenate(cx.radii))
    radii = np.concatenate((values[:: max(1, len(values) // 20)], values[-1:], values[-1:] + 1))
    shown = told(cx, radii, tmp_path)
    assert shown["words"][1:2] == ["loop"]
    d = len(cx.periods)
    for radius, facts in zip(radii, shown["facts"], strict=True):
        shape = cx.at(radius)
        assert facts["present"] == list(shape.counts.values())
        assert [*facts["betti"], int(facts["full"])] == list(shape.betti)
        assert facts["curves"] == facts["betti"] == list(shape.betti[:d])
        assert facts["isolated"] == len(shape.isolated_vertices)
        assert facts["boundary"] == len(
            shape.boundary_edges if d == 2 else shape.boundary_triangles
        )
        size, border = (
            (shape.area, shape.perimeter) if d == 2 else (shape.volume, shape.surface_area)
        )
        assert facts["size"] == pytest.approx(size, rel=1e-4, abs=1e-9)
        assert facts["border"] == pytest.approx(border, rel=1e-4, abs=1e-6)


@pytest.mark.parametrize("name", ["square", "weighted", "cube"])
def test_copies_of_all_that_meets_a_box_are_drawn(name, tmp_path):
    cx = box_of(name)
    shown = told(cx, [], tmp_path)
    d, margin = len(cx.periods), {2: 0.5, 3: 0.0}[len(cx.periods)]
    meta = shown["meta"]
    places = np.array(shown["drawn"]["positions"]).reshape(-1, d) * meta["scale"]
    places += meta["centre"]
    for k, kind in ((1, "edges"), (2, "triangles")):
        corners = places[np.array(shown["drawn"][kind])].reshape(-1, k + 1, d)
        found = {tuple(sorted(map(tuple, rows))) for rows in corners.round(4).tolist()}
        # The oracle moves all simplices by all moves, and keeps what meets the window.
        wanted = set()
        for move in itertools.product(range(-3, 4), repeat=d):
            moved = cx.filtration.corners(k) + move
            meets = (moved.max(axis=1) > -margin) & (moved.min(axis=1) < 1 + margin)
            kept = moved[meets.all(axis=1)].round(4).tolist()
            wanted |= {tuple(sorted(map(tuple, rows))) for rows in kept}
        assert len(found ^ wanted) <= 0.03 * len(wanted)  # rounded to either side
        assert len(corners) == len(found) > len(cx.simplices[k])


@pytest.mark.parametrize("name", ["square", "weighted"])
def test_the_cells_of_a_box_fill_it(name, tmp_path):
    cx = box_of(name)
    shown = told(cx, [], tmp_path)
    areas = np.array(shown["cells"])[: len(cx.simplices[0])] * shown["meta"]["scale"] ** 2
    # One copy of each vertex lies in the box, and its cell is whole.
    assert areas.sum() == pytest.approx(1, rel=1e-4)


def test_walls_cut_what_a_box_holds():
    section = pytest.importorskip("alphamesh.plot.section")
    cx = box_of("cube")
    raw = zlib.decompress(packed(cx))
    size = int.from_bytes(raw[:4], "little")
    blocks = {b["name"]: b for b in json.loads(raw[4 : 4 + size])["arrays"]}
    frame = Frame.of(cx.filtration, cx.simplices[0][:, 0])
    orders = [Order.of(values) for values in cx.radii]
    rows = np.arange(len(cx.points), dtype=np.uint32)
    caps = box_arrays(cx.filtration, orders, frame, rows)
    assert blocks["caps"]["length"] == len(caps["caps"]) == 9 * len(caps["cap_ranks"])
    corners = caps["caps"].reshape(-1, 3, 3).astype(float) * frame.scale + frame.centre
    walls = [(axis, side) for axis in range(3) for side in (0, 1)]
    for axis, side in walls:
        there = np.flatnonzero((np.abs(corners[:, :, axis] - side) < 1e-6).all(axis=1))
        left = section.clipped_triangles(
            corners[there], [_plane(k, s) for k in range(3) if k != axis for s in (0, 1)]
        )
        arms = left[:, 1:] - left[:, :1]
        area = np.linalg.norm(np.cross(arms[:, 0], arms[:, 1]), axis=1).sum() / 2
        assert area == pytest.approx(1, rel=1e-5)  # all of the wall, once


def _plane(axis, side):
    return (np.eye(3)[axis] * (1 if side else -1), float(side))
