"""The page that shows a complex live: its data, its text, its command."""

from __future__ import annotations

import itertools
import json
import re
import sys
import xml.etree.ElementTree as ET
import zlib

import numpy as np
import pytest
from hypothesis import given, settings

import alphamesh as am
from alphamesh.errors import FileWriteError, MissingLibraryError, ParameterError
from alphamesh.view import page_text, payload
from alphamesh.view.boxes import box_arrays
from alphamesh.view.bundle import bundle, style
from alphamesh.view.packing import pack, rising_bits, signed_bits
from alphamesh.view.placing import Frame, Order
from node import SCRIPTS, STATIC, run_node
from strategies import clouds

GRID = np.stack(np.meshgrid(np.arange(5.0), np.arange(4.0)), axis=-1).reshape(-1, 2)
CASES = {
    "random": np.random.default_rng(3).random((300, 2)) * [3, 1] + [1e4, -7],
    "shape": am.demo_cloud("target", 500, seed=2),
    "grid": GRID,
    "duplicates": np.concatenate([GRID, GRID[::-1], GRID[3:5]]),
    "line": np.arange(7.0)[:, None] * [1, 2],
    "two": np.array([[0.0, 0], [3, 4]]),
    "one": np.array([[5.0, 5]]),
    "same": np.full((3, 2), 2.0),
    "none": np.empty((0, 2)),
    "tiny": np.random.default_rng(0).random((40, 2)) * 1e-140,
    "large": np.random.default_rng(0).random((40, 2)) * 1e140,
}


# Points with weights: some are hidden, some come late, some are heavier than all else.
_HEAVY = np.random.default_rng(8).lognormal(-3.2, 0.8, 120) ** 2
WEIGHTED = {
    "random": (np.random.default_rng(7).random((120, 2)), _HEAVY),
    "hidden": (np.random.default_rng(7).random((60, 2)), np.repeat([0.01, -3.0], 30)),
    "grid": (GRID, np.tile([0.25, -1.0], 10)),
    "duplicates": (np.repeat(GRID, 2, axis=0), np.arange(40) / 32),
    "equal": (GRID * 0.7, np.full(20, 0.3)),
    "zero": (GRID, np.zeros(20)),
    "negative": (CASES["random"][:40], np.linspace(-5, -1, 40)),
    "line": (CASES["line"], np.array([0, 3, 0, 1, 1, 0.5, 9])),
    "one": (CASES["one"], [4.0]),
    "none": (CASES["none"], []),
    "space": (np.random.default_rng(9).random((90, 3)), _HEAVY[:90]),
    "one in space": ([[1.0, 2, 3]], [-4.0]),
}


def packed(cx, **options):
    choice = cx.choose_radius() if len(cx.points) else None
    return payload(cx.persistence(), choice, **options)


def told(cx, radii, folder):
    """Return what the page would show, told by its own code."""
    file = folder / "data.bin"
    file.write_bytes(packed(cx))
    return json.loads(run_node(SCRIPTS / "facts.js", file, *[repr(float(r)) for r in radii]))


SPACE = {
    "random": np.random.default_rng(4).random((150, 3)) * [1, 2, 3] + [5, -1, 1e3],
    "grid": np.stack(np.meshgrid(*[np.arange(4.0)] * 3), axis=-1).reshape(-1, 3),
    "duplicates": np.repeat(np.random.default_rng(5).random((12, 3)), 2, axis=0)[::-1],
    "plane": np.column_stack((np.random.default_rng(6).random((30, 2)), np.zeros(30))),
    "line": np.arange(5.0)[:, None] * [1, 2, 3],
    "one": np.array([[5.0, 5, 5]]),
    "none": np.empty((0, 3)),
}


