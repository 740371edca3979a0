"""What all commands share: common options, errors as one message, exit codes."""

from __future__ import annotations

import errno
import re
import traceback
import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, TypeVar

import click

from alphamesh.cli import INTERRUPTED, NOTHING_LEFT
from alphamesh.errors import AlphameshError, AlphameshWarning, ParameterError

__all__ = [
    "Command",
    "Explained",
    "explain",
    "json_option",
    "kept_option",
    "overwrite_option",
    "quiet_option",
    "setting",
    "threads_option",
    "units_option",
    "write_section",
]

Function = TypeVar("Function", bound=Callable[..., Any])

_DEBUG = click.Option(
    ["--debug"], is_flag=True, help="Show where in the program an error arose."
)


class Explained(click.ClickException):
    """An error as one message on standard error."""

    exit_code = 1

    def show(self, file: Any = None) -> None:
        """Print the message."""
        click.echo(f"{click.style('Error:', fg='red')} {self.message}", err=True)


class Misused(Explained):
    """An error of the command line itself, such as a parameter out of range."""

    exit_code = 2


# The sections of a help text, and the parameters in each that are not of the command alone.
_SECTIONS: dict[str, tuple[str, ...]] = {
    "Many files": ("folder", "jobs", "keep_going"),
    "Points from images": ("count", "threshold", "invert", "seed", "jitter", "replace"),
    "Files of points": (
        *("columns", "file_format", "delimiter", "decimal", "header"),
        *("skip", "comment", "encoding", "key", "layer", "weights"),
    ),
    "General": ("threads", "overwrite", "units", "as_json", "quiet", "debug"),
}
_SECTION_OF = {name: title for title, names in _SECTIONS.items() for name in names}


class Command(click.Command):
    """A command whose expected errors end in a message and an exit code.

    `examples` are lines for its help.
    """

    def __init__(self, *args: Any, examples: Sequence[str] = (), **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.params.append(_DEBUG)
        self.examples = examples

    def sections(self, ctx: click.Context) -> dict[str, list[tuple[str, str]]]:
        """Return the options in sections: how each is written, and what it does."""
        found: dict[str, list[tuple[str, str]]] = {"Options": []}
        found.update({title: [] for title in _SECTIONS})
        options = [param for param in self.get_params(ctx) if isinstance(param, click.Option)]
        for option in options:
            record = option.get_help_record(ctx)
            if record is not None:
                usual = "General" if option.is_eager else "Options"
                found[_SECTION_OF.get(option.name or "", usual)].append(record)
        return {title: records for title, records in found.items() if records}

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """List the options, those of the command itself first."""
        for title, records in self.sections(ctx).items():
            with formatter.section(title):
                formatter.write_dl(records)

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """End the help with the examples."""
        write_section(formatter, "Examples", self.examples)

    def invoke(self, ctx: click.Context) -> Any:
        """Run the command; translate what is known to go wrong."""
        debug = ctx.params.pop("debug")
        try:
            with _warnings_as_lines():
                return super().invoke(ctx)
        except KeyboardInterrupt:
            click.echo(NOTHING_LEFT, err=True)
            raise click.exceptions.Exit(INTERRUPTED) from None
        except (AlphameshError, ImportError, MemoryError, OSError) as error:
            if getattr(error, "errno", None) == errno.EPIPE:
                raise  # whoever read our output has heard enough: click ends quietly
            if debug:
                click.echo(traceback.format_exc(), err=True)
            kind = Misused if isinstance(error, ParameterError) else Explained
            raise kind(explain(error)) from None


@contextmanager
def _warnings_as_lines() -> Iterator[None]:
    """Show warnings of alphamesh as one line each, whenever they come."""

    def show(message: Warning | str, *_: Any, **__: Any) -> None:
        click.echo(f"{click.style('Warning:', fg='yellow')} {message}", err=True)

    with warnings.catch_warnings():
        warnings.simplefilter("always", AlphameshWarning)
        warnings.showwarning = show
        yield


def write_section(formatter: click.HelpFormatter, title: str, lines: Sequence[str]) -> None:
    """Add lines to a help text as they are."""
    with formatter.section(title):
        for line in lines:
            formatter.write(f"{' ' * formatter.current_indent}{line}\n")


# Errors are written for Python, where parameters are keywords; here they are options.
_OPTION_OF = {
    **{name: f"--{name}" for name in ("crs", "layer", "aggregate", "elevation", "simplify")},
    "file_format": "--from",
    "n": "--points",
    **{name: f"--{name}" for name in ("jitter", "replace", "invert", "threshold", "header")},
    **{name: f"--{name}" for name in ("columns", "delimiter", "decimal", "comment")},
    **{name: f"--{name}" for name in ("skip", "encoding", "key")},
}
_KEYWORD = re.compile(rf"\b({'|'.join(_OPTION_OF)})=(\([^)]*\)|'[^']*'|[\w.]*)")
_RADII = re.compile(r"\bradii=\{'(\w+)': (\w+)\}")
_SAMPLE_MASK = re.compile(r"\bsample_mask(\(.*?\))?")


def _as_option(found: re.Match[str]) -> str:
    """Return ``name=value`` as it is written on the command line."""
    name, value = found.groups()
    if value in {"True", "False"}:
        return _OPTION_OF[name] if value == "True" else f"--no-{name}"
    plain = re.sub(r"[()']", "", value).replace(", ", ",")
    return f"{_OPTION_OF[name]} {plain}".rstrip()


def explain(error: BaseException) -> str:
    """Return what to tell of an error that is known to happen."""
    if isinstance(error, AlphameshError):
        text = _RADII.sub(r"--radius \1=\2", _KEYWORD.sub(_as_option, str(error)))
        return _SAMPLE_MASK.sub("alphamesh sample", text)
    if isinstance(error, MemoryError):
        return "not enough memory; try fewer points (--points), or thin the cloud out"
    return f"{type(error).__name__}: {error} (--debug shows where)"


def setting(name: str) -> Any:
    """Return the value of an option made by `kept_option`, None outside of a command."""
    context = click.get_current_context(silent=True)
    return None if context is None else context.meta.get(f"alphamesh.{name}")


def _keep(ctx: click.Context, param: click.Parameter, value: Any) -> None:
    ctx.meta[f"alphamesh.{param.name}"] = value


def kept_option(*flags: str, **settings: Any) -> Callable[[Function], Function]:
    """Return an option that no command takes as a parameter: `setting` tells its value."""
    return click.option(*flags, expose_value=False, callback=_keep, **settings)


units_option = kept_option(
    "--units", metavar="NAME", help="Name the units of lengths in what is told, such as m."
)
overwrite_option = kept_option(
    "--overwrite/--no-overwrite",
    default=True,
    help="Replace files that are there already, or stop before the work.  [default: overwrite]",
)
json_option = click.option(
    "--json", "as_json", is_flag=True, help="Print one JSON object instead of text."
)
quiet_option = click.option("-q", "--quiet", is_flag=True, help="Show no progress.")
threads_option = click.option(
    "--threads",
    type=click.IntRange(min=1),
    metavar="N",
    help="Use so many threads.  [default: one for each CPU]",
)
