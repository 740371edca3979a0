"""``import alphamesh``: quick, NumPy alone, and every name where it is promised."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import types
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path

import pytest

import alphamesh as am
from alphamesh import _kernels
from alphamesh.errors import MissingLibraryError

OPTIONAL = (
    "PIL",
    "anywidget",
    "click",
    "geopandas",
    "matplotlib",
    "meshio",
    "pandas",
    "pyarrow",
    "pyogrio",
    "pyproj",
    "rich",
    "scipy",
    "shapely",
)


def run(code):
    """Run `code` in a new interpreter and return what it prints, read as JSON."""
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_import_is_quick():
    code = (
        "import time, json; start = time.perf_counter(); import alphamesh;"
        "alphamesh.AlphaComplex; print(json.dumps(time.perf_counter() - start))"
    )
    assert min(run(code) for _ in range(3)) < 0.3


def test_the_main_job_needs_numpy_alone():
    code = (
        "import sys, json, alphamesh\n"
        "first = sorted(sys.modules)\n"
        "shape = alphamesh.AlphaComplex(alphamesh.demo_cloud('eight', 500, seed=1)).at()\n"
        "shape.area, shape.perimeter, shape.counts, shape.boundary_edges, shape.kinds\n"
        "print(json.dumps([first, sorted(sys.modules)]))"
    )
    at_import, in_all = run(code)
    assert "numpy" not in at_import
    assert not set(OPTIONAL) & set(in_all)
    ours = {name for name in at_import if name.startswith("alphamesh")}
    assert ours == {"alphamesh"}


@pytest.mark.parametrize("name", am.__all__)
def test_public_names_are_there(name):
    if name == "plot":
        pytest.importorskip("matplotlib")
    assert getattr(am, name) is getattr(am, name)
    assert name in dir(am)


def test_functions_are_not_hidden_by_their_modules():
    code = (
        "import alphamesh.filtration, alphamesh.delaunay, alphamesh, json\n"
        "from alphamesh import delaunay, filtration\n"
        "from alphamesh.filtration import Filtration\n"
        "print(json.dumps([callable(f) for f in (delaunay, filtration, alphamesh.delaunay)]))"
    )
    assert run(code) == [True, True, True]
    assert isinstance(sys.modules["alphamesh.filtration"], types.ModuleType)
    assert am.filtration is sys.modules["alphamesh.filtration"].filtration


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="module 'alphamesh' has no attribute 'alpha'"):
        am.alpha  # noqa: B018
    with pytest.raises(ImportError, match="cannot import name 'alpha'"):
        from alphamesh import alpha  # noqa: F401


def test_the_version_is_that_of_the_package():
    try:
        expected = version("alphamesh")
    except PackageNotFoundError:
        expected = "0+unknown"
    assert am.__version__ == expected


def test_plotting_without_matplotlib_says_what_to_install():
    code = (
        "import sys, json; sys.modules['matplotlib'] = None\n"
        "import alphamesh as am\n"
        "shape = am.AlphaComplex([[0, 0], [1, 0], [0, 1]]).at(2)\n"
        "said = []\n"
        "for draw in (lambda: am.plot, shape.plot):\n"
        "    try: draw()\n"
        "    except am.errors.MissingLibraryError as error: said.append(str(error))\n"
        "print(json.dumps(said))"
    )
    said = run(code)
    assert len(said) == 2
    assert all('pip install "alphamesh[plot]"' in text for text in said)
    assert issubclass(MissingLibraryError, ImportError)


def test_a_package_without_its_core_says_so():
    code = (
        "import sys, json; sys.modules['alphamesh._kernels._core'] = None\n"
        "import alphamesh as am\n"
        "try: am.AlphaComplex\n"
        "except ImportError as error: print(json.dumps(str(error)))"
    )
    assert "without its compiled core" in run(code)


def test_the_arithmetic_is_what_the_core_needs():
    assert _kernels.self_test() == ""


@pytest.mark.skipif(find_spec("mypy") is None, reason="mypy is not installed")
def test_type_checkers_see_the_lazy_names(tmp_path):
    snippet = tmp_path / "snippet.py"
    snippet.write_text(
        "import alphamesh as am\n"
        "cx = am.AlphaComplex([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], threads=1)\n"
        "reveal_type(cx.at().area)\n"
        "reveal_type(am.filtration([[0.0, 0.0]]))\n"
        "reveal_type(cx.choose_radius().reason)\n"
        "am.AlphaComplex()\n"
        "am.nonsense\n"
    )
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path), str(snippet)],
        capture_output=True,
        text=True,
        check=False,
        cwd=tmp_path,
        env=environment(),
    )
    lines = done.stdout.splitlines()
    said = [line.partition(": ")[2] for line in lines if line.startswith("snippet.py:")]
    assert 'note: Revealed type is "float"' in said[0].replace("builtins.", "")
    assert "alphamesh.filtration.Filtration | alphamesh.filtration3d.Filtration3D" in said[1]
    assert 'note: Revealed type is "str"' in said[2].replace("builtins.", "")
    assert said[3].startswith('error: Missing positional argument "points"')
    assert said[4].startswith('error: Module has no attribute "nonsense"')


def environment():
    """Let mypy find the package that is tested, installed or not."""
    home = Path(am.__file__).resolve().parent.parent
    extra = {} if home.name == "site-packages" else {"MYPYPATH": str(home)}
    return {**os.environ, **extra}
