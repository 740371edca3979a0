"""The command line: ``alphamesh mesh``, ``plot``, ``animate`` and others."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib.util import find_spec

from alphamesh.errors import MissingLibraryError

__all__ = ["main"]

INTERRUPTED = 130
NOTHING_LEFT = "Interrupted; no half-written file is left."


def main(args: Sequence[str] | None = None) -> None:
    """Run the command line and end the process with its exit code.

    Parameters
    ----------
    args : sequence of str, optional
        The words after ``alphamesh``; those of the process if None.
    """
    for library in ("click", "rich"):
        if find_spec(library) is None:
            error = MissingLibraryError.of(library, "cli", "The command line")
            sys.stderr.write(f"alphamesh: {error}\n")
            sys.exit(1)
    try:
        sys.exit(_run(args))
    except KeyboardInterrupt:  # before or after the command itself, which explains its own
        sys.exit(INTERRUPTED)


def _run(args: Sequence[str] | None) -> int:
    """Return the exit code of a command."""
    import click

    from alphamesh.cli.app import app

    try:
        code = app.main(args=args, prog_name="alphamesh", standalone_mode=False)
    except click.ClickException as error:
        error.show()
        return error.exit_code
    except click.Abort:  # before the command itself, which tells of its own
        click.echo(NOTHING_LEFT, err=True)
        return INTERRUPTED
    return code if isinstance(code, int) else 0
