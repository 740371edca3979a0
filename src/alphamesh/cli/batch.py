"""Commands that take many files: their options, their summary, how they end."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path, PurePath
from typing import Any, TypeVar

import click

from alphamesh.cli.command import Explained, setting
from alphamesh.cli.kinds import DEMO, kind_of
from alphamesh.cli.outputs import check_targets
from alphamesh.cli.progress import Steps
from alphamesh.cli.streams import STDIN
from alphamesh.cli.summary import counted, number, print_json, print_table, size_text
from alphamesh.cli.workers import Outcome, Task, Work, run_tasks
from alphamesh.errors import FileWriteError

__all__ = ["batch_options", "make_folder", "only_one", "run_batch", "threads_each"]

Function = TypeVar("Function", bound=Callable[..., Any])

_OPTIONS = (
    click.option(
        "--output-dir",
        "folder",
        type=click.Path(path_type=Path, file_okay=False),
        metavar="DIR",
        help="Make a file of every INPUT in this folder, under the same name.",
    ),
    click.option(
        "-j",
        "--jobs",
        type=click.IntRange(1),
        metavar="N",
        default=1,
        show_default=True,
        help="With --output-dir: work on so many files at a time.",
    ),
    click.option(
        "-k",
        "--keep-going",
        is_flag=True,
        help="With --output-dir: go on after a file that fails.",
    ),
)


def batch_options(command: Function) -> Function:
    """Add the options of a command that takes many files."""
    for option in reversed(_OPTIONS):
        command = option(command)
    return command


def only_one(sources: Sequence[str], options: dict[str, Any]) -> str:
    """Return the only input, where there is no folder for the results of several."""
    if len(sources) > 1:
        raise click.UsageError(
            f"there are {len(sources)} inputs: add --output-dir DIR, where a file of each "
            "goes, or give one input"
        )
    if options["jobs"] > 1 or options["keep_going"]:
        raise click.UsageError("--jobs and --keep-going are for many files: add --output-dir")
    return sources[0]


def run_batch(
    work: Work,
    sources: Sequence[str],
    suffix: str,
    columns: Sequence[str],
    options: dict[str, Any],
) -> None:
    """Make a file of each input and tell of all; end with an error if any failed.

    Parameters
    ----------
    work : callable
        ``work(source, path)`` writes `path` and returns facts.
    sources : sequence of str
    suffix : str
        Extension of the files to make.
    columns : sequence of str
        The facts that the summary shows.
    options : dict
        Of `batch_options`, and ``as_json`` and ``quiet``.
    """
    folder = options["folder"]
    tasks = [Task(source, folder / f"{_stem(source)}{suffix}") for source in sources]
    _refuse_clashes(tasks)
    make_folder(folder)
    kept = [] if setting("overwrite") else [task for task in tasks if task.target.exists()]
    todo = [task for task in tasks if task not in kept]
    for task in todo:
        check_targets([task.target], task.source, streams=False)
    outcomes = []
    if todo:
        with (
            Steps(quiet=options["quiet"]) as steps,
            steps.step(f"Working on {counted(len(todo), 'file')}") as done,
        ):
            outcomes = run_tasks(
                work, todo, jobs=options["jobs"], keep_going=options["keep_going"], done=done
            )
    for outcome in outcomes:
        for notice in outcome.notices:
            click.echo(f"{click.style('Warning:', fg='yellow')} {notice}", err=True)
    if options["as_json"]:
        _print_facts(outcomes, kept, len(todo))
    else:
        _print_summary(outcomes, kept, columns)
    _raise_failures(outcomes, len(todo))


def _stem(source: str) -> str:
    name = source.removeprefix("demo:") if kind_of(source) == DEMO else PurePath(source).name
    return PurePath(name.removesuffix(".gz")).stem


def _refuse_clashes(tasks: Sequence[Task]) -> None:
    seen: dict[Path, str] = {}
    for task in tasks:
        if task.source == STDIN:
            raise click.UsageError("standard input is one of no name: use -o, not --output-dir")
        other = seen.setdefault(task.target, task.source)
        if other is not task.source:
            raise click.UsageError(
                f"{other!r} and {task.source!r} would both become {str(task.target)!r}; "
                "rename one, or run them into different folders"
            )


def make_folder(folder: Path) -> None:
    """Make the folder, though not the folders above it."""
    try:
        folder.mkdir(exist_ok=True)
    except FileNotFoundError as error:
        raise FileWriteError(
            f"cannot make the folder {str(folder)!r}: {str(folder.parent)!r} does not exist; "
            "create it first, or choose another place"
        ) from error
    except OSError as error:
        raise FileWriteError(
            f"cannot make the folder {str(folder)!r}: {error.strerror}; choose another place"
        ) from error


def threads_each(threads: int | None, jobs: int) -> int | None:
    """Return the threads of each of several processes."""
    return threads if threads or jobs == 1 else max(1, (os.cpu_count() or 1) // jobs)


# ---------------------------------------------------------------------- telling


def _print_facts(outcomes: Sequence[Outcome], kept: Sequence[Task], count: int) -> None:
    made = [outcome for outcome in outcomes if outcome.error is None]
    print_json(
        {
            **({"units": setting("units")} if setting("units") else {}),
            "files": [
                {
                    "path": str(outcome.task.target),
                    "bytes": outcome.task.target.stat().st_size,
                    **(outcome.facts or {}),
                }
                for outcome in made
            ],
            "kept": [str(task.target) for task in kept],
            "failures": [
                {"input": outcome.task.source, "error": outcome.error}
                for outcome in outcomes
                if outcome.error is not None
            ],
            "not_begun": count - len(outcomes),
        }
    )


def _print_summary(
    outcomes: Sequence[Outcome], kept: Sequence[Task], columns: Sequence[str]
) -> None:
    made = [outcome.facts or {} for outcome in outcomes if outcome.error is None]
    columns = [name for name in columns if any(name in facts for facts in made)]
    rows = [
        [
            outcome.task.source,
            *(_cell((outcome.facts or {}).get(name, "")) for name in columns),
            str(outcome.task.target),
            size_text(outcome.task.target.stat().st_size),
        ]
        for outcome in outcomes
        if outcome.error is None
    ]
    if rows:
        print_table(["input", *columns, "written", "size"], rows, words=["input", "written"])
    if kept:
        click.echo(f"{counted(len(kept), 'file')} left as they were (--no-overwrite)")


def _cell(value: Any) -> str:
    if isinstance(value, float):
        return number(value)
    return value if isinstance(value, str) else f"{value:,}"


def _failure(outcome: Outcome) -> str:
    """Return what went wrong, with the name of the input."""
    source, said = outcome.task.source, str(outcome.error)
    return said if source in said else f"{source}: {said}"


def _raise_failures(outcomes: Sequence[Outcome], count: int) -> None:
    failed = [outcome for outcome in outcomes if outcome.error is not None]
    if not failed:
        return
    text = "\n".join(_failure(outcome) for outcome in failed)
    left = count - len(outcomes)
    if left:
        text += f"\n({counted(left, 'file')} not begun; --keep-going goes on after a failure)"
    raise Explained(f"{len(failed)} of {counted(count, 'file')} failed\n{text}")
