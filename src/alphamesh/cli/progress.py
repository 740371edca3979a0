"""Progress on standard error: shown on a terminal, and only when it takes a while."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import TracebackType

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeElapsedColumn

__all__ = ["Steps"]

# Seconds of work before anything is shown: short jobs stay silent.
_PATIENCE = 0.6


class Steps:
    """The steps of a command, one bar each; use as a context manager.

    Parameters
    ----------
    quiet : bool
        Show nothing.
    console : rich.console.Console, optional
        Standard error if None; nothing is shown where it is no terminal.
    """

    def __init__(self, *, quiet: bool = False, console: Console | None = None) -> None:
        console = console or Console(file=sys.stderr)
        self._bars = Progress(
            TextColumn("{task.description}"),
            BarColumn(bar_width=32),
            TaskProgressColumn(),
            TimeElapsedColumn(),
            console=console,
            transient=True,
            redirect_stdout=False,
            redirect_stderr=False,
        )
        self._timer: threading.Timer | None = None
        if console.is_terminal and not quiet:
            self._timer = threading.Timer(_PATIENCE, self._bars.start)
            self._timer.daemon = True

    def __enter__(self) -> Steps:
        if self._timer is not None:
            self._timer.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer.join()
            self._bars.stop()

    @contextmanager
    def step(self, description: str) -> Iterator[Callable[[float], None]]:
        """Announce a step; the function given takes the fraction that is done.

        Until it is called, the bar only shows that something is going on.
        """
        task = self._bars.add_task(description, total=None)

        def done(fraction: float) -> None:
            self._bars.update(task, total=1.0, completed=fraction)

        yield done
        done(1.0)
