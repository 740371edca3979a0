"""The scripts of the page: bundled, small, typed, with tests of their own."""

from __future__ import annotations

import re
import sys

import pytest

import alphamesh as am
from alphamesh.errors import MissingLibraryError, ParameterError
from alphamesh.view.bundle import bundle, style
from node import SCRIPTS, STATIC, run_node
from view_facts import CASES


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
