"""Several output files of one command: checked before the work, each whole or not at all."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import click

from alphamesh.cli.command import Explained
from alphamesh.cli.progress import Steps
from alphamesh.cli.types import STREAM
from alphamesh.errors import AlphameshError
from alphamesh.io._atomic import atomic_path, check_output

__all__ = ["Output", "Outputs", "check_targets", "write_bytes"]


@dataclass(frozen=True, slots=True)
class Output:
    """A file to write, and the function that writes it whole or not at all."""

    path: Path
    write: Callable[[Path], None]


@dataclass(slots=True)
class Outputs:
    """What became of the files of a command."""

    written: list[Path] = field(default_factory=list)
    failures: list[str] = field(default_factory=list)

    def write(self, outputs: Sequence[Output], steps: Steps) -> None:
        """Write all files that can be written; what cannot is kept in `failures`."""
        for output in outputs:
            with (
                steps.step(f"Writing {output.path.name}"),
                warnings.catch_warnings(record=True) as noticed,
            ):
                warnings.simplefilter("always")
                try:
                    output.write(output.path)
                    self.written.append(output.path)
                except AlphameshError as error:
                    self.failures.append(str(error))
            for notice in noticed:
                click.echo(f"{click.style('Warning:', fg='yellow')} {notice.message}", err=True)

    def sizes(self) -> dict[str, int]:
        """Return the bytes of each file written."""
        return {str(path): path.stat().st_size for path in self.written}

    def raise_failures(self) -> None:
        """End the command with an error if any file could not be written."""
        if not self.failures:
            return
        text = "\n".join(self.failures)
        if self.written:
            text += f"\n(Written all the same: {', '.join(map(str, self.written))})"
        raise Explained(text)


def check_targets(targets: Sequence[Path], source: str | None = None) -> None:
    """Make sure, before long work, that every file can be written.

    Raises
    ------
    click.UsageError
        If two of them, or one and the input, are the same file.
    FileWriteError
        If a folder is missing, for instance.
    """
    seen = set()
    for target in targets:
        if target == STREAM:
            continue
        place = target.resolve()
        if place in seen:
            raise click.UsageError(f"{str(target)!r} is given twice; each output needs a name")
        if source is not None and Path(source).exists() and place == Path(source).resolve():
            raise click.UsageError(
                f"{str(target)!r} is the input; writing there would destroy it"
            )
        seen.add(place)
        check_output(target)


def write_bytes(content: bytes, path: Path) -> None:
    """Write `content` to `path`, whole or not at all."""
    with atomic_path(path) as temporary:
        temporary.write_bytes(content)
