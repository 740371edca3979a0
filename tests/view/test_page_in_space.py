"""The page of a cloud in space, in a real browser; and of clouds with next to nothing."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import numpy as np
import pytest

import alphamesh as am
from view_page import Visit, image_of


def test_the_surface_drawn_is_that_of_the_complex(room, hollow):
    changes = hollow.critical_radii()
    for radius in map(float, (0.0, *changes[[900, 2500, 4000]], changes[-1])):
        room.set_radius(radius)
        expected = hollow.at(radius).counts
        drawn = room.page.evaluate("alphamesh.picture.drawn")
        assert drawn["triangles"] == expected["regular_triangles"]
        assert drawn["singular"] == expected["singular_triangles"]
        assert drawn["lone"] == expected["isolated_edges"]


def test_the_surface_turns_and_is_cut_open(room):
    pictures = [room.picture()]
    box = room.page.locator(".stage").bounding_box()
    room.page.mouse.move(box["x"] + 300, box["y"] + 200)
    room.page.mouse.down()
    room.page.mouse.move(box["x"] + 360, box["y"] + 230)
    room.page.mouse.up()
    pictures.append(room.picture())
    room.page.keyboard.press("x")
    pictures.append(room.picture())
    room.page.keyboard.press("]")
    pictures.append(room.picture())
    assert len(set(pictures)) == 4
    inside = np.array([0xC9, 0xCE, 0xD6])
    shares = [(np.abs(image_of(p) - inside).max(axis=2) < 8).mean() for p in pictures]
    assert shares[0] < 0.001 < 0.02 < shares[2]
    address = room.page.wait_for_function(
        "() => location.hash.includes('view=') && location.hash"
    )
    assert address.json_value().count(",") == 8


def test_pointing_at_the_surface_tells_its_filtration_value(room, hollow):
    box = room.page.locator(".stage").bounding_box()
    room.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    text = room.page.locator(".label").inner_text()
    rows = sorted(int(row) for row in text.split("\n")[0].split("triangle ")[1].split(", "))
    place = np.flatnonzero((hollow.simplices[2] == rows).all(axis=1))
    assert len(place) == 1
    assert f"from radius {hollow.radii[2][place[0]]:.6g}" in text


def test_the_surface_is_saved_as_svg(room):
    with room.page.expect_download() as svg:
        room.page.get_by_role("button", name="SVG").click()
    shapes = ET.parse(svg.value.path()).getroot().findall("{*}path")
    drawn = room.page.evaluate("alphamesh.picture.drawn")
    assert len(shapes) == drawn["triangles"] + drawn["singular"] + drawn["lone"]


@pytest.mark.parametrize("space", [0, 1])
@pytest.mark.parametrize("points", [[], [[1, 2]], [[0, 0], [1, 1], [3, 3]]])
def test_degenerate_clouds_are_shown(points, space, browser, tmp_path):
    flat = np.reshape(points, (-1, 2))
    am.AlphaComplex(np.column_stack((flat, flat[:, :space]))).view(tmp_path / "page.html")
    with Visit(browser, tmp_path / "page.html", "#r=0.3&show=dvtebsnp") as visit:
        visit.page.evaluate("alphamesh.setRadius(alphamesh.scale.limit); alphamesh.drawNow()")
        discs = (image_of(visit.picture()) < 245).any()
        assert discs == (len(points) > 0)
