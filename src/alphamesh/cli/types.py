"""Kinds of values on the command line, refused at once where they cannot be right."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    ParamType = click.ParamType[Any]
else:
    ParamType = click.ParamType  # generic in newer versions of click only

__all__ = [
    "AUTO",
    "STREAM",
    "BettiType",
    "ColumnsType",
    "FigureFile",
    "FilmFile",
    "MeshFile",
    "PointsFile",
    "RadiiType",
    "RadiusType",
    "TableFile",
]

AUTO = "auto"

# Standard input or output in the place of a file.
STREAM = Path("-")


class RadiusType(ParamType):
    """A radius: a number of at least 0, ``auto``, or the name of a rule."""

    name = "radius"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float | str:
        """Return a number, or the name of a rule."""
        from alphamesh.radius import DEFAULT_RULE, rule_names

        if value == AUTO:
            return DEFAULT_RULE
        if value in rule_names():
            return str(value)
        try:
            radius = float(value)
        except ValueError:
            rules = ", ".join((AUTO, *rule_names()))
            self.fail(
                f"{value!r} is neither a number nor one of the rules: {rules}", param, ctx
            )
        if not radius >= 0:
            self.fail(f"{value!r} is not a number of at least 0", param, ctx)
        return radius


class RadiiType(ParamType):
    """The radii of a film: the name of a rule, or numbers with commas between them."""

    name = "radii"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> str | list[float]:
        """Return the name of a rule, or the numbers."""
        from alphamesh.film.radii import RADII_RULES

        if isinstance(value, list) or value in RADII_RULES:
            return value if isinstance(value, list) else str(value)
        try:
            radii = [float(part) for part in str(value).split(",")]
        except ValueError:
            self.fail(
                f"{value!r} is neither a list of numbers nor one of the rules: "
                + ", ".join(RADII_RULES),
                param,
                ctx,
            )
        if not all(0 <= radius < float("inf") for radius in radii):
            self.fail(f"{value!r} holds a number that is no finite radius", param, ctx)
        return radii


class BettiType(ParamType):
    """Components and holes, ``b0,b1``."""

    name = "betti"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[int, int]:
        """Return the two numbers."""
        if isinstance(value, tuple):
            return value
        parts = [part.strip() for part in str(value).split(",")]
        if len(parts) != 2 or not all(part.isdigit() for part in parts):
            self.fail(f"{value!r} is not components and holes, such as 1,2", param, ctx)
        return int(parts[0]), int(parts[1])


class ColumnsType(ParamType):
    """Two columns, ``x,y``, by name or by number counted from 0."""

    name = "columns"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[str | int, str | int]:
        """Return the two names or numbers."""
        if isinstance(value, tuple):
            return value
        names = [name.strip() for name in str(value).split(",")]
        if len(names) != 2 or not all(names):
            self.fail(f"{value!r} is not two columns, such as x,y or 0,1", param, ctx)
        first, second = (int(name) if name.isdigit() else name for name in names)
        return first, second


class _File(ParamType):
    """A file to write, in a format that its extension tells."""

    name = "file"
    what = "file"

    def formats(self) -> tuple[str, ...]:
        """Return the extensions that are known, each with its dot."""
        raise NotImplementedError

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> Path:
        """Return the path if its extension is known."""
        path = Path(value)
        known = self.formats()
        if path.suffix.lower() not in known:
            named = f"the extension {path.suffix!r}" if path.suffix else "no extension"
            self.fail(
                f"{str(path)!r} has {named}; a {self.what} ends in one of: {', '.join(known)}",
                param,
                ctx,
            )
        return path


class MeshFile(_File):
    """A mesh file to write."""

    what = "mesh file"

    def formats(self) -> tuple[str, ...]:
        """Return the extensions of mesh files."""
        from alphamesh.io.meshes import MESH_FORMATS

        return tuple(MESH_FORMATS)


class FigureFile(_File):
    """A picture to write."""

    what = "picture"

    def formats(self) -> tuple[str, ...]:
        """Return the extensions of pictures."""
        return (".png", ".pdf", ".svg")


class FilmFile(_File):
    """A film to write."""

    what = "film"

    def formats(self) -> tuple[str, ...]:
        """Return the extensions of films."""
        from alphamesh.film.film import FILM_FORMATS

        return FILM_FORMATS


class TableFile(_File):
    """A table of results to write."""

    what = "table"

    def formats(self) -> tuple[str, ...]:
        """Return the extensions of tables."""
        return (".csv", ".tsv", ".npz")


class PointsFile(_File):
    """A file of points to write; ``-`` is standard output."""

    what = "file of points"

    def formats(self) -> tuple[str, ...]:
        """Return the extensions of files of points."""
        from alphamesh.cli.write_points import POINT_WRITERS

        return tuple(POINT_WRITERS)

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> Path:
        """Return the path if its extension is known, or ``-``."""
        return STREAM if value == "-" else super().convert(value, param, ctx)
