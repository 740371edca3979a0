"""The page in a real browser.

``ALPHAMESH_BASELINES=anew pytest tests/test_view_browser.py -k look`` draws the baselines
anew; look at them.
"""

from __future__ import annotations

import base64
import io
import json
import os
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest

import alphamesh as am
from browser import chromium

BASELINE = Path(__file__).parent / "baseline" / "view"
# Counts what is really handed to the GPU.
COUNTER = """
window.calls = [];
const draw = WebGL2RenderingContext.prototype.drawElements;
WebGL2RenderingContext.prototype.drawElements = function (...args) {
  window.calls.push(args[1] / 3);
  return draw.apply(this, args);
};
"""
ALONE = ".over, .zoom, .label { visibility: hidden }"
PICTURES = {
    "early": {"radius": 9.0, "layers": "dtebsp"},
    "cells": {"radius": 14.0, "layers": "vp"},
    "chosen": {"radius": 19.0, "layers": "tebsp"},
}
SOLIDS = {
    "solid-early": {"radius": 0.13, "layers": "besnp"},
    "solid-chosen": {"radius": 0.3, "layers": "besnp"},
    "solid-cut": {"radius": 0.3, "layers": "besnpx"},
}


@pytest.fixture(scope="module")
def eight():
    return am.AlphaComplex(am.demo_cloud("eight", 400, seed=1))


@pytest.fixture(scope="module")
def file(eight, tmp_path_factory):
    path = tmp_path_factory.mktemp("view") / "page.html"
    eight.view(path, title="An eight")
    return path


@pytest.fixture(scope="module")
def browser():
    with chromium() as started:
        yield started


class Visit:
    """A page that is open, and what went wrong on it."""

    def __init__(self, browser, file, hash_="", **options):
        self.troubles, self.requests = [], []
        options.setdefault("viewport", {"width": 1100, "height": 760})
        self.context = browser.new_context(accept_downloads=True, **options)
        self.page = self.context.new_page()
        self.page.set_default_timeout(20_000)
        self.page.add_init_script(COUNTER)
        self.page.on("console", self._hear)
        self.page.on("pageerror", lambda error: self.troubles.append(str(error)))
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.goto(f"{file.as_uri()}{hash_}")
        self.page.wait_for_function("() => window.alphamesh")

    def _hear(self, message):
        if message.type in ("error", "warning") and "GPU stall" not in message.text:
            self.troubles.append(message.text)

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        self.context.close()
        if kind is None:
            assert self.troubles == []

    def set_radius(self, radius):
        self.page.evaluate("r => { alphamesh.setRadius(r); alphamesh.drawNow(); }", radius)

    @property
    def radius(self):
        return self.page.evaluate("alphamesh.radius")

    @property
    def slider(self):
        return self.page.get_by_role("slider", name="Radius")

    def picture(self):
        """Return the picture alone, without texts, which differ between machines."""
        self.page.evaluate("alphamesh.drawNow()")
        return self.page.locator("canvas.picture").screenshot(style=ALONE)


@pytest.fixture
def visit(browser, file):
    with Visit(browser, file) as opened:
        yield opened


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


# In space


@pytest.fixture(scope="module")
def hollow():
    """A ball with a void, and a few points far from it."""
    rng = np.random.default_rng(7)
    points = rng.normal(size=(500, 3))
    points *= (rng.uniform(0.55, 1, 500) / np.linalg.norm(points, axis=1))[:, None]
    return am.AlphaComplex(np.concatenate((points, rng.uniform(1.6, 1.8, (4, 3)))))


@pytest.fixture(scope="module")
def solid(hollow, tmp_path_factory):
    path = tmp_path_factory.mktemp("view") / "solid.html"
    hollow.view(path, 0.3, title="A hollow ball")
    return path


@pytest.fixture
def room(browser, solid):
    with Visit(browser, solid) as opened:
        yield opened


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


# In a notebook


def test_the_widget_and_python_share_the_radius(browser, eight, tmp_path):
    pytest.importorskip("anywidget")
    widget = eight.widget(9.0, height=420)
    data = base64.b64encode(widget.data).decode()
    (tmp_path / "host.html").write_text(
        f"""<!doctype html><title>host</title><body><div id="cell"></div>
        <script type="module">
        const url = URL.createObjectURL(new Blob([{json.dumps(widget._esm)}],
          {{type: "text/javascript"}}));
        const {{default: widget}} = await import(url);
        const bytes = Uint8Array.from(atob("{data}"), (c) => c.charCodeAt(0));
        const state = {{data: new DataView(bytes.buffer), radius: 9, height: "420px"}};
        const listeners = {{}};
        window.saved = [];
        window.model = {{
          get: (name) => state[name],
          set(name, value) {{ state[name] = value; listeners[`change:${{name}}`]?.(); }},
          on: (name, act) => (listeners[name] = act),
          off: (name) => delete listeners[name],
          save_changes: () => window.saved.push(state.radius),
        }};
        window.leave = await widget.render({{model, el: document.getElementById("cell")}});
        window.alphamesh = true;
        </script>""",
        encoding="utf-8",
    )
    with Visit(browser, tmp_path / "host.html") as visit:
        page = visit.page
        page.add_style_tag(content=widget._css)
        assert page.locator(".alphamesh-view").bounding_box()["height"] == 420
        page.evaluate("model.set('radius', 20)")
        page.wait_for_function(
            "() => document.querySelector('[type=range]').ariaValueText.startsWith('radius 20')"
        )
        visit.slider.focus()
        page.keyboard.press("Home")
        page.wait_for_function("() => window.saved.length === 1")
        assert page.evaluate("[window.saved[0], model.get('radius')]") == [0, 0]
        page.evaluate("leave()")


# Pictures


def image_of(content):
    from PIL import Image

    with Image.open(io.BytesIO(content)) as image:
        return np.asarray(image.convert("RGB"))


def drawn(visit, radius, layers):
    visit.page.evaluate(
        "([r, show]) => alphamesh._restore({radius: r, layers: show})", [radius, layers]
    )
    return image_of(visit.picture())


def small(browser, file):
    return Visit(browser, file, viewport={"width": 840, "height": 480})


@pytest.mark.parametrize("name", [*PICTURES, *SOLIDS])
def test_pictures_look_as_they_did(name, browser, file, solid):
    from PIL import Image

    from test_pictures import MOST_OF_A_PIXEL, MOST_ON_AVERAGE, difference

    page = file if name in PICTURES else solid
    if os.environ.get("ALPHAMESH_BASELINES") == "anew":
        draw_baselines(browser, page, {name: (PICTURES | SOLIDS)[name]})
    with small(browser, page) as visit, Image.open(BASELINE / f"{name}.png") as kept:
        now = Image.fromarray(drawn(visit, **(PICTURES | SOLIDS)[name]))
        assert now.size == kept.size
        apart = difference(now, kept.convert("RGB"))
    assert apart.mean() < MOST_ON_AVERAGE
    assert apart.max() < MOST_OF_A_PIXEL


def test_no_baseline_is_left_over():
    assert {path.stem for path in BASELINE.glob("*.png")} == {*PICTURES, *SOLIDS}


def draw_baselines(browser, file, pictures):
    from PIL import Image

    BASELINE.mkdir(parents=True, exist_ok=True)
    with small(browser, file) as visit:
        for name, state in pictures.items():
            image = Image.fromarray(drawn(visit, **state))
            image.quantize(255).save(BASELINE / f"{name}.png", optimize=True)
