"""A page of the view, open in a browser, and what is drawn on it."""

from __future__ import annotations

import io

import numpy as np

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


def image_of(content):
    from PIL import Image

    with Image.open(io.BytesIO(content)) as image:
        return np.asarray(image.convert("RGB"))
