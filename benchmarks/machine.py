"""A description of the machine that a reader needs to judge the numbers, and no more."""

from __future__ import annotations

import datetime
import os
import platform
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.jobs import JOBS, version

__all__ = ["cores", "describe", "limit_cores"]


def cores() -> int:
    """Return how many cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def limit_cores(count: int) -> None:
    """Let this process and its children use only the first `count` of its cores."""
    if not hasattr(os, "sched_setaffinity"):
        sys.exit("--cores works only where processes can be bound to cores (Linux)")
    os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:count])


def describe(jobs: Iterable[str]) -> dict[str, Any]:
    """Return the machine, the versions of what is measured, and the load at this moment.

    Names neither the host, nor its user, nor any path.
    """
    libraries = dict.fromkeys(JOBS[name].package for name in jobs)
    return {
        "date": datetime.datetime.now(datetime.UTC).date().isoformat(),
        "cpu": _cpu_model(),
        "cores": cores(),
        "system": f"{platform.system()} {platform.machine()}",
        "python": platform.python_version(),
        "numpy": np.__version__,
        "versions": {library: version(library) for library in libraries},
        "load": round(os.getloadavg()[0], 2) if hasattr(os, "getloadavg") else None,
    }


def _cpu_model() -> str:
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        for line in cpuinfo.read_text(encoding="utf-8").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    if sys.platform == "darwin":
        command = ["sysctl", "-n", "machdep.cpu.brand_string"]
        answer = subprocess.run(command, capture_output=True, text=True, check=False)
        if answer.returncode == 0:
            return answer.stdout.strip()
    return platform.processor() or platform.machine()
