"""A real browser, headless, for the tests and benchmarks of the view."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
# Pictures by the processor: the same on every machine.
SWITCHES = ("--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")


def missing() -> str:
    """Return what stands in the way of browser tests, or nothing."""
    try:
        import playwright  # noqa: F401
    except ImportError:
        return "playwright is not installed: pip install playwright"
    if not executable():
        return "there is no Chromium: apt-get install chromium, or set CHROMIUM to its path"
    return ""


def executable() -> str:
    """Return the path of the browser."""
    named = os.environ.get("CHROMIUM", "")
    return named or next((path for name in NAMES if (path := shutil.which(name))), "")


@contextmanager
def chromium() -> Iterator[Any]:
    """Start a browser; skip the tests if there is none, but fail them where CI is set."""
    reason = missing()
    if reason and os.environ.get("CI"):
        pytest.fail(reason)
    if reason:
        pytest.skip(reason)
    from playwright.sync_api import sync_playwright

    with sync_playwright() as player:
        browser = player.chromium.launch(executable_path=executable(), args=list(SWITCHES))
        yield browser
        browser.close()
