"""Kinds of files that commands write, each by its extension."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click
from click.shell_completion import CompletionItem

from alphamesh.cli.types import ParamType

__all__ = [
    "STREAM",
    "ConvertedFile",
    "FigureFile",
    "File",
    "FilmFile",
    "FormatType",
    "GeoFile",
    "HullFile",
    "MeshFile",
    "PageFile",
    "PointsFile",
    "TableFile",
]

# Standard input or output in the place of a file.
STREAM = Path("-")


class File(ParamType):
    """A file to write, in a format that its extension tells.

    Parameters
    ----------
    stream : str, optional
        The format in which ``-`` is standard output; None if that is no such file.
    """

    name = "file"
    what = "file"

    def __init__(self, stream: str | None = None) -> None:
        self.stream = stream

    def formats(self) -> tuple[str, ...]:
        """Return the extensions that are known, each with its dot."""
        raise NotImplementedError

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> Path:
        """Return the path if its extension is known, or ``-`` for standard output."""
        path = Path(value)
        if self.stream is not None and path == STREAM:
            return STREAM
        known = self.formats()
        if path.suffix.lower() not in known:
            named = f"the extension {path.suffix!r}" if path.suffix else "no extension"
            self.fail(
                f"{str(path)!r} has {named}; a {self.what} ends in one of: {', '.join(known)}",
                param,
                ctx,
            )
        return path

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """Let the shell look for files."""
        return [CompletionItem(incomplete, type="file")]


class MeshFile(File):
    """A mesh file to write."""

    what = "mesh file"

    def formats(self) -> tuple[str, ...]:
        """Return the extensions of mesh files."""
        from alphamesh.io.meshes import MESH_FORMATS

        return tuple(MESH_FORMATS)


class FigureFile(File):
    """A picture to write."""

    what = "picture"

    def formats(self) -> tuple[str, ...]:
        """Return the extensions of pictures."""
        return (".png", ".pdf", ".svg")


class FilmFile(File):
    """A film to write."""

    what = "film"

    def formats(self) -> tuple[str, ...]:
        """Return the extensions of films."""
        from alphamesh.film.film import FILM_FORMATS

        return FILM_FORMATS


class PageFile(File):
    """A page for web browsers to write."""

    what = "page"

    def formats(self) -> tuple[str, ...]:
        """Return the extensions of pages."""
        return (".html", ".htm")


class TableFile(File):
    """A table of results to write."""

    what = "table"

    def formats(self) -> tuple[str, ...]:
        """Return the extensions of tables."""
        return (".csv", ".tsv", ".npz", ".parquet")


class PointsFile(File):
    """A file of points to write; ``-`` is standard output."""

    what = "file of points"

    def formats(self) -> tuple[str, ...]:
        """Return the extensions of files of points."""
        from alphamesh.cli.write_points import POINT_WRITERS

        return tuple(POINT_WRITERS)


class GeoFile(File):
    """A file of geometries for a GIS to write."""

    what = "file of geometries"

    def formats(self) -> tuple[str, ...]:
        """Return the extensions of files of geometries."""
        from alphamesh.io.geo import GEO_FORMATS

        return tuple(GEO_FORMATS)


class ConvertedFile(File):
    """A file of points, a mesh or geometries to write."""

    what = "file of points, mesh or file of geometries"

    def formats(self) -> tuple[str, ...]:
        """Return the extensions of all."""
        kinds = (PointsFile(), MeshFile(), GeoFile())
        return tuple(dict.fromkeys(suffix for kind in kinds for suffix in kind.formats()))


class HullFile(File):
    """A table of corners or, in space, a mesh to write."""

    what = "table or, in space, mesh"

    def formats(self) -> tuple[str, ...]:
        """Return the extensions of both."""
        kinds = (TableFile(), MeshFile())
        return tuple(dict.fromkeys(suffix for kind in kinds for suffix in kind.formats()))


class FormatType(ParamType):
    """The name of a format in which files of one kind are written."""

    name = "format"

    def __init__(self, kind: File) -> None:
        self.kind = kind

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> str:
        """Return the extension, with its dot."""
        suffix = "." + str(value).lower().removeprefix(".")
        known = self.kind.formats()
        if suffix not in known:
            listed = ", ".join(name.removeprefix(".") for name in known)
            self.fail(f"{value!r} is no format of a {self.kind.what}; formats: {listed}")
        return suffix

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """Return the formats that begin so."""
        names = (name.removeprefix(".") for name in self.kind.formats())
        return [CompletionItem(name) for name in names if name.startswith(incomplete)]
