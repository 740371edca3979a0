"""The house rules: which module may import which, and how large pieces may grow."""

from __future__ import annotations

import ast
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
SOURCES = ROOT / "src" / "alphamesh"
MODULES = sorted(SOURCES.rglob("*.py"))
MOST_LINES_OF_A_FILE = 400
MOST_LINES_OF_A_FUNCTION = 40


def named(path):
    return path.relative_to(SOURCES).as_posix()


@pytest.mark.skipif(find_spec("importlinter") is None, reason="import-linter is not installed")
def test_imports_point_down():
    """Check the contracts of pyproject.toml, [tool.importlinter]."""
    code = (
        "from importlinter.cli import lint_imports\n"
        f"raise SystemExit(lint_imports({str(ROOT / 'pyproject.toml')!r}, no_cache=True))\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "0 broken" in done.stdout


@pytest.mark.parametrize("path", MODULES, ids=named)
def test_pieces_stay_small(path):
    text = path.read_text(encoding="utf-8")
    assert len(text.splitlines()) <= MOST_LINES_OF_A_FILE
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            first = node.body[1] if ast.get_docstring(node) and node.body[1:] else node.body[0]
            lines = node.end_lineno - first.lineno + 1
            assert lines <= MOST_LINES_OF_A_FUNCTION, f"{node.name} has {lines} lines of code"


@pytest.mark.parametrize("path", MODULES, ids=named)
def test_the_package_does_not_import_itself_whole(path):
    """Names of `alphamesh` itself are for users: inside, they would run in circles."""
    children = {p.stem for p in SOURCES.iterdir()}
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"relative import in line {node.lineno}"
            if node.module == "alphamesh":
                assert {alias.name for alias in node.names} <= children
        elif isinstance(node, ast.Import):
            assert "alphamesh" not in {alias.name for alias in node.names}


def test_the_public_modules_are_all_there():
    """An import contract about a module that is gone would check nothing."""
    assert len(MODULES) > 20
    assert {"complex.py", "filtration.py", "shape.py"} <= {named(path) for path in MODULES}
