"""Who does the work: this process, or the workers of a Dask cluster."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import Any, Protocol, TypeVar

from alphamesh.errors import MissingLibraryError, ParameterError

__all__ = ["Workers", "workers_of"]

Task = TypeVar("Task")
Result = TypeVar("Result")

# How often a task is tried again whose worker has died.
_RETRIES = 3


class Workers(Protocol):
    """Calls a function for each of many tasks."""

    def each(
        self, function: Callable[[Task], Result], tasks: Iterable[Task]
    ) -> Iterator[Result]:
        """Yield the results as they come, in any order."""


class _Here:
    """Work in this process, one task after the other."""

    def each(
        self, function: Callable[[Task], Result], tasks: Iterable[Task]
    ) -> Iterator[Result]:
        return map(function, tasks)


class _Cluster:
    """The workers that a ``distributed.Client`` knows."""

    def __init__(self, client: Any) -> None:
        self.client = client

    def each(
        self, function: Callable[[Task], Result], tasks: Iterable[Task]
    ) -> Iterator[Result]:
        from distributed import as_completed

        futures = self.client.map(function, list(tasks), pure=False, retries=_RETRIES)
        try:
            for future in as_completed(futures):  # type: ignore[no-untyped-call]
                yield future.result()
                future.release()
        finally:
            self.client.cancel(futures)


@contextmanager
def workers_of(cluster: Any, processes: int | None) -> Iterator[Workers]:
    """Give workers for a while.

    Parameters
    ----------
    cluster : None, "local", str or distributed.Client
        This process, new processes on this machine, the cluster whose scheduler has
        this address, or the one of a client.
    processes : int, optional
        How many for "local"; by default one for each CPU.
    """
    if cluster is None:
        yield _Here()
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
