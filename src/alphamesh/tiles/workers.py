"""Who does the work: threads of this process, or the workers of a Dask cluster."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import contextmanager, nullcontext
from typing import Any, Protocol, TypeVar

from alphamesh._kernels import resolve_threads
from alphamesh._kernels.tiles import Recycling
from alphamesh.errors import MissingLibraryError, ParameterError

__all__ = ["Workers", "computing", "go_on", "workers_of"]

Task = TypeVar("Task")
Result = TypeVar("Result")

# How often a task is tried again whose worker has died.
_RETRIES = 3

# One more thread, which reads or writes, for so many that compute.
_COMPUTING = 4

_ours = threading.local()


class Workers(Protocol):
    """Calls a function for each of many tasks."""

    def each(
        self, function: Callable[[Task], Result], tasks: Iterable[Task]
    ) -> Generator[Result, None, None]:
        """Yield the results as they come, in any order; once closed, the rest is dropped."""


class _StoppedError(Exception):
    """Others have failed, so that nobody waits for the result."""


def go_on(_fraction: float) -> None:
    """Stop the task that this thread is at, if nobody needs it any more.

    It is what tasks give to kernels to be told of progress.
    """
    stop: threading.Event | None = getattr(_ours, "stop", None)
    if stop is not None and stop.is_set():
        raise _StoppedError


@contextmanager
def computing() -> Iterator[None]:
    """Use a processor for a while; what a task does besides is reading and writing.

    There are more threads than may compute at a time, so that no processor waits for the
    disk. This waits until it is this thread's turn.
    """
    turns: threading.Semaphore | None = getattr(_ours, "turns", None)
    with nullcontext() if turns is None else turns:
        yield


class _Here:
    """Work in this process: kernels let go of the interpreter, so that threads are enough."""

    def __init__(self, threads: int) -> None:
        self.threads = threads

    def each(
        self, function: Callable[[Task], Result], tasks: Iterable[Task]
    ) -> Generator[Result, None, None]:
        if self.threads == 1:
            yield from map(function, tasks)
            return
        stop = threading.Event()
        turns = threading.Semaphore(self.threads)
        others = math.ceil(self.threads / _COMPUTING)

        def begin() -> None:
            _ours.stop, _ours.turns = stop, turns

        with ThreadPoolExecutor(self.threads + others, initializer=begin) as pool:
            futures = [pool.submit(function, task) for task in tasks]
            try:
                for future in as_completed(futures):
                    yield future.result()
            finally:
                stop.set()
                pool.shutdown(wait=False, cancel_futures=True)


class _Cluster:
    """The workers that a ``distributed.Client`` knows."""

    def __init__(self, client: Any) -> None:
        self.client = client

    def each(
        self, function: Callable[[Task], Result], tasks: Iterable[Task]
    ) -> Generator[Result, None, None]:
        from distributed import as_completed

        futures = self.client.map(function, list(tasks), pure=False, retries=_RETRIES)
        try:
            for future in as_completed(futures):  # type: ignore[no-untyped-call]
                yield future.result()
                future.release()
        finally:
            self.client.cancel(futures)


@contextmanager
def workers_of(cluster: Any, processes: int | None, threads: int | None) -> Iterator[Workers]:
    """Give workers for a while.

    Parameters
    ----------
    cluster : None, "local", str or distributed.Client
        This process, new processes on this machine, the cluster whose scheduler has
        this address, or the one of a client.
    processes : int, optional
        How many for "local"; by default one for each CPU.
    threads : int, optional
        How many of this process; by default one for each CPU.
    """
    if cluster is None:
        recycling = Recycling()  # a tile takes the memory of the one before
        yield _Here(resolve_threads(threads))
        del recycling
        return
    try:
        import distributed
    except ImportError as error:
        raise MissingLibraryError.of("dask", "tiles", "running tiles on a cluster") from error
    if isinstance(cluster, distributed.Client):
        yield _Cluster(cluster)
    elif cluster == "local":
        with (
            distributed.LocalCluster(  # type: ignore[no-untyped-call]
                n_workers=processes,
                threads_per_worker=1,
                processes=True,
                dashboard_address="127.0.0.1:0",
            ) as local,
            distributed.Client(local) as client,  # type: ignore[no-untyped-call]
        ):
            yield _Cluster(client)
    elif isinstance(cluster, str):
        with distributed.Client(cluster) as client:  # type: ignore[no-untyped-call]
            yield _Cluster(client)
    else:
        raise ParameterError(
            'cluster must be None, "local", the address of a scheduler, or a '
            f"distributed.Client; got {cluster!r}"
        )