def radii_of(cx):
    """Return radii at, just below and between changes."""
    changes = cx.critical_radii()
    some = changes[:: max(1, len(changes) // 25)]
    last = changes[-1:] * 2
    return np.unique(np.concatenate((some, np.nextafter(some, 0)[1:], some * 1.01, last)))


def numbers_of(facts):
    """Return what has to agree to the last digit."""
    vertices, edges, triangles = facts["present"]
    return {
        "vertices": vertices,
        "edges": edges,
        "triangles": triangles,
        "singular_edges": facts["singularEdges"],
        "regular_edges": facts["boundary"],
        "interior_edges": facts["interior"],
        "isolated_vertices": facts["isolated"],
    }


@pytest.mark.parametrize("name", CASES)
def test_the_page_counts_what_the_complex_holds(name, tmp_path):
    cx = am.AlphaComplex(CASES[name])
    radii = radii_of(cx)
    shown = told(cx, radii, tmp_path)
    assert len(shown["facts"]) == len(radii)
    for radius, facts in zip(radii, shown["facts"], strict=True):
        shape = cx.at(radius)
        assert numbers_of(facts) == shape.counts
        betti = cx.persistence().betti_numbers(radius).tolist()
        assert facts["betti"] == betti
        assert facts["curves"] == betti
        assert facts["size"] == pytest.approx(shape.area, rel=1e-4, abs=1e-300)
        assert facts["border"] == pytest.approx(shape.perimeter, rel=1e-4)


@pytest.mark.parametrize("name", SPACE)
def test_the_page_counts_what_the_complex_holds_in_space(name, tmp_path):
    cx = am.AlphaComplex(SPACE[name])
    radii = radii_of(cx)
    for radius, facts in zip(radii, told(cx, radii, tmp_path)["facts"], strict=True):
        shape = cx.at(radius)
        counts = shape.counts
        kinds = ("vertices", "edges", "triangles", "tetrahedra")
        assert facts["present"] == [counts[kind] for kind in kinds]
        assert facts["singularTriangles"] == counts["singular_triangles"]
        assert facts["boundary"] == counts["regular_triangles"]
        assert facts["interior"] == counts["interior_triangles"]
        assert facts["singularEdges"] == counts["isolated_edges"]
        assert facts["isolated"] == counts["isolated_vertices"]
        assert facts["betti"] == facts["curves"] == list(shape.betti)
        assert facts["size"] == pytest.approx(shape.volume, rel=1e-3, abs=1e-12)
        assert facts["border"] == pytest.approx(shape.surface_area, rel=1e-3)


BOXES = {
    "square": ((1, 1), 60, False),
    "strip": ((None, 2), 30, False),
    "weighted": ((1, 1), 50, True),
    "two": ((1, 2), 2, False),
    "one": ((1, 1), 1, False),
    "cube": ((1, 1, 1), 70, False),
    "slab": ((1, 1, None), 60, True),
    "few": ((1, 1, 1), 2, True),
    "flat": ((1, 1, None), 9, False),
    "none": ((1, 1, 1), 0, False),
}


def box_of(name):
    periods, count, weighted = BOXES[name]
    rng = np.random.default_rng(11)
    points = rng.random((count, len(periods)))
    if name == "flat":
        points[:, 2] = 0.5
    weights = rng.random(count) / 20 if weighted else None
    return am.AlphaComplex(points, periods=periods, weights=weights)


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


def test_notebooks_tell_of_boxes():
    told = ET.fromstring(box_of("cube")._repr_html_())
    rows = {row[0].text: row[1].text for row in told.iter("tr")}
    assert rows["periodic box"] == "1 x 1 x 1"
    assert rows["loops"].isdigit()
    assert told.find(".//strong").text == "PeriodicComplex"


@pytest.mark.parametrize("name", WEIGHTED)
def test_the_page_counts_what_a_complex_with_weights_holds(name, tmp_path):
    points, weights = WEIGHTED[name]
    cx = am.AlphaComplex(points, weights=weights)
    changes = cx.critical_radii()
    radii = np.unique(np.concatenate((changes, changes - 1e-9, changes[-1:] + 1)))[::7]
    shown = told(cx, radii, tmp_path)
    assert sorted(shown["hidden"]) == cx.hidden.tolist()
    assert sorted(shown["rows"]) == cx.simplices[0][:, 0].tolist()
    # The first vertex does not count as a change.
    assert shown["changes"] == cx.persistence().betti_curve().radii[1:].tolist()
    for radius, facts in zip(radii, shown["facts"], strict=True):
        shape = cx.at(radius)
        betti = cx.persistence().betti_numbers(radius).tolist()
        assert facts["betti"] == facts["curves"] == betti
        assert facts["present"] == [int((values <= radius).sum()) for values in cx.radii]
        assert facts["isolated"] == len(shape.isolated_vertices)
        size = shape.volume if len(cx.simplices) == 4 else shape.area
        assert facts["size"] == pytest.approx(size, rel=1e-3, abs=1e-9)


def test_the_pieces_of_power_cells_are_the_cells(tmp_path):
    points, weights = WEIGHTED["random"]
    cx = am.AlphaComplex(points, weights=weights)
    shown = told(cx, [], tmp_path)
    # At a radius that leaves no gap, cells are cut at their ridges alone.
    whole = cx.restricted_voronoi(float(max(cx.radii[2]))).area[shown["rows"]]
    areas = np.array(shown["cells"]) * shown["meta"]["scale"] ** 2
    inner = ~np.isin(shown["rows"], cx.convex_hull.ring)
    assert inner.sum() > 45
    assert (whole[inner] > 0).all()
    assert areas[inner] == pytest.approx(whole[inner], rel=2e-3, abs=1e-7)


def test_radii_of_weighted_complexes_may_be_negative():
    cx = am.AlphaComplex(*WEIGHTED["random"][:1], weights=_HEAVY)
    pytest.importorskip("anywidget")
    widget = cx.widget(-0.01)
    assert widget.radius == -0.01
    widget.radius = -0.02
    assert widget.radius == -0.02
    with pytest.raises(ParameterError, match="got nan"):
        widget.radius = np.nan
    lowest = min(values.min() for values in cx.radii)
    assert cx.widget(-np.inf).radius == lowest < 0


def test_the_surface_is_seen_from_outside(tmp_path):
    cx = am.AlphaComplex(SPACE["random"])
    shown = told(cx, [], tmp_path)
    corners = np.array(shown["triangles"], dtype=int).reshape(-1, 3)
    last = cx.at(np.inf).boundary_triangles
    as_shown = {tuple(np.roll(row, -int(np.argmin(row)))) for row in corners.tolist()}
    assert all(tuple(row) in as_shown for row in last.tolist())


@pytest.mark.parametrize("name", ["random", "shape", "duplicates", "line"])
def test_the_page_has_the_simplices_in_their_order(name, tmp_path):
    cx = am.AlphaComplex(CASES[name])
    shown = told(cx, [], tmp_path)
    order = np.argsort(cx.radii[2], kind="stable")
    rows = np.array(shown["rows"], dtype=int)
    corners = rows[np.array(shown["triangles"], dtype=int)].reshape(-1, 3)
    assert np.array_equal(corners, cx.simplices[2][order])
    meta = shown["meta"]
    places = np.array(shown["positions"]).reshape(-1, 2) * meta["scale"] + meta["centre"]
    assert np.abs(places - cx.points[rows]).max() < 1e-6 * meta["scale"]
    assert np.array_equal(shown["changes"], cx.persistence().betti_curve().radii[1:])


def test_the_pieces_of_bounded_cells_are_the_cells(tmp_path):
    cx = am.AlphaComplex(CASES["random"])
    shown = told(cx, [], tmp_path)
    bounded = cx.voronoi.bounded
    assert bounded.sum() > 200
    areas = np.array(shown["cells"]) * shown["meta"]["scale"] ** 2
    small = bounded & (cx.voronoi.areas < 0.1)
    assert areas[small] == pytest.approx(cx.voronoi.areas[small], rel=1e-3)


@pytest.mark.parametrize("name", ["line", "two", "one"])
def test_unbounded_cells_cover_the_plane_as_far_as_a_disc_reaches(name, tmp_path):
    shown = told(am.AlphaComplex(CASES[name]), [], tmp_path)
    assert sum(shown["cells"]) > np.pi * 64**2 * 0.9


@given(clouds())
@settings(max_examples=15)
def test_packed_data_read_back_to_the_last_digit(points):
    cx = am.AlphaComplex(points)
    raw = zlib.decompress(packed(cx))
    size = int.from_bytes(raw[:4], "little")
    header = json.loads(raw[4 : 4 + size])
    at = 4 + size
    for block in header["arrays"]:
        wide = 8 if block["type"] == "rising" else 4
        planes = np.frombuffer(raw, np.uint8, wide * block["length"], at)
        at += wide * block["length"]
        if block["name"] == "edge_values":
            bits = planes.reshape(wide, -1).T.copy().view(np.uint64).ravel()
            assert np.array_equal(np.cumsum(bits).view(np.float64), np.sort(cx.radii[1]))
    assert at == len(raw)


def test_signed_bits_ascend():
    values = np.array([-1.7e308, -2.0, -5e-324, -0.0, 0.0, 5e-324, 1.0, 1.7e308])
    rising = np.cumsum(signed_bits(values).view(np.uint64))
    assert (np.diff(rising.astype(object)) >= 0).all()
    top = np.uint64(1 << 63)
    bits = np.where(rising >= top, rising ^ top, ~rising)
    assert np.array_equal(bits.view(np.float64), values)


def test_rising_bits_of_zeros_of_either_sign():
    values = np.array([-0.0, 0.0, 5e-324, 1.0, 1.0, 1.7e308])
    assert np.array_equal(np.cumsum(rising_bits(values)).view(np.float64), np.abs(values))
    assert len(pack({"a": 1}, {})) > 0


# The file


@pytest.fixture(scope="module")
def eight():
    return am.AlphaComplex(am.demo_cloud("eight", 400, seed=1))


def test_the_page_is_one_file_that_asks_for_nothing(eight, tmp_path):
    eight.view(tmp_path / "page.html")
    text = (tmp_path / "page.html").read_text("utf-8")
    assert text.startswith("<!doctype html>")
    assert text.count("</html>") == text.count("</main>") == 1
    assert "default-src 'none'" in text
    addresses = set(re.findall(r"[a-z]+://[^\s\"'`]+", text))
    assert addresses <= {"http://www.w3.org/2000/svg"}
    assert not re.findall(r"<(?:script|link|img|iframe)[^>]*(?:src|href)=\"(?!data:,)", text)
    assert [file.name for file in tmp_path.iterdir()] == ["page.html"]


def test_the_page_starts_where_it_is_told(eight):
    def meta(**options):
        raw = zlib.decompress(packed(eight, **options))
        return json.loads(raw[4 : 4 + int.from_bytes(raw[:4], "little")])["meta"]

    choice = eight.choose_radius()
    assert meta()["radius"] == meta()["choice"]["radius"] == choice.radius
    assert (meta()["choice"]["low"], meta()["choice"]["high"]) == choice.interval
    assert meta(radius=7)["radius"] == 7
    assert meta(radius=np.inf)["radius"] == eight.critical_radii()[-1]
    assert meta(title="Two <rings>")["title"] == "Two <rings>"


def test_a_title_cannot_break_the_page(eight):
    text = page_text(eight.persistence(), None, title="</script><b>&")
    assert "<title>&lt;/script&gt;&lt;b&gt;&amp;</title>" in text
    assert text.count("</script>") == 2


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"radius": -1}, "0 or more"),
        ({"radius": "wide"}, "must be a number"),
        ({"title": 3}, "title must be text"),
    ],
)
def test_what_makes_no_sense_is_refused_before_a_file_is_there(
    eight, tmp_path, options, message
):
    with pytest.raises(ParameterError, match=message):
        eight.view(tmp_path / "page.html", **options)
    assert list(tmp_path.iterdir()) == []


