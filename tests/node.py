"""Node, which runs the JavaScript of the view without a browser."""

from __future__ import annotations

import shutil
import subprocess
from importlib.util import find_spec
from pathlib import Path

import pytest

STATIC = Path(__file__).resolve().parent.parent / "src" / "alphamesh" / "view" / "static"
SCRIPTS = Path(__file__).resolve().parent / "js"


def node() -> str:
    """Return the path of Node: that of the system, or the one that Playwright brings."""
    found = shutil.which("node")
    spec = find_spec("playwright")
    if found is None and spec is not None and spec.origin is not None:
        found = shutil.which("node", path=str(Path(spec.origin).parent / "driver"))
    if found is None:
        pytest.skip("node is not installed: pip install playwright brings one")
    return found


def run_node(*arguments: str | Path) -> str:
    """Run Node and return what it prints."""
    done = subprocess.run(
        [node(), *map(str, arguments)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout
