"""Builds and runs the fuzzers, and runs what they have found before without them.

The core is fuzzed by libFuzzer, which comes with clang and its runtime library (on Debian
and Ubuntu the packages ``clang`` and ``libclang-rt-14-dev``, with the number of clang's
version; elsewhere LLVM's own packages). CXX may name the compiler. The readers are fuzzed
by atheris (``pip install atheris``). Inputs that lead somewhere new are kept in
``build/fuzz`` from run to run; a minimal set of them stands in ``trust/corpus``.
"""

from __future__ import annotations

import contextlib
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from hashlib import sha256
from pathlib import Path
from types import FrameType
from typing import Any

import numpy as np

from trust import readers
from trust.fuzz import reading

__all__ = ["fuzz_core", "fuzz_readers", "keep", "replay_core", "replay_readers"]

_HERE = Path(__file__).resolve().parent
_ROOT = _HERE.parents[1]
_CORPUS = _HERE.parent / "corpus"
_BUILD = _ROOT / "build" / "fuzz"
_PROOFS = ("box", "core", "plane", "solid", "space", "union")
_COMMON = ("-std=c++17", "-ffp-contract=off", "-pthread", f"-I{_ROOT / 'cpp'}")
_SANITIZED = ("-fsanitize=address,undefined", "-fno-sanitize-recover=undefined")
# Several parts of tiny clouds, and threads at work on them.
_CORE = ("-O1", "-g", "-DALPHAMESH_SMALL_PARTS", "-fsanitize=fuzzer-no-link", *_SANITIZED)
_MOST_BYTES = {"core": 256, "readers": reading.LARGEST}
# What is kept of a corpus, the smallest inputs first.
_MOST_KEPT = {"core": 60_000, "readers": 160_000}


def _clang() -> str:
    named = os.environ.get("CXX", "")
    versions = [f"clang++-{version}" for version in range(25, 13, -1)]
    for name in ([named] if "clang" in named else []) + ["clang++", *versions]:
        if found := shutil.which(name):
            return found
    raise RuntimeError("fuzzing the core needs clang++ with libFuzzer; see trust/fuzz/run.py")


def _core_sources() -> list[Path]:
    text = (_ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    listed = re.search(r"set\(CORE(.*?)\)", text, re.DOTALL)
    if listed is None:
        raise RuntimeError("CMakeLists.txt does not list the sources of the core")
    return [_ROOT / name for name in listed[1].split()]


def _compile(
    compiler: str, flags: tuple[str, ...], sources: list[Path], into: Path
) -> list[str]:
    """Compile what is older than its source or any header; return the object files."""
    into.mkdir(parents=True, exist_ok=True)
    folders = {_ROOT / "cpp"} | {path.parent for path in sources}
    if _HERE in folders:
        folders.add(_HERE.parent)
    newest = max(p.stat().st_mtime for folder in folders for p in folder.glob("*.hpp"))

    def one(source: Path) -> str:
        target = into / f"{source.stem}.o"
        if not target.exists() or target.stat().st_mtime < max(newest, source.stat().st_mtime):
            command = [compiler, *_COMMON, *flags, "-c", str(source), "-o", str(target)]
            subprocess.run(command, check=True)
        return str(target)

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(one, sources))


def _build_fuzzer() -> Path:
    """Build the core to be looked into, and the proofs to be fast."""
    compiler = _clang()
    core = _compile(compiler, _CORE, _core_sources(), _BUILD / "core")
    plain = ("-O2", "-g", "-DALPHAMESH_SMALL_PARTS")
    proofs = _compile(
        compiler, plain, [_HERE / f"{name}.cpp" for name in _PROOFS], _BUILD / "proofs"
    )
    target = _BUILD / "fuzzer"
    # The core comes first: of functions that both have, its own are taken.
    link = ["-fsanitize=fuzzer", *_SANITIZED, "-pthread", *core, *proofs, "-o", str(target)]
    subprocess.run([compiler, *link], check=True)
    return target