def test_a_page_that_cannot_be_written_says_why(eight, tmp_path):
    with pytest.raises(FileWriteError, match="does not exist"):
        eight.view(tmp_path / "nowhere" / "page.html")


def test_a_hundred_thousand_points_weigh_less_than_15_mb(tmp_path):
    points = np.random.default_rng(1).random((100_000, 2))
    am.AlphaComplex(points).view(tmp_path / "page.html")
    assert (tmp_path / "page.html").stat().st_size < 15e6


# The script


@pytest.mark.parametrize("entry", ["page.js", "widget.js"])
def test_the_bundle_is_a_script_without_imports(entry, tmp_path):
    text = bundle(entry)
    assert not re.search(r"^\s*(import|export)\b", text, re.MULTILINE)
    assert "</script" not in text
    assert text.index('modules["complex.js"]') < text.index('modules["plane.js"]')
    file = tmp_path / "bundle.cjs"
    file.write_text(f'{text}\nconsole.log(Object.keys(modules["{entry}"]).join());\n')
    assert run_node(file).strip() == {"page.js": "main", "widget.js": "render"}[entry]


def test_the_style_sheet_stays_within_the_view():
    text = re.sub(r"@container[^{]*\{|::backdrop", "", style())
    selectors = re.findall(r"(?:^|\})\s*([^{}]+?)\s*\{", text)
    assert len(selectors) > 50
    for selector in selectors:
        assert all(part.strip().startswith(".alphamesh-view") for part in split(selector))


