"""The group of commands; each command's module is loaded when it is used."""

from __future__ import annotations

from importlib import import_module
from importlib.metadata import PackageNotFoundError, version

import click

from alphamesh.cli.command import write_section

__all__ = ["COMMANDS", "EXAMPLES", "EXIT_CODES", "app", "version_text"]

COMMANDS = {
    "mesh": "make meshes from images or files of points",
    "sample": "draw points from a mask image",
    "info": "tell what is in a file of points, an image or a mesh",
    "demo": "write a gallery of demo shapes",
    "plot": "draw a picture of a cloud, its cells or its complex",
    "view": "write a page that shows the complex live under a slider",
    "animate": "make a film of the growing radius",
    "radius": "choose a radius, and say why",
    "polygons": "write the outlines of shapes, holes and all",
    "regions": "measure the pieces of a shape, or its holes",
    "query": "tell which points lie in a shape, and how far off others are",
    "convert": "turn points or a mesh into another format",
    "hull": "find the convex hull",
    "delaunay": "triangulate, with a frame around the cloud or without",
    "voronoi": "find Voronoi cells",
    "restricted": "find Voronoi cells cut by discs of one radius",
    "filtration": "list every simplex and the radius at which it comes",
    "persistence": "tell when components and holes come and go",
    "betti": "count components and holes at every radius",
    "measures": "measure the complex at many radii",
    "molecule": "measure a molecule: volume, surface, voids, atom by atom",
    "tiles": "build a complex larger than memory, tile by tile",
    "completion": "print a script for completion in bash, zsh or fish",
}

EXAMPLES = (
    "alphamesh demo",
    "alphamesh mesh shape.png -o mesh.vtu --plot mesh.png",
    "alphamesh mesh points.csv --radius 0.5 -o mesh.ply",
    "alphamesh COMMAND --help",
)
EXIT_CODES = (
    "0    done",
    "1    something went wrong; the message says what, and what to do",
    "2    the command line itself is wrong",
    "130  interrupted (Ctrl-C); no half-written file is left",
)


class Commands(click.Group):
    """A group whose commands live in modules of the same name."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names in the order of a newcomer's needs."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Load the module of a command."""
        if cmd_name not in COMMANDS:
            return None
        command = import_module(f"alphamesh.cli.{cmd_name}").command
        assert isinstance(command, click.Command)
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """List the commands without loading their modules."""
        with formatter.section("Commands"):
            formatter.write_dl(list(COMMANDS.items()))

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """End the help with examples and exit codes."""
        write_section(formatter, "Examples", EXAMPLES)
        write_section(formatter, "Exit codes", EXIT_CODES)


def version_text() -> str:
    """Return the version that is installed."""
    try:
        return version("alphamesh")
    except PackageNotFoundError:  # run from a source tree
        return "(run from a source tree)"


def _show_version(ctx: click.Context, _: click.Parameter, wanted: bool) -> None:
    if wanted and not ctx.resilient_parsing:
        click.echo(f"alphamesh {version_text()}")
        ctx.exit()


@click.group(
    cls=Commands,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 96},
)
@click.option(
    "--version",
    is_flag=True,
    expose_value=False,
    is_eager=True,
    callback=_show_version,
    help="Show the version and exit.",
)
def app() -> None:
    """Turn a cloud of points into a mesh that keeps its holes: its alpha complex."""
