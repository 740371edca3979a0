"""Long kernels can be interrupted and watched, and let other Python threads run."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import alphamesh
from alphamesh import _kernels
from alphamesh.delaunay import delaunay
from alphamesh.filtration import filtration

MILLION = np.random.default_rng(0).uniform(size=(1_000_000, 2))

# Builds a cloud until it is interrupted, and tells how far it came.
VICTIM = """
import sys
import numpy as np
from alphamesh import _kernels

points = np.random.default_rng(0).uniform(size=(2_000_000, 2))
seen = []

def progress(share):
    seen.append(share)
    if len(seen) == 2:
        print("running", flush=True)

try:
    _kernels.{kernel}(points, {threads}, progress)
except KeyboardInterrupt:
    print("interrupted", seen[-1] < 1, flush=True)
"""


@pytest.mark.skipif(os.name != "posix", reason="sends SIGINT to another process")
@pytest.mark.parametrize(
    ("kernel", "threads"), [("alpha2", 1), ("alpha2", 2), ("delaunay2", 1)]
)
def test_ctrl_c_ends_within_a_second(kernel, threads):
    home = str(Path(alphamesh.__file__).parents[1])
    with subprocess.Popen(
        [sys.executable, "-c", VICTIM.format(kernel=kernel, threads=threads)],
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": home},
    ) as process:
        assert process.stdout.readline() == "running\n"
        start = time.monotonic()
        process.send_signal(signal.SIGINT)
        assert process.stdout.readline() == "interrupted True\n"
        assert time.monotonic() - start < 1.0
        assert process.wait() == 0


@pytest.mark.parametrize("build", [delaunay, filtration])
def test_progress_rises_to_one_in_this_thread(build):
    seen = []
    build(
        MILLION, threads=1, progress=lambda share: seen.append((share, threading.get_ident()))
    )
    shares, threads = zip(*seen, strict=True)
    assert len(shares) >= 2
    assert list(shares) == sorted(shares)
    assert shares[0] >= 0 and shares[-1] == 1
    assert set(threads) == {threading.get_ident()}


@pytest.mark.parametrize("build", [delaunay, filtration])
def test_an_error_in_progress_stops_the_work(build):
    def progress(share):
        raise ZeroDivisionError(share)

    with pytest.raises(ZeroDivisionError) as caught:
        build(MILLION, threads=1, progress=progress)
    assert caught.value.args[0] < 1
    # Nothing of the broken-off call is left behind.
    assert len(build(MILLION[:1000]).points) == 1000


@pytest.mark.parametrize("build", [delaunay, filtration])
def test_other_threads_run_meanwhile(build):
    ticks, done = [], threading.Event()

    def tick():
        while not done.wait(0.002):
            ticks.append(time.monotonic())

    thread = threading.Thread(target=tick)
    thread.start()
    try:
        start = time.monotonic()
        build(MILLION, threads=1)
        end = time.monotonic()
    finally:
        done.set()
        thread.join()
    during = [t for t in ticks if start < t < end]
    # With the GIL held, none but the first and the last few could be there.
    assert len(during) > 10
    assert np.diff([start, *during, end]).max() < 0.5 * (end - start)


@pytest.mark.parametrize("threads", [0, -1, 1.5, True, "2"])
def test_wrong_numbers_of_threads(threads):
    with pytest.raises(alphamesh.errors.ParameterError, match="threads"):
        delaunay([[0.0, 0.0]], threads=threads)


def test_self_test():
    assert _kernels.self_test() == ""