def split(selector):
    """Return the selectors of a list; commas within :is() are not between them."""
    return re.split(r",(?![^()]*\))", selector)


def test_scripts_are_all_used_and_small():
    used = bundle("page.js") + bundle("widget.js")
    for file in STATIC.glob("*.js"):
        assert f'modules["{file.name}"] = ' in used
        assert len(file.read_text("utf-8").splitlines()) <= 400


def test_units_of_the_scripts():
    run_node("--test", SCRIPTS / "view.test.js")


def test_types_of_the_scripts():
    """TypeScript reads the types in the comments: ``npm install --prefix tests/js``."""
    compiler = SCRIPTS / "node_modules" / "typescript" / "bin" / "tsc"
    if not compiler.exists():
        pytest.skip("typescript is not installed: npm install --prefix tests/js")
    run_node(compiler, "--project", SCRIPTS)


# The widget and what notebooks show


def test_the_widget_shares_its_radius():
    pytest.importorskip("anywidget")
    cx = am.AlphaComplex(CASES["shape"])
    widget = cx.widget(height=300)
    assert widget.radius == cx.choose_radius().radius
    assert widget.height == "300px"
    assert cx.widget(7).radius == 7
    seen = []
    widget.observe(lambda change: seen.append(change["new"]), "radius")
    widget.radius = 3
    assert seen == [3.0]
    with pytest.raises(ParameterError, match="0 or more"):
        widget.radius = -1
    assert widget.radius == 3
    with pytest.raises(ParameterError, match="height"):
        cx.widget(height=20)


