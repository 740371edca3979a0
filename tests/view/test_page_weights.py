"""The page of a complex with weights, in a real browser: signed radii, balls of all sizes."""

from __future__ import annotations

import numpy as np
import pytest

import alphamesh as am
from view_page import Visit, image_of


@pytest.fixture(scope="module")
def grove(crowns, browser):
    with Visit(browser, crowns[1]) as opened:
        yield crowns[0], opened


def share(visit, layers):
    """Return the share of the picture that is not background."""
    visit.page.evaluate("show => alphamesh._restore({layers: show})", layers)
    return (image_of(visit.picture()) < 250).any(axis=2).mean()


def seen_area(visit):
    """Return the area of the picture, in squared units of the points."""
    scale = visit.page.evaluate(
        "(() => { const {camera} = alphamesh.picture;"
        "return camera.width * camera.height / (camera.scale / alphamesh.meta.scale) ** 2; })()"
    )
    return float(scale)


def test_the_slider_starts_where_the_first_ball_appears(grove):
    cx, visit = grove
    first = float(cx.radii[0].min())
    assert first < 0
    visit.slider.focus()
    visit.page.keyboard.press("Home")
    assert visit.radius == first
    visit.page.evaluate("alphamesh.drawNow()")
    assert visit.page.evaluate("alphamesh.facts.present") == [1, 0, 0]
    visit.page.keyboard.press("PageUp")
    assert visit.radius == pytest.approx(cx.persistence().betti_curve().radii[1], abs=0)
    entry = visit.page.get_by_label("Radius, as a number")
    entry.fill("-0.5")
    entry.press("Enter")
    assert visit.radius == -0.5
    visit.page.evaluate("alphamesh.drawNow()")
    text = visit.slider.get_attribute("aria-valuetext")
    assert text.startswith("radius \N{MINUS SIGN}0.5")
    visit.page.wait_for_function("() => location.hash.includes('r=-0.5')")


@pytest.mark.parametrize("layers", ["d", "v"])
def test_discs_and_power_cells_cover_the_union(grove, layers):
    cx, visit = grove
    for radius in (-2.0, 0.0, 2.5):
        visit.set_radius(radius)
        area = cx.restricted_voronoi(radius).total_area
        assert share(visit, layers) * seen_area(visit) == pytest.approx(area, rel=0.05)


def test_what_is_drawn_is_what_is_there(grove):
    cx, visit = grove
    visit.page.evaluate("alphamesh._restore({layers: 'dtebsph'})")
    for radius in (-3.0, 0.0, 4.0):
        visit.set_radius(radius)
        counts, drawn = cx.at(radius).counts, visit.page.evaluate("alphamesh.picture.drawn")
        assert drawn["points"] == int((cx.radii[0] <= radius).sum())
        assert drawn["triangles"] == counts["triangles"]
        assert drawn["boundary"] == counts["regular_edges"]
        assert drawn["singular"] == counts["singular_edges"]
        assert drawn["hidden"] == len(cx.hidden)


def test_pointing_at_a_hidden_point_tells_its_row(grove):
    cx, visit = grove
    row = int(cx.hidden[0])
    place = visit.page.evaluate(
        "([x, y]) => { const {scale, centre} = alphamesh.meta;"
        "const box = document.querySelector('.stage').getBoundingClientRect();"
        "const [px, py] = alphamesh.picture.camera.toScreen("
        "(x - centre[0]) / scale, (y - centre[1]) / scale); return [box.x + px, box.y + py]; }",
        cx.points[row].tolist(),
    )
    visit.page.mouse.move(*place)
    assert f"hidden point {row}" in visit.page.locator(".label").inner_text()


def test_an_svg_holds_discs_of_different_sizes(grove):
    cx, visit = grove
    visit.page.evaluate("alphamesh._restore({layers: 'dvph', radius: 0})")
    text = visit.page.evaluate(
        "alphamesh.picture.svg({facts: alphamesh.facts, layers: alphamesh.layers, "
        "palette: alphamesh.palette, title: ''})"
    )
    there = cx.weights[cx.simplices[0][:, 0]] > 0
    assert text.count("clip-path=") == there.sum()
    assert text.count(f'stroke="{visit.page.evaluate("alphamesh.palette.quiet")}"') == 1


def test_balls_in_space_are_as_large_as_they_should(browser, tmp_path):
    points = np.array([[0.0, 0, 0], [2.0, 0, 0], [0, 2.0, 0], [0, 0, 2.0]])
    cx = am.AlphaComplex(points, weights=[1.0, 0.01, 0.01, 0.01])
    cx.view(tmp_path / "page.html", 0.0)
    with Visit(browser, tmp_path / "page.html") as visit:
        # From far away, a ball in the middle of the picture is a disc.
        shares = []
        for show in ("", "o", "ox"):
            visit.page.evaluate("s => alphamesh._restore({layers: s, radius: 0})", show)
            shares.append((image_of(visit.picture()) < 250).any(axis=2).mean())
        camera = "alphamesh.picture.camera"
        pixels = visit.page.evaluate(
            f"{camera}.pixelsAt({camera}.seen(alphamesh.complex.positions)[2])"
            f" ** 2 / ({camera}.width * {camera}.height)"
        )
        disc = np.pi * pixels / visit.page.evaluate("alphamesh.meta.scale") ** 2
        assert shares[0] == 0
        assert shares[1] == pytest.approx(disc * 1.03, rel=0.08)
        assert 0.2 * shares[1] < shares[2] < shares[1]
        drawn = visit.page.evaluate("alphamesh.picture.drawn")
        assert drawn["balls"] == 4
        visit.set_radius(-0.5)
        visit.page.evaluate("alphamesh._restore({layers: 'bo'})")
        text = visit.page.evaluate(
            "alphamesh.picture.svg({facts: alphamesh.facts, layers: alphamesh.layers, "
            "palette: alphamesh.palette, title: ''})"
        )
        assert text.count("<circle") == 1  # the small ones are gone
