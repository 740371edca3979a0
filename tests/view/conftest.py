"""Pages to be visited, in the plane and in space, and the browser for it."""

from __future__ import annotations

import numpy as np
import pytest

import alphamesh as am
from browser import chromium
from view_page import Visit


@pytest.fixture(scope="package")
def eight():
    return am.AlphaComplex(am.demo_cloud("eight", 400, seed=1))


@pytest.fixture(scope="package")
def file(eight, tmp_path_factory):
    path = tmp_path_factory.mktemp("view") / "page.html"
    eight.view(path, title="An eight")
    return path


@pytest.fixture(scope="package")
def browser():
    with chromium() as started:
        yield started


@pytest.fixture
def visit(browser, file):
    with Visit(browser, file) as opened:
        yield opened


@pytest.fixture(scope="package")
def hollow():
    """A ball with a void, and a few points far from it."""
    rng = np.random.default_rng(7)
    points = rng.normal(size=(500, 3))
    points *= (rng.uniform(0.55, 1, 500) / np.linalg.norm(points, axis=1))[:, None]
    return am.AlphaComplex(np.concatenate((points, rng.uniform(1.6, 1.8, (4, 3)))))


@pytest.fixture(scope="package")
def solid(hollow, tmp_path_factory):
    path = tmp_path_factory.mktemp("view") / "solid.html"
    hollow.view(path, 0.3, title="A hollow ball")
    return path


@pytest.fixture(scope="package")
def crowns(tmp_path_factory):
    """Discs of different sizes, some of them hidden, and their page."""
    rng = np.random.default_rng(4)
    trees, radii = rng.random((70, 2)) * [60, 48], rng.lognormal(0.9, 0.5, 70)
    cx = am.AlphaComplex(trees, weights=radii**2)
    path = tmp_path_factory.mktemp("view") / "crowns.html"
    cx.view(path, title="Crowns")
    return cx, path


@pytest.fixture(scope="package")
def atoms(tmp_path_factory):
    """The page of balls of different sizes along a helix."""
    rng = np.random.default_rng(2)
    t = np.linspace(0, 12, 50)
    axis = np.column_stack((3 * np.cos(t), 3 * np.sin(t), 0.9 * t))
    weights = rng.choice([1.7, 1.5, 1.2], 50) ** 2
    path = tmp_path_factory.mktemp("view") / "atoms.html"
    am.AlphaComplex(axis + rng.normal(0, 0.4, (50, 3)), weights=weights).view(path)
    return path


@pytest.fixture(scope="package")
def tile(tmp_path_factory):
    """A box in the plane with a round hole across its border, and its page."""
    points = np.random.default_rng(3).random((160, 2)) * 10
    away = np.abs(points - [9, 1.5])
    points = points[np.hypot(*np.minimum(away, 10 - away).T) > 2]
    cx = am.AlphaComplex(points, periods=(10, 10))
    path = tmp_path_factory.mktemp("view") / "tile.html"
    cx.view(path, title="A box")
    return cx, path


@pytest.fixture(scope="package")
def block(tmp_path_factory):
    """A box in space with a network in it, and its page."""
    points = np.random.default_rng(1).random((500, 3))
    x, y, z = 2 * np.pi * points.T
    inside = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x) > 0.2
    cx = am.AlphaComplex(points[inside], periods=(1, 1, 1))
    path = tmp_path_factory.mktemp("view") / "block.html"
    cx.view(path, title="A network")
    return cx, path


@pytest.fixture
def room(browser, solid):
    with Visit(browser, solid) as opened:
        yield opened
