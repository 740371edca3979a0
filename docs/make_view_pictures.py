"""Draw the pictures of docs/view.md: pages in headless Chromium, at three radii each.

Usage: python docs/make_view_pictures.py [NAME ...]
"""

import io
import os
import shutil
import sys
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


def crowns():
    """Return the complex of docs/weights.md."""
    rng = np.random.default_rng(4)
    trees, radii = rng.random((70, 2)) * [60, 48], rng.lognormal(0.9, 0.5, 70)
    return am.AlphaComplex(trees, weights=radii**2)


def helix():
    """Return the complex of balls of different sizes along a helix."""
    rng = np.random.default_rng(2)
    t = np.linspace(0, 14, 90)
    axis = np.column_stack((3 * np.cos(t), 3 * np.sin(t), 0.9 * t))
    radii = rng.choice([1.7, 1.55, 1.52, 1.2], 90)
    return am.AlphaComplex(axis + rng.normal(0, 0.45, (90, 3)), weights=radii**2)


def box():
    """Return the complex of docs/periodic.md."""
    points = np.random.default_rng(3).random((260, 2)) * 10
    away = np.abs(points - [9, 1.5])
    points = points[np.hypot(*np.minimum(away, 10 - away).T) > 2]
    return am.AlphaComplex(points, periods=(10, 10))


def network():
    """Return the complex of a network in a box."""
    points = np.random.default_rng(1).random((3000, 3)) * 10
    x, y, z = 2 * np.pi * points.T / 10
    inside = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x) > 0.2
    return am.AlphaComplex(points[inside], periods=(10, 10, 10))


PAGES = {
    "plane": (plane, "An eight"),
    "space": (space, "A ball with two voids"),
    "crowns": (crowns, "Trees and their crowns"),
    "helix": (helix, "A helix of balls"),
    "box": (box, "A box"),
    "network": (network, "A network in a box"),
}
# The page, light or dark, and what its address says.
SHOTS = {
    "view.png": ("plane", "light", ""),
    "view-early.png": ("plane", "light", "r=9&show=dtebsp"),
    "view-cells.png": ("plane", "dark", "r=13&show=vp"),
    "view-late.png": ("plane", "dark", "r=30"),
    "view-space.png": ("space", "light", "r=0.05&show=besnp"),
    "view-space-chosen.png": ("space", "dark", "r=0.14&show=besnp"),
    "view-space-cut.png": ("space", "light", "r=0.14&show=besnpx"),
    "view-weights.png": ("crowns", "light", "r=2&show=dvebsph"),
    "view-weights-space.png": ("helix", "light", "r=0"),
    "view-box.png": ("box", "light", "r=0.42"),
    "view-box-space.png": ("network", "light", "r=0.85"),
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


def main(*names):
    shots = {name: SHOTS[name] for name in names or SHOTS}
    wanted = {page for page, _, _ in shots.values()}
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as player:
        browser = player.chromium.launch(executable_path=executable(), args=SWITCHES)
        files = {name: Path(folder) / f"{name}.html" for name in PAGES}
        for name in wanted:
            make, title = PAGES[name]
            make().view(files[name], title=title)
        for name, (page, scheme, address) in shots.items():
            content = shoot(browser, files[page], scheme, address)
            if len(content) >= MOST_BYTES:
                raise SystemExit(f"{name} has {len(content):,} bytes; show less")
            (PICTURES / name).write_bytes(content)
            print(f"{name}: {len(content):,} bytes")
        browser.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
