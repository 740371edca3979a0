"""Under pressure: too little memory, forks, interrupts at any moment."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import alphamesh as am

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="limits and forks of Unix")

LIMITED = """
    import resource, sys
    import numpy as np
    import alphamesh as am
    columns, n, spare = map(int, sys.argv[1:])
    points = np.random.default_rng(0).random((n, columns))
    am.AlphaComplex(points[:1000]).at()  # what is loaded late is there
    with open("/proc/self/statm") as file:
        used = int(file.read().split()[0]) * resource.getpagesize()
    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (used + spare * 2**20, hard))
    try:
        am.filtration(points, threads=2)
        print("built")
    except MemoryError:
        print("no memory")
    # And all is well once there is enough.
    resource.setrlimit(resource.RLIMIT_AS, (soft, hard))
    print(len(am.filtration(points[:500]).simplices[0]))
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="needs /proc")
@pytest.mark.parametrize(("columns", "n"), [(2, 300_000), (3, 60_000)])
@pytest.mark.parametrize("spare", [1, 20, 45, 70])
def test_too_little_memory_is_an_error(columns, n, spare):
    script = [sys.executable, "-c", textwrap.dedent(LIMITED), str(columns), str(n), str(spare)]
    done = subprocess.run(script, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    answer, after = done.stdout.split("\n")[:2]
    assert answer in {"no memory", "built"}
    assert after == "500"
    if spare == 1:
        assert answer == "no memory"


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no forks here")
@pytest.mark.filterwarnings("ignore:.*multi-threaded.*fork:DeprecationWarning")
def test_a_fork_after_use_works():
    rng = np.random.default_rng(1)
    plane, space = rng.random((60_000, 2)), rng.random((20_000, 3))
    wanted = [am.filtration(points, threads=2) for points in (plane, space)]
    child = os.fork()
    if child == 0:
        try:
            again = [am.filtration(points, threads=2) for points in (plane, space)]
            same = all(
                np.array_equal(a.radii[1], b.radii[1])
                for a, b in zip(again, wanted, strict=True)
            )
            os._exit(0 if same else 1)
        except BaseException:
            os._exit(2)
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            assert os.waitstatus_to_exitcode(status) == 0
            return
        time.sleep(0.02)
    os.kill(child, signal.SIGKILL)
    pytest.fail("the child hangs")


def interrupted(work, delay):
    """Return the seconds from Ctrl-C until `work` has ended by it; None if it was faster."""
    sent = []

    def press():
        sent.append(time.monotonic())
        signal.raise_signal(signal.SIGINT)

    timer = threading.Timer(delay, press)
    timer.start()
    try:
        work()
        timer.cancel()
        timer.join()
        time.sleep(0.01)  # a signal that came at the very end is raised here
    except KeyboardInterrupt:
        return time.monotonic() - sent[0]
    return None


def works():
    rng = np.random.default_rng(2)
    space = rng.random((150_000, 3))
    found = am.filtration(space[:60_000])
    shape = am.AlphaComplex(space[:60_000]).at(0.02)
    plane = rng.random((1_000_000, 2))
    return {
        "filtration in the plane": lambda: am.filtration(plane),
        "filtration in space": lambda: am.filtration(space),
        "persistence in space": lambda: am.persistence(found),
        "queries in space": lambda: shape.contains(space),
    }


def test_ctrl_c_at_random_moments():
    rng = np.random.default_rng(int(time.time()))
    stopped = 0
    for name, work in works().items():
        for _ in range(3):
            taken = interrupted(work, float(rng.uniform(0.005, 0.3)))
            if taken is not None:
                stopped += 1
                assert taken < 1.0, name
    assert stopped >= 4
    assert len(am.filtration(np.eye(3)).simplices[2]) == 1


def test_many_threads_at_once_in_space():
    rng = np.random.default_rng(3)
    clouds = [rng.random((int(n), 3)) for n in rng.integers(100, 20_000, 12)]
    alone = [am.filtration(points, threads=1) for points in clouds]
    with ThreadPoolExecutor(6) as pool:
        together = list(pool.map(am.filtration, clouds))
    for one, other in zip(alone, together, strict=True):
        for k in range(4):
            np.testing.assert_array_equal(one.simplices[k], other.simplices[k])
            np.testing.assert_array_equal(one.radii[k], other.radii[k])
