"""What a command tells on standard output: aligned lines, or one JSON object."""

from __future__ import annotations

import json
import math
import shutil
import textwrap
from collections.abc import Mapping, Sequence
from typing import Any

import click
import numpy as np

from alphamesh.cli.command import setting

__all__ = [
    "area_text",
    "counted",
    "length_text",
    "number",
    "points_text",
    "print_json",
    "print_lines",
    "print_table",
    "size_text",
    "volume_text",
]

_LABEL_WIDTH = 18
_WIDEST = 96


def print_lines(lines: Mapping[str, str]) -> None:
    """Print one aligned entry per label; the labels are dim on a terminal.

    A line break within a text starts a new aligned line; long lines are wrapped.
    """
    indent = " " * (_LABEL_WIDTH + 1)
    width = max(40, min(shutil.get_terminal_size().columns, _WIDEST))
    for label, text in lines.items():
        wrapped = "\n".join(
            textwrap.fill(
                line,
                width,
                initial_indent=indent,
                subsequent_indent=indent,
                break_long_words=False,
                break_on_hyphens=False,
            )
            for line in text.split("\n")
        )
        head = label.ljust(_LABEL_WIDTH)
        head = click.style(head, dim=True) if label else head
        click.echo(f"{head} {wrapped[len(indent) :]}")


def print_table(
    names: Sequence[str], rows: Sequence[Sequence[str]], *, words: Sequence[str] = ()
) -> None:
    """Print aligned columns: words to the left, all others, numbers, to the right."""
    widths = [max(map(len, column)) for column in zip(names, *rows, strict=True)]
    for number_, row in enumerate([names, *rows]):
        cells = (
            cell.ljust(width) if name in words else cell.rjust(width)
            for name, cell, width in zip(names, row, widths, strict=True)
        )
        line = "  ".join(cells).rstrip()
        click.echo(click.style(line, dim=True) if number_ == 0 else line)


def print_json(facts: Mapping[str, Any]) -> None:
    """Print `facts` as one JSON object; numbers that JSON lacks become null."""
    click.echo(json.dumps(_plain(facts), indent=2, allow_nan=False))


def _plain(value: Any) -> Any:
    """Return `value` as JSON knows it."""
    if isinstance(value, Mapping):
        return {str(key): _plain(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple | np.ndarray):
        return [_plain(entry) for entry in value]
    if isinstance(value, np.generic):
        return _plain(value.item())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def number(value: float) -> str:
    """Return a measured number with six significant digits."""
    return f"{value:.6g}"


def length_text(value: float) -> str:
    """Return a length, with its units if --units names them."""
    units = setting("units")
    return number(value) + (f" {units}" if units else "")


def area_text(value: float) -> str:
    """Return an area, with its units if --units names them."""
    units = setting("units")
    return number(value) + (f" {units}²" if units else "")


def volume_text(value: float) -> str:
    """Return a volume, with its units if --units names them."""
    units = setting("units")
    return number(value) + (f" {units}³" if units else "")


def counted(count: int, singular: str, plural: str | None = None) -> str:
    """Return ``1 point`` or ``2,000 points``."""
    return f"{count:,} {singular if count == 1 else plural or singular + 's'}"


def size_text(size: int) -> str:
    """Return a file size as people say it."""
    amount = float(size)
    for unit in ("bytes", "kB", "MB"):
        if amount < 1000:
            return f"{amount:.0f} {unit}" if unit == "bytes" else f"{amount:.3g} {unit}"
        amount /= 1000
    return f"{amount:.3g} GB"


def points_text(points: int, duplicates: int, hidden: int = 0) -> str:
    """Return a number of points, and how many of them repeat others or are hidden."""
    besides = [counted(duplicates, "duplicate")] if duplicates else []
    besides += [f"{hidden:,} hidden"] if hidden else []
    return f"{points:,} ({', '.join(besides)})" if besides else f"{points:,}"
