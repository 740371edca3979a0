"""Several output files of one command: checked before the work, each whole or not at all."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

import click

from alphamesh.cli.command import Explained, explain, setting
from alphamesh.cli.files import STREAM, File, FormatType
from alphamesh.cli.progress import Steps
from alphamesh.cli.streams import to_standard_output
from alphamesh.errors import AlphameshError, FileWriteError
from alphamesh.io._atomic import atomic_path, check_output

__all__ = ["Output", "Outputs", "check_targets", "output_options", "write_bytes"]

Function = TypeVar("Function", bound=Callable[..., Any])


def output_options(
    kind: File, what: str, *, name: str = "files", required: bool = False, many: bool = False
) -> Callable[[Function], Function]:
    """Return a decorator that adds -o, for files of one kind, and --to.

    Parameters
    ----------
    kind : File
        One that knows the usual format of standard output.
    what : str
        How the help begins, as in "Write the cells here".
    name : str
        The parameter of the command: a tuple of paths.
    required : bool
    many : bool
        Whether --to also tells the format of the files of a batch.
    """
    listed = ", ".join(kind.formats())
    usual = (kind.stream or "").removeprefix(".")
    place = "on standard output, and in --output-dir" if many else "on standard output"

    def keep(ctx: click.Context, param: click.Parameter, value: str | None) -> None:
        ctx.meta["alphamesh.to"] = value

    def add(command: Function) -> Function:
        to = click.option(
            "--to",
            "--format",
            "to",
            type=FormatType(kind),
            metavar="FORMAT",
            expose_value=False,
            callback=keep,
            help=f"Format {place}.  [default: {usual}]",
        )
        output = click.option(
            *("-o", "--output", name),
            type=kind,
            metavar="FILE",
            multiple=True,
            required=required,
            help=f'{what}: {listed}; "-" is standard output. Can be given several times.',
        )
        return output(to(command))

    return add


@dataclass(frozen=True, slots=True)
class Output:
    """A file to write, and the function that writes it whole or not at all.

    `stream` is the usual format of standard output, should that be the file.
    """

    path: Path
    write: Callable[[Path], None]
    stream: str = ".csv"


@dataclass(slots=True)
class Outputs:
    """What became of the files of a command."""

    written: list[Path] = field(default_factory=list)
    failures: list[str] = field(default_factory=list)
    streamed: bool = False

    def write(self, outputs: Sequence[Output], steps: Steps) -> None:
        """Write all files that can be written; what cannot is kept in `failures`."""
        for output in outputs:
            with (
                steps.step(f"Writing {output.path.name}"),
                warnings.catch_warnings(record=True) as noticed,
            ):
                warnings.simplefilter("always")
                try:
                    if output.path == STREAM:
                        to_standard_output(output.write, setting("to") or output.stream)
                        self.streamed = True
                    else:
                        output.write(output.path)
                        self.written.append(output.path)
                except AlphameshError as error:
                    self.failures.append(explain(error))
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


def check_targets(
    targets: Sequence[Path], source: str | None = None, *, streams: bool = True
) -> None:
    """Make sure, before long work, that every file can be written.

    Raises
    ------
    click.UsageError
        If two of them, or one and the input, are the same file, or standard output is
        wanted for two things.
    FileWriteError
        If a folder is missing, for instance, or a file is there and must stay.
    """
    if streams:
        _check_stream(targets)
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
        if setting("overwrite") is False and target.exists():
            raise FileWriteError(
                f"{str(target)!r} exists; choose another name, or leave out --no-overwrite"
            )
        check_output(target)


def _check_stream(targets: Sequence[Path]) -> None:
    """Refuse to send two things to standard output, or a format without it."""
    streams = list(targets).count(STREAM)
    if streams > 1:
        raise click.UsageError("-o - is given twice; there is one standard output")
    context = click.get_current_context(silent=True)
    if streams and context is not None and context.params.get("as_json"):
        raise click.UsageError("--json and -o - would both use standard output")
    if not streams and setting("to"):
        raise click.UsageError(
            "--to tells the format of standard output, which is not used: add -o -, or "
            "leave it out (the extension of FILE tells its format)"
        )


def write_bytes(content: bytes, path: Path) -> None:
    """Write `content` to `path`, whole or not at all."""
    with atomic_path(path) as temporary:
        temporary.write_bytes(content)
