"""The page of a periodic box, in a real browser: what crosses the border, and the block."""

from __future__ import annotations

import numpy as np
import pytest

import alphamesh as am
from view_page import Visit, image_of


def svg_of(visit):
    return visit.page.evaluate(
        "alphamesh.picture.svg({facts: alphamesh.facts, layers: alphamesh.layers, "
        "palette: alphamesh.palette, title: ''})"
    )


def shown(visit, layers):
    """Return the picture as it is in a file: veil and frame included."""
    visit.page.evaluate("show => alphamesh._restore({layers: show})", layers)
    visit.page.evaluate("alphamesh.drawNow()")
    stage = visit.page.locator(".stage")
    return image_of(stage.screenshot(style=".zoom, .label, .cut-depth { visibility: hidden }"))


def test_a_box_in_the_plane_repeats_beyond_its_border(browser, tile):
    cx, path = tile
    with Visit(browser, path) as visit:
        for radius in (0.2, 0.5, 1.0):
            visit.set_radius(radius)
            drawn = visit.page.evaluate("alphamesh.picture.drawn")
            shape = cx.at(radius)
            # Half a period on all sides: some of the simplices up to four times.
            assert shape.counts["triangles"] <= drawn["triangles"]
            assert drawn["triangles"] <= 5 * shape.counts["triangles"]
            value = visit.page.locator("label", has_text="triangles").locator(".value")
            assert value.inner_text() == f"{shape.counts['triangles']:,}"
        # What is left is what lies within the frame, and a pale margin.
        visit.set_radius(0.5)
        picture = shown(visit, "d")
        area = visit.page.evaluate(
            "(() => { const {camera} = alphamesh.picture; const {box} = alphamesh.meta;"
            "const [x, y] = camera.toScreen(box.low[0], box.high[1]);"
            "return [x, y, box.periods[0] * camera.scale].map(Math.round); })()"
        )
        x, y, side = area
        inside = picture[y + 2 : y + side - 2, x + 2 : x + side - 2]
        covered = (inside < 250).any(axis=2).mean()
        around = am.AlphaComplex(cx.tiled(3).positions)
        cells = am.restricted_voronoi(around.filtration, 0.5)
        middle = ((around.points >= 10) & (around.points < 20)).all(axis=1)
        assert covered == pytest.approx(cells.area[middle].sum() / 100, abs=0.03)
        text = svg_of(visit)
        assert text.count('fill-rule="evenodd"') == 2


def test_pointing_at_an_edge_across_the_border_tells_its_rows(browser, tile):
    cx, path = tile
    edge = int(np.flatnonzero(cx.offsets[1].any(axis=(1, 2)) & (cx.radii[1] > 0.4))[0])
    x, y = cx.filtration.corners(1)[edge].mean(axis=0)
    with Visit(browser, path, "#r=9") as visit:
        place = visit.page.evaluate(
            "([x, y]) => { const {scale, centre} = alphamesh.meta;"
            "const box = document.querySelector('.stage').getBoundingClientRect();"
            "const [px, py] = alphamesh.picture.camera.toScreen("
            "(x - centre[0]) / scale, (y - centre[1]) / scale);"
            "return [box.x + px, box.y + py]; }",
            [x, y],
        )
        visit.page.mouse.move(*place)
        rows = ", ".join(map(str, cx.simplices[1][edge]))
        text = visit.page.locator(".label").inner_text()
        assert f"edge {rows}" in text or f"edge {', '.join(rows.split(', ')[::-1])}" in text
        assert f"from radius {cx.radii[1][edge]:.6g}" in text


def test_a_box_in_space_is_a_block_with_walls(browser, block):
    cx, path = block
    with Visit(browser, path) as visit:
        visit.set_radius(9.0)
        whole = visit.picture()
        drawn = visit.page.evaluate("alphamesh.picture.drawn")
        assert drawn["triangles"] == 0  # a full box has no boundary
        assert drawn["caps"] > 0
        assert "the whole box" in visit.page.evaluate(
            "alphamesh.picture.sentence(alphamesh.facts)"
        )
        # The block is a hexagon without a gap: its corners on the screen tell its area.
        filled = (image_of(whole) < 250).any(axis=2)
        rows = np.flatnonzero(filled.any(axis=1))
        for row in rows[5:-5:20]:
            columns = np.flatnonzero(filled[row])
            assert filled[row, columns[0] : columns[-1] + 1].all()
        visit.page.keyboard.press("x")
        cut = visit.picture()
        assert cut != whole
        radius = float(np.quantile(cx.radii[3], 0.3))
        visit.page.keyboard.press("x")
        visit.set_radius(radius)
        visit.page.evaluate("alphamesh.drawNow()")
        drawn = visit.page.evaluate("alphamesh.picture.drawn")
        assert drawn["triangles"] >= len(cx.at(radius).boundary_triangles)
        text = svg_of(visit)
        assert text.count("<path") >= 12
        assert "NaN" not in text


def test_balls_reach_into_a_box_from_beyond(browser, tmp_path):
    cx = am.AlphaComplex([[0.02, 0.5, 0.5]], periods=(1, 1, 1))
    cx.view(tmp_path / "page.html", 0.2)
    with Visit(browser, tmp_path / "page.html", "#r=0.2&show=o&view=0,0,1,0,0") as visit:
        picture = image_of(visit.picture())
        dark = (picture < 250).any(axis=2)
        half = dark.shape[1] // 2
        left, right = dark[:, :half].sum(), dark[:, half:].sum()
        # Of the ball at the left wall a piece is seen at the right one.
        assert min(left, right) > 0.25 * max(left, right) > 50


@pytest.mark.parametrize(
    ("periods", "count"), [((1, 1), 0), ((1, None), 1), ((1, 1, 1), 0), ((None, 1, None), 2)]
)
def test_boxes_with_few_points_are_shown(periods, count, browser, tmp_path):
    points = np.random.default_rng(1).random((count, len(periods)))
    am.AlphaComplex(points, periods=periods).view(tmp_path / "page.html")
    with Visit(browser, tmp_path / "page.html", "#r=0.3&show=dvtebsnpo") as visit:
        visit.page.evaluate("alphamesh.setRadius(alphamesh.scale.limit); alphamesh.drawNow()")
        drawn = (image_of(visit.picture()) < 245).any()
        assert drawn == (count > 0 or len(periods) == 3)  # the frame in space