def _fuzz(what: str, command: list[str], minutes: float, environment: dict[str, str]) -> Any:
    """Run a fuzzer for some minutes; return what it says, in figures."""
    corpus, failures = _BUILD / f"{what}-corpus", _BUILD / f"{what}-failures"
    for folder in (corpus, failures):
        folder.mkdir(parents=True, exist_ok=True)
    command += [
        *(str(corpus), f"-max_total_time={round(60 * minutes)}", "-len_control=0"),
        *(f"-max_len={_MOST_BYTES[what]}", "-timeout=60", "-rss_limit_mb=2500"),
        *(
            f"-artifact_prefix={failures}{os.sep}",
            "-print_final_stats=1",
            "-report_slow_units=30",
        ),
    ]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.perf_counter()
    done = subprocess.run(
        command, env=os.environ | environment, cwd=_ROOT, check=False, errors="replace",
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        print(done.stderr[-6000:], file=sys.stderr)
    runs = re.search(r"number_of_executed_units:\s*(\d+)", done.stderr)
    places = re.findall(r"cov: (\d+)", done.stderr)
    return {
        "campaign": {"core": "kernels, by libFuzzer", "readers": "readers, by atheris"}[what],
        "cases": int(runs[1]) if runs else 0,
        "places": int(places[-1]) if places else 0,
        "failed": int(done.returncode != 0),
        "seconds": round(time.perf_counter() - start),
        "cpu_seconds": round(
            after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        ),
    }


def fuzz_core(minutes: float) -> dict[str, Any]:
    """Fuzz the kernels; an input that fails is in ``build/fuzz/core-failures``."""
    fuzzer = _build_fuzzer()
    corpus = _BUILD / "core-corpus"
    corpus.mkdir(parents=True, exist_ok=True)
    for path in (_CORPUS / "core").iterdir():
        shutil.copy(path, corpus)
    options = {"ASAN_OPTIONS": "quarantine_size_mb=16:malloc_context_size=4"}
    return _fuzz("core", [str(fuzzer)], minutes, options)


def fuzz_readers(minutes: float) -> dict[str, Any]:
    """Fuzz the readers; an input that fails is in ``build/fuzz/readers-failures``."""
    corpus = _BUILD / "readers-corpus"
    corpus.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        samples = readers.samples(Path(name))
    known = reading.names(samples)
    for number, file in enumerate(known):
        contents = [samples[file][0], *(p.read_bytes() for p in _kept_files(file))]
        for content in contents:
            _put(corpus, reading.encoded(number, content))
    paths = os.pathsep.join(filter(None, ["src", ".", os.environ.get("PYTHONPATH")]))
    command = [sys.executable, "-m", "trust.fuzz.reading"]
    return _fuzz("readers", command, minutes, {"PYTHONPATH": paths})


def _put(folder: Path, data: bytes) -> None:
    (folder / sha256(data).hexdigest()[:16]).write_bytes(data)


def _kept_files(name: str) -> list[Path]:
    folder = _CORPUS / "readers" / name
    return sorted(folder.iterdir()) if folder.exists() else []


# ------------------------------------------------------------------ what is kept


def keep(what: str) -> None:
    """Put a small set of the inputs that reach everything into ``trust/corpus``."""
    found = [path.read_bytes() for path in (_BUILD / f"{what}-corpus").iterdir()]
    found.sort(key=len)
    (_keep_inputs if what == "core" else _keep_files)(found)


def _keep_inputs(found: list[bytes]) -> None:
    with tempfile.TemporaryDirectory() as name:
        least, all_of_them = Path(name, "least"), Path(name, "all")
        for folder in (least, all_of_them):
            folder.mkdir()
        for data in found:
            _put(all_of_them, data)
        options = [
            "-merge=1",
            "-use_counters=0",
            f"-max_len={_MOST_BYTES['core']}",
            str(least),
            str(all_of_them),
        ]
        subprocess.run([_BUILD / "fuzzer", *options], check=True, stderr=subprocess.DEVNULL)
        chosen = sorted((path.read_bytes() for path in least.iterdir()), key=len)
    _keep_within("core", [("core", data) for data in chosen])


def _keep_files(found: list[bytes]) -> None:
    """Keep files that lead from a line of the readers to another as no smaller one does."""
    chosen = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        samples = readers.samples(folder)
        known = reading.names(samples)
        seen: set[tuple[str, int, int]] = set()
        for data in found:
            number, content = reading.decoded(data, len(known))
            file = known[number]
            steps = _steps(lambda f=file, c=content: _read(f, c, samples[f][1], folder))
            if steps - seen:
                seen |= steps
                chosen.append((f"readers/{file}", content))
    _keep_within("readers", chosen)


def _read(file: str, content: bytes, reader: readers.Reader, folder: Path) -> None:
    with contextlib.suppress(Exception):  # those that fail are kept, too
        readers.outcome(file, content, reader, folder)


def _steps(work: Callable[[], None]) -> set[tuple[str, int, int]]:
    """Return the steps from line to line that `work` takes in what reads files."""
    steps: set[tuple[str, int, int]] = set()
    inside = tuple(f"{os.sep}{name}{os.sep}" for name in reading.INSTRUMENTED)

    def enter(frame: FrameType, event: str, _: object) -> Any:
        file = frame.f_code.co_filename
        if not any(part in file for part in inside):
            return None
        last = frame.f_lineno

        def step(frame: FrameType, event: str, _: object) -> Any:
            nonlocal last
            if event == "line":
                steps.add((file, last, frame.f_lineno))
                last = frame.f_lineno
            return step

        return step

    sys.settrace(enter)
    try:
        work()
    finally:
        sys.settrace(None)
    return steps


def _keep_within(what: str, chosen: list[tuple[str, bytes]]) -> None:
    """Keep as many, the smallest first, as the repository has room for."""
    left = _MOST_KEPT[what]
    for folder, data in chosen:
        left -= len(data)
        if left < 0:
            break
        (_CORPUS / folder).mkdir(parents=True, exist_ok=True)
        _put(_CORPUS / folder, data)


# ------------------------------------------------------------------ without a fuzzer


def replay_core(changes: int, *, sanitized: bool = False) -> dict[str, Any]:
    """Prove the kernels on the kept inputs and on so many random changes of them.

    Needs a C++ compiler. The core of an earlier build is taken if there is one; with
    `sanitized`, one with address and undefined-behaviour sanitizers.
    """
    compiler = os.environ.get("CXX") or shutil.which("c++") or shutil.which("g++") or _clang()
    start = time.perf_counter()
    sources = [_HERE / f"{part}.cpp" for part in (*_PROOFS, "replay")]
    flags = _SANITIZED if sanitized else ()
    core = _replayed_core(compiler, sanitized=sanitized)
    proofs = _compile(compiler, ("-O1",), sources, _BUILD / "replay")
    program = str(_BUILD / ("sanitized-replay" if sanitized else "plain-replay"))
    # The core comes first, as for the fuzzer; a library must follow what needs it.
    objects = [*core, *proofs] if sanitized else [*proofs, *core]
    subprocess.run([compiler, *flags, *objects, "-pthread", "-o", program], check=True)
    kept = sorted(str(path) for path in (_CORPUS / "core").iterdir())
    done = subprocess.run(
        [program, str(changes), *kept],
        check=False, capture_output=True, text=True,
        env=os.environ | {"ASAN_OPTIONS": "detect_leaks=0"},
    )  # fmt: skip
    if done.returncode:
        print(done.stderr, file=sys.stderr)
    cases = int(done.stdout or 0)
    return {
        "campaign": f"kept inputs of the kernels{', sanitized' if sanitized else ''}",
        "cases": cases,
        "proved": cases,
        "refused": 0,
        "failed": int(done.returncode != 0),
        "seconds": round(time.perf_counter() - start),
    }


def _replayed_core(compiler: str, *, sanitized: bool) -> list[str]:
    if sanitized:
        # Built faster than it runs faster.
        return _compile(compiler, ("-O0", *_SANITIZED), _core_sources(), _BUILD / "sanitized")
    built = _built_core()
    return (
        [str(built)]
        if built
        else _compile(compiler, ("-O1",), _core_sources(), _BUILD / "plain")
    )


def _built_core() -> Path | None:
    """Return the library of the core that an installation left, if it is up to date."""
    newest = max(path.stat().st_mtime for path in (_ROOT / "cpp").iterdir())
    built = (_ROOT / "build").glob("*/libalphamesh_core.a")
    return next((path for path in built if path.stat().st_mtime >= newest), None)


def replay_readers(changes: int, *, seed: int = 0) -> dict[str, Any]:
    """Read the kept files and so many random changes of them, in this process."""
    start = time.perf_counter()
    tally: Counter[str] = Counter()
    rng = np.random.default_rng(seed)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        samples = readers.samples(folder)
        kept = [(file, path.read_bytes()) for file in samples for path in _kept_files(file)]
        tasks = list(kept)
        for _ in range(changes if kept else 0):
            file, content = kept[int(rng.integers(len(kept)))]
            tasks.append((file, readers.damaged(content, rng)))
        for number, (file, content) in enumerate(tasks):
            try:
                tally[readers.outcome(file, content, samples[file][1], folder)] += 1
            except Exception as error:
                tally["failed"] += 1
                print(f"input {number}, {file}: {error!r}", file=sys.stderr)
    return {
        "campaign": "kept inputs of the readers",
        "cases": len(tasks),
        "read": tally["read"],
        "refused": tally["refused"],
        "failed": tally["failed"],
        "seconds": round(time.perf_counter() - start),
    }
