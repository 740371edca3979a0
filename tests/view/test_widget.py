"""The widget in a page that does what notebooks do."""

from __future__ import annotations

import base64
import json

import pytest

from view_page import Visit


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
