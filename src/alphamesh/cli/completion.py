"""``alphamesh completion``: a script that lets a shell complete commands and options."""

from __future__ import annotations

import click
from click.shell_completion import BashComplete, FishComplete, ShellComplete, ZshComplete

from alphamesh.cli.command import Command

__all__ = ["command"]

_SHELLS: dict[str, type[ShellComplete]] = {
    "bash": BashComplete,
    "zsh": ZshComplete,
    "fish": FishComplete,
}
_PROGRAM = "alphamesh"
_VARIABLE = "_ALPHAMESH_COMPLETE"

_EXAMPLES = (
    "alphamesh completion bash >> ~/.bashrc",
    "alphamesh completion zsh >> ~/.zshrc",
    "alphamesh completion fish > ~/.config/fish/completions/alphamesh.fish",
)


@click.command("completion", cls=Command, examples=_EXAMPLES)
@click.argument("shell", type=click.Choice(list(_SHELLS)))
def command(shell: str) -> None:
    """Print a script with which SHELL completes commands, options and files.

    Append it to the file that your shell reads at its start, and open a new
    shell. Bash must be 4.4 or later.
    """
    kind = _SHELLS[shell]
    known = {"complete_func": f"_{_PROGRAM}_completion", "complete_var": _VARIABLE}
    click.echo(kind.source_template % {**known, "prog_name": _PROGRAM})
