"""Draw the pictures of docs/view.md: pages in headless Chromium, at three radii each.

Usage: python docs/make_view_pictures.py
"""

import io
import os
import shutil
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image
from playwright.sync_api import sync_playwright

import alphamesh as am

PICTURES = Path(__file__).parent / "pictures"
MOST_BYTES = 300_000
SWITCHES = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
SIZE = {"width": 1280, "height": 800}


def plane():
    """Return the complex of the tutorial's cloud."""
    return am.AlphaComplex(am.demo_cloud("eight", 400, seed=1))


def space():
    """Return the complex of a ball with two voids."""
    rng = np.random.default_rng(0)
    points = rng.normal(size=(9_000, 3))
    points *= (np.cbrt(rng.random(9_000)) / np.linalg.norm(points, axis=1))[:, None]
    first = np.linalg.norm(points - [0.3, 0, 0], axis=1) > 0.32
    second = np.linalg.norm(points - [-0.42, 0, -0.1], axis=1) > 0.25
    return am.AlphaComplex(points[first & second])


PAGES = {"plane": (plane, "An eight"), "space": (space, "A ball with two voids")}
# The page, light or dark, and what its address says.
SHOTS = {
    "view.png": ("plane", "light", ""),
    "view-early.png": ("plane", "light", "r=9&show=dtebsp"),
    "view-cells.png": ("plane", "dark", "r=13&show=vp"),
    "view-late.png": ("plane", "dark", "r=30"),
    "view-space.png": ("space", "light", "r=0.05&show=besnp"),
    "view-space-chosen.png": ("space", "dark", "r=0.14&show=besnp"),
    "view-space-cut.png": ("space", "light", "r=0.14&show=besnpx"),
}


def executable():
    """Return the path of Chromium."""
    names = ("chromium", "chromium-browser", "google-chrome")
    return os.environ.get("CHROMIUM") or next(filter(None, map(shutil.which, names)))


def shoot(browser, file, scheme, address):
    """Return a page as it looks, as a small PNG."""
    page = browser.new_page(viewport=SIZE, color_scheme=scheme)
    page.goto(f"{file.as_uri()}#{address}")
    page.wait_for_function("() => window.alphamesh")
    page.evaluate("alphamesh.drawNow()")
    content = io.BytesIO(page.screenshot())
    page.close()
    out = io.BytesIO()
    Image.open(content).convert("RGB").quantize(255).save(out, "png", optimize=True)
    return out.getvalue()


def main():
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as player:
        browser = player.chromium.launch(executable_path=executable(), args=SWITCHES)
        files = {name: Path(folder) / f"{name}.html" for name in PAGES}
        for name, (make, title) in PAGES.items():
            make().view(files[name], title=title)
        for name, (page, scheme, address) in SHOTS.items():
            content = shoot(browser, files[page], scheme, address)
            if len(content) >= MOST_BYTES:
                raise SystemExit(f"{name} has {len(content):,} bytes; show less")
            (PICTURES / name).write_bytes(content)
            print(f"{name}: {len(content):,} bytes")
        browser.close()


if __name__ == "__main__":
    main()
