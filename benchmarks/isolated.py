"""Measurements that need a fresh process each: peak memory, cold calls, import time.

As a program (``python -m benchmarks.isolated JOB CLOUD.npy``) it runs one job on the cloud
in a file and prints its peak memory beyond the input in bytes, and its seconds.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
from functools import partial
from pathlib import Path

import numpy as np

from benchmarks.clouds import Points
from benchmarks.jobs import JOBS, space
from benchmarks.timing import once

__all__ = ["SPACE", "fresh_run", "import_times"]

SPACE = "space"  # the job of benchmarks.space, which is none of `JOBS`

_ROOT = Path(__file__).resolve().parent.parent

_IMPORTS = """
from time import perf_counter
start = perf_counter()
import numpy
numpy_done = perf_counter()
import alphamesh
package_done = perf_counter()
from alphamesh.complex import AlphaComplex
print(package_done - numpy_done, perf_counter() - package_done, numpy_done - start)
"""


def fresh_run(job: str, points: Points, timeout: float) -> tuple[int, float]:
    """Return the peak memory of a job beyond its input in bytes, and the seconds it takes.

    A fresh process imports the library, runs the job on its first points (so that what
    libraries load late is not counted), reads the cloud, notes how much memory it holds,
    and runs the job once.

    Raises
    ------
    subprocess.TimeoutExpired
        After `timeout` seconds.
    subprocess.CalledProcessError
        If the job fails.
    """
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "cloud.npy"
        np.save(file, points)
        answer = _python("-m", "benchmarks.isolated", job, str(file), timeout=timeout)
    peak, seconds = answer.split()
    return int(peak), float(seconds)


def import_times(repeats: int) -> dict[str, float]:
    """Return the median seconds that imports take in a fresh process.

    ``"import alphamesh"`` is counted after NumPy is there; ``"AlphaComplex"`` is what the
    first use of it adds; ``"import numpy"`` is for comparison.
    """
    runs = [
        [float(word) for word in _python("-c", _IMPORTS, timeout=60).split()]
        for _ in range(repeats)
    ]
    names = ("import alphamesh", "AlphaComplex", "import numpy")
    return {
        name: statistics.median(column)
        for name, column in zip(names, zip(*runs, strict=True), strict=True)
    }


def _python(*arguments: str, timeout: float) -> str:
    """Run a fresh interpreter that sees the same modules, and return what it prints."""
    paths = [str(_ROOT), *(str(Path(path).resolve()) for path in sys.path if path)]
    done = subprocess.run(
        [sys.executable, *arguments],
        capture_output=True,
        text=True,
        check=True,
        timeout=timeout,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)},
    )
    return done.stdout


def _memory(kind: str) -> int:
    """Return the resident memory of this process in bytes: "now" or "peak"."""
    status = Path("/proc/self/status")
    if status.exists():
        # Not ru_maxrss: on Linux a new process inherits the peak of its parent there.
        label = {"now": "VmRSS:", "peak": "VmHWM:"}[kind]
        for line in status.read_text(encoding="ascii").splitlines():
            if line.startswith(label):
                return int(line.split()[1]) * 1024
    import psutil  # type: ignore[import-untyped,unused-ignore]

    info = psutil.Process().memory_info()
    if kind == "now":
        return int(info.rss)
    if sys.platform == "win32":
        return int(info.peak_wset)
    import resource

    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


def _forget_peak() -> None:
    """Let the peak be counted from now on, where the system can (Linux)."""
    references = Path("/proc/self/clear_refs")
    if references.exists():
        references.write_text("5", encoding="ascii")


def _main(job: str, file: str) -> None:
    run = space("filtration", None)() if job == SPACE else JOBS[job].load()
    run(np.array(np.load(file, mmap_mode="r")[:100]))
    points = np.load(file)
    _forget_peak()
    before = _memory("now")
    seconds = once(partial(run, points))
    print(_memory("peak") - before, seconds)


if __name__ == "__main__":
    _main(*sys.argv[1:])
