"""Compiles and runs the campaigns of the predicates, written in C++ for their speed."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import tempfile
import time
from pathlib import Path
from typing import Any

__all__ = ["campaign", "compiler"]

_HERE = Path(__file__).resolve().parent
_CORE = _HERE.parent / "cpp"
_PROGRAMS = {
    "predicates.cpp": ("predicates2.cpp", "predicates3.cpp"),
    "powers.cpp": ("memory.cpp", "power3.cpp", "predicates2.cpp", "predicates3.cpp"),
}
_FLAGS = ("-O2", "-std=c++17", "-ffp-contract=off", "-DALPHAMESH_COUNT")


def compiler() -> str | None:
    """Return a C++ compiler, if there is one."""
    named = os.environ.get("CXX")
    return named or next(filter(None, map(shutil.which, ("c++", "g++", "clang++"))), None)


def campaign(count: int, *, seed: int = 1) -> list[dict[str, Any]]:
    """Hold each predicate against whole numbers in `count` near-degenerate cases.

    Returns
    -------
    list of dict
        One for each predicate: cases, wrong signs, how many were exactly zero, how many
        the filter left open, and how many double-double left open, too.

    Raises
    ------
    RuntimeError
        If there is no C++ compiler.
    """
    program = compiler()
    if program is None:
        raise RuntimeError(
            "the campaign of the predicates needs a C++ compiler; name it in CXX"
        )
    found: list[dict[str, Any]] = []
    for name, parts in _PROGRAMS.items():
        found += _run(program, [_HERE / name, *(_CORE / part for part in parts)], count, seed)
    return found


def _run(program: str, sources: list[Path], count: int, seed: int) -> list[dict[str, Any]]:
    """Compile and run one program."""
    start = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        built = Path(folder) / "campaign"
        command = [program, *_FLAGS, f"-I{_CORE}", f"-I{_HERE}", *map(str, sources)]
        subprocess.run([*command, "-o", str(built)], check=True)
        done = subprocess.run(
            [str(built), str(count), str(seed)], check=True, stdout=subprocess.PIPE, text=True
        )
    seconds = round(time.perf_counter() - start)
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    return [{"campaign": line.pop("predicate"), **line, "seconds": seconds} for line in lines]