def test_the_widget_without_anywidget_says_what_to_install(monkeypatch):
    from alphamesh.view.widget import _widget_class

    monkeypatch.setitem(sys.modules, "anywidget", None)
    _widget_class.cache_clear()
    with pytest.raises(MissingLibraryError, match=re.escape('"alphamesh[widget]"')):
        am.AlphaComplex(CASES["two"]).widget()


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


# The command


def run(*arguments):
    pytest.importorskip("click")
    pytest.importorskip("rich")
    from click.testing import CliRunner

    from alphamesh.cli.app import app

    return CliRunner().invoke(app, ["view", *arguments], prog_name="alphamesh")


def test_the_command_writes_a_page(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = run("demo:eight", "-n", "200", "--title", "An eight", "-o", "page.html", "--json")
    assert done.exit_code == 0, done.output
    facts = json.loads(done.stdout)
    assert facts["rule"] == "topology"
    assert [file["path"] for file in facts["files"]] == ["page.html"]
    assert "<title>An eight</title>" in (tmp_path / "page.html").read_text("utf-8")


def test_the_command_shows_the_page_when_asked(tmp_path, monkeypatch):
    pytest.importorskip("click")
    monkeypatch.chdir(tmp_path)
    opened = []
    monkeypatch.setattr("click.launch", opened.append)
    done = run("demo:disc", "-n", "50", "-r", "20", "-o", "page.html", "--open")
    assert done.exit_code == 0, done.output
    assert opened == [(tmp_path / "page.html").resolve().as_uri()]


def test_the_command_wants_a_page(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert ".html" in run("demo:disc", "-o", "page.png").output
    assert "Missing option" in run("demo:disc").output
    assert list(tmp_path.iterdir()) == []


def test_the_command_shows_points_in_space(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    points = am.sample_solid("torus", 300, seed=1)
    np.save("torus.npy", points)
    done = run("torus.npy", "-r", "0.4", "-o", "page.html", "--title", "A torus")
    assert done.exit_code == 0, done.output
    am.AlphaComplex(points).view("wanted.html", 0.4, title="A torus")
    written, wanted = ((tmp_path / f"{name}.html").read_bytes() for name in ("page", "wanted"))
    assert written == wanted
