"""The page of a cloud in the plane, in a real browser."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import numpy as np
import pytest

import alphamesh as am
from view_page import Visit, image_of


def test_the_page_loads_in_silence_and_asks_for_nothing(visit, file):
    visit.page.keyboard.press("?")
    visit.page.wait_for_timeout(200)
    inside = ("data:", "blob:")
    assert [url for url in visit.requests if not url.startswith(inside)] == [file.as_uri()]
    assert visit.page.title() == "An eight"


def test_the_page_cannot_reach_out(browser, file):
    visit = Visit(browser, file)
    done = visit.page.evaluate(
        "fetch('https://example.org').then(() => 'sent', () => 'refused')"
    )
    assert done == "refused"
    assert any("Content Security Policy" in text for text in visit.troubles)
    visit.context.close()


def test_the_triangles_drawn_are_those_of_the_complex(visit, eight):
    changes = eight.critical_radii()
    radii = [0.0, *changes[[200, 700, 1200]], np.nextafter(changes[1200], 0), changes[-1]]
    for radius in map(float, radii):
        visit.page.evaluate("window.calls.length = 0")
        visit.set_radius(radius)
        expected = eight.at(radius).counts
        assert visit.page.evaluate("window.calls") == [expected["triangles"]]
        drawn = visit.page.evaluate("alphamesh.picture.drawn")
        assert drawn["triangles"] == expected["triangles"]
        assert drawn["boundary"] == expected["regular_edges"]
        assert drawn["singular"] == expected["singular_edges"]
        shown = visit.page.locator("label", has_text="triangles").locator(".value")
        assert shown.inner_text() == f"{expected['triangles']:,}"


def test_pictures_of_large_clouds_do_not_depend_on_the_way_there(browser, tmp_path):
    """Without a GPU, only triangles that come or go are drawn: nothing may be left over."""
    points = np.random.default_rng(2).random((12_000, 2))
    cx = am.AlphaComplex(points)
    cx.view(tmp_path / "page.html")
    with Visit(browser, tmp_path / "page.html") as visit:
        assert not visit.page.evaluate("alphamesh.stage.gl.getContextAttributes().antialias")
        for share in (0.9, 0.2, 0.6, 0.3, 1):
            visit.page.evaluate("s => alphamesh.setRadius(alphamesh.scale.radius(s))", share)
            now = visit.picture()
            visit.page.evaluate("alphamesh.picture.scene.cache.key = ''; window.calls = []")
            assert visit.picture() == now
            counts = cx.at(visit.radius).counts
            assert counts["triangles"] in visit.page.evaluate("window.calls")
            drawn = visit.page.evaluate("alphamesh.picture.drawn")
            assert drawn["boundary"] == counts["regular_edges"]
            assert drawn["singular"] == counts["singular_edges"]


def test_the_slider_changes_the_picture(visit):
    visit.set_radius(5.0)
    before = visit.picture()
    box = visit.slider.bounding_box()
    visit.page.mouse.click(box["x"] + box["width"] * 0.6, box["y"] + box["height"] / 2)
    assert visit.radius > 20
    assert visit.picture() != before
    entry = visit.page.get_by_label("Radius, as a number")
    entry.fill("5")
    visit.page.evaluate("alphamesh.drawNow()")  # as the frame that was waiting does
    assert entry.input_value() == "5"
    entry.press("Enter")
    assert visit.radius == 5
    assert visit.picture() == before


def test_the_keyboard_does_it_all(visit, eight):
    page, choice = visit.page, eight.choose_radius()
    page.keyboard.press("c")
    assert visit.radius == choice.radius
    page.keyboard.press("PageUp")
    assert visit.radius == choice.interval[1]
    page.keyboard.press("PageDown")
    assert visit.radius == choice.interval[0]
    visit.slider.focus()
    page.keyboard.press("Home")
    assert visit.radius == 0
    page.keyboard.press("ArrowRight")
    step = visit.radius
    assert step > 0
    page.keyboard.press("Shift+ArrowRight")
    assert visit.radius == pytest.approx(11 * step)
    page.keyboard.press("End")
    assert visit.radius == page.evaluate("alphamesh.scale.limit")
    box = page.get_by_role("checkbox", name="triangles")
    assert box.is_checked()
    page.keyboard.press("t")
    page.evaluate("alphamesh.drawNow()")
    assert not box.is_checked()
    page.locator(".stage").focus()
    page.keyboard.press("ArrowLeft")
    page.keyboard.press("+")
    assert page.evaluate("alphamesh.picture.camera.moved")
    page.keyboard.press("0")
    assert not page.evaluate("alphamesh.picture.camera.moved")


def test_focus_is_seen_and_everything_has_a_name(visit):
    page = visit.page
    names = page.evaluate(
        "[...document.querySelectorAll('button, input, canvas[role], .stage')].map(e => "
        "e.getAttribute('aria-label') ?? e.closest('label')?.textContent ?? '')"
    )
    assert len(names) > 15
    assert all(names)
    outlines = set()
    for _ in range(12):
        page.keyboard.press("Tab")
        outlines.add(page.evaluate("getComputedStyle(document.activeElement).outlineStyle"))
    assert outlines == {"solid"}


def test_what_changes_is_told_to_screen_readers(visit, eight):
    visit.set_radius(12.0)
    b0, b1 = eight.persistence().betti_numbers(12.0).tolist()
    expected = f"radius 12: {b0} component"
    visit.page.wait_for_function(
        "text => document.querySelector('[role=status]').textContent.startsWith(text)",
        arg=expected,
    )
    assert f"{b1} hole" in visit.slider.get_attribute("aria-valuetext")


def test_play_grows_the_radius_until_pause(visit):
    visit.set_radius(0.0)
    visit.page.keyboard.press("Space")
    visit.page.wait_for_function("() => alphamesh.radius > 0.5")
    visit.page.get_by_role("button", name="Pause").click()
    paused = visit.radius
    visit.page.wait_for_timeout(120)
    assert visit.radius == paused > 0
    assert visit.page.get_by_role("button", name="Play").is_visible()


def test_pointing_at_a_triangle_tells_its_filtration_value(visit, eight):
    t = int(np.argmax(np.where(eight.radii[2] < 15, eight.filtration.triangle_areas, 0)))
    rows = eight.simplices[2][t]
    x, y = eight.points[rows].mean(axis=0)
    place = visit.page.evaluate(
        "([x, y]) => { const {scale, centre} = alphamesh.meta;"
        "const box = document.querySelector('.stage').getBoundingClientRect();"
        "const [px, py] = alphamesh.picture.camera.toScreen("
        "(x - centre[0]) / scale, (y - centre[1]) / scale); return [box.x + px, box.y + py]; }",
        [x, y],
    )
    visit.page.mouse.move(*place)
    label = visit.page.locator(".label")
    assert f"triangle {', '.join(map(str, rows))}" in label.inner_text()
    assert f"in: from radius {eight.radii[2][t]:.6g}" in label.inner_text()
    visit.page.mouse.move(2, 2)
    assert label.is_hidden()


def test_dragging_on_a_chart_sets_the_radius(visit):
    for number in (0, 1):
        box = visit.page.locator(".chart canvas").nth(number).bounding_box()
        y = box["y"] + box["height"] / 2
        visit.page.mouse.move(box["x"] + box["width"] / 2, y)
        visit.page.mouse.down()
        first = visit.radius
        visit.page.mouse.move(box["x"] + 0.8 * box["width"], y)
        visit.page.mouse.up()
        limit = visit.page.evaluate("alphamesh.scale.limit")
        assert 0.3 * limit < first < visit.radius < limit


def test_wheel_and_drag_move_the_picture(visit):
    box = visit.page.locator(".stage").bounding_box()
    x, y = box["x"] + 200, box["y"] + 200
    where = "alphamesh.picture.camera.toWorld(200, 200)"
    before = visit.page.evaluate(where)
    visit.page.mouse.move(x, y)
    visit.page.mouse.wheel(0, -500)
    visit.page.wait_for_function("() => alphamesh.picture.camera.zoom > 1.5")
    assert visit.page.evaluate(where) == pytest.approx(before)
    visit.page.mouse.down()
    visit.page.mouse.move(x + 50, y)
    visit.page.mouse.up()
    moved = visit.page.evaluate("alphamesh.picture.camera.toWorld(250, 200)")
    assert moved == pytest.approx(before)


def test_a_shared_address_shows_the_same(visit, browser, file):
    page = visit.page
    page.keyboard.press("v")
    page.keyboard.press("+")
    page.keyboard.press("l")
    visit.set_radius(12.345)
    page.wait_for_function("() => location.hash.includes('r=12.345')")
    address = page.evaluate("location.hash")
    picture = visit.picture()
    with Visit(browser, file, address) as other:
        assert other.radius == 12.345
        assert other.picture() == picture


def test_pictures_are_saved(visit):
    from PIL import Image

    visit.set_radius(12.0)
    with visit.page.expect_download() as png:
        visit.page.get_by_role("button", name="PNG").click()
    assert png.value.suggested_filename == "An-eight.png"
    with Image.open(png.value.path()) as image:
        assert image.size == (
            visit.page.locator(".stage").bounding_box()["width"],
            image.height,
        )
        assert len(image.convert("RGB").getcolors(1 << 20)) > 50
    with visit.page.expect_download() as svg:
        visit.page.get_by_role("button", name="SVG").click()
    root = ET.parse(svg.value.path()).getroot()
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    assert len(root.findall(".//{*}clipPath")) == 400


def test_dark_follows_the_system_and_a_button(browser, file):
    def dark(visit):
        pixels = image_of(visit.picture())
        return pixels[3, 3].max() < 60

    with Visit(browser, file, color_scheme="dark") as visit:
        assert dark(visit)
        visit.page.get_by_role("button", name="Light or dark").click()
        assert not dark(visit)


def test_a_narrow_page_keeps_all_in_sight(browser, file):
    with Visit(browser, file, viewport={"width": 400, "height": 800}) as visit:
        wide = visit.page.evaluate("document.documentElement.scrollWidth")
        assert wide == 400
        assert visit.slider.bounding_box()["width"] > 250
        assert visit.page.locator(".stage").bounding_box()["height"] > 200
