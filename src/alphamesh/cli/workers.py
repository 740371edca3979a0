"""Many files at once: each is made in a place of its own and moved when it is whole."""

from __future__ import annotations

import multiprocessing
import shutil
import signal
import tempfile
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from multiprocessing import resource_tracker
from multiprocessing.connection import Connection, wait
from pathlib import Path
from typing import Any, TypeAlias

import click

from alphamesh.cli.command import explain
from alphamesh.errors import AlphameshError

__all__ = ["Outcome", "Task", "Work", "run_tasks"]

# What makes a file of an input and tells of it; it goes to other processes by its name.
Work: TypeAlias = Callable[[str, Path], dict[str, Any]]

# Seconds between looks at the keyboard, where waiting cannot be interrupted.
_TICK = 0.2


@dataclass(frozen=True, slots=True)
class Task:
    """An input, and the file to make of it."""

    source: str
    target: Path


@dataclass(slots=True)
class Outcome:
    """What became of a task: `facts` if all went well, or else `error`."""

    task: Task
    facts: dict[str, Any] | None = None
    error: str | None = None
    notices: list[str] = field(default_factory=list)


def run_tasks(
    work: Work,
    tasks: Sequence[Task],
    *,
    jobs: int,
    keep_going: bool,
    done: Callable[[float], None],
) -> list[Outcome]:
    """Do all tasks; each target appears whole or not at all, whatever happens.

    Parameters
    ----------
    work : callable
        ``work(source, path)`` writes `path` and returns facts.
    tasks : sequence of Task
        All targets stand in one folder.
    jobs : int
        How many processes work at a time; one works in this process.
    keep_going : bool
        Go on after a failure.
    done : callable
        Called with the fraction that is done.

    Returns
    -------
    list of Outcome
        In the order of `tasks`, without those that were not begun.
    """
    outcomes: dict[Task, Outcome] = {}
    with _stage(tasks[0].target.parent) as stage:
        attempts = _one_by_one if jobs == 1 else _side_by_side
        for outcome in attempts(work, tasks, stage, min(jobs, len(tasks))):
            if outcome.error is None:
                _move(stage, outcome.task.target)
            outcomes[outcome.task] = outcome
            done(len(outcomes) / len(tasks))
            if outcome.error is not None and not keep_going:
                break
    return [outcomes[task] for task in tasks if task in outcomes]


@contextmanager
def _stage(folder: Path) -> Iterator[Path]:
    """Give a folder for unfinished files, on the same disk; it is removed in any case."""
    stage = Path(tempfile.mkdtemp(prefix=".alphamesh-", dir=folder))
    try:
        yield stage
    finally:
        shutil.rmtree(stage, ignore_errors=True)


def _move(stage: Path, target: Path) -> None:
    """Put a file in its place; a shapefile has others beside it."""
    for made in stage.iterdir():
        if made.stem == target.stem:
            final = target.with_name(made.name)
            if final.exists():
                shutil.copymode(final, made)
            made.replace(final)


def _attempt(work: Work, task: Task, stage: Path) -> Outcome:
    """Do one task; what is known to go wrong becomes its error."""
    made = stage / task.target.name
    outcome = Outcome(task)
    with warnings.catch_warnings(record=True) as noticed:
        warnings.simplefilter("always")
        try:
            outcome.facts = work(task.source, made)
        except click.ClickException as error:
            outcome.error = error.format_message()
        except (AlphameshError, ImportError, MemoryError, OSError) as error:
            outcome.error = explain(error)
    if outcome.error is not None:
        outcome.error = outcome.error.replace(str(made), str(task.target))
    outcome.notices = [
        str(notice.message).replace(str(made), str(task.target)) for notice in noticed
    ]
    return outcome


def _one_by_one(work: Work, tasks: Sequence[Task], stage: Path, _: int) -> Iterator[Outcome]:
    for task in tasks:
        yield _attempt(work, task, stage)


# ---------------------------------------------------------------------- processes


@dataclass(slots=True)
class _Worker:
    """A process that does one task after another."""

    process: multiprocessing.process.BaseProcess
    connection: Connection[Any, Any]
    task: Task | None = None


def _side_by_side(
    work: Work, tasks: Sequence[Task], stage: Path, jobs: int
) -> Iterator[Outcome]:
    """Do tasks in several processes, and kill these at the end, however it comes."""
    waiting = list(reversed(tasks))
    workers = [_start(work, stage) for _ in range(jobs)]
    try:
        for worker in workers:
            _give(worker, waiting)
        while busy := [worker for worker in workers if worker.task is not None]:
            ready = wait([worker.connection for worker in busy], _TICK)
            for worker in [worker for worker in busy if worker.connection in ready]:
                outcome = _take(worker)
                if not worker.process.is_alive() and waiting:
                    workers.remove(worker)
                    worker = _start(work, stage)  # noqa: PLW2901 - in the place of a dead one
                    workers.append(worker)
                _give(worker, waiting)
                yield outcome
    finally:
        for worker in workers:
            worker.process.kill()
            worker.process.join()
            worker.connection.close()


def _start(work: Work, stage: Path) -> _Worker:
    # Not a fork: there are threads here, of the progress bar for one.
    context = multiprocessing.get_context("spawn")
    mine, other = context.Pipe()
    process = context.Process(target=_serve, args=(other, work, stage), daemon=True)
    with _no_interrupts():
        process.start()
    other.close()  # so that the end of the process is the end of the pipe
    return _Worker(process, mine)


@contextmanager
def _no_interrupts() -> Iterator[None]:
    """Let processes that start here never hear Ctrl-C: they are killed instead."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    # It lets signals through when it starts, which must not happen in between.
    resource_tracker.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _give(worker: _Worker, waiting: list[Task]) -> None:
    worker.task = waiting.pop() if waiting and worker.process.is_alive() else None
    if worker.task is not None:
        worker.connection.send(worker.task)


def _take(worker: _Worker) -> Outcome:
    """Return what a worker has to tell, also if it has died."""
    assert worker.task is not None
    try:
        outcome: Outcome = worker.connection.recv()
    except EOFError:
        worker.process.join()
        said = f"its process ended with code {worker.process.exitcode}"
        outcome = Outcome(worker.task, error=f"{said}; try fewer --jobs, memory may be short")
    return outcome


def _serve(connection: Connection[Any, Any], work: Work, stage: Path) -> None:
    """Do tasks until there is nobody left to give them."""
    while True:
        try:
            task = connection.recv()
        except EOFError:
            return
        connection.send(_attempt(work, task, stage))
