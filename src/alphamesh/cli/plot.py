"""``alphamesh plot``: one picture of a cloud, in one of many views."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from alphamesh._weights import refuse_weights
from alphamesh.cli.building import (
    Job,
    cloud_options,
    need_matplotlib,
    radius_option,
    radius_text,
    save_figure,
    source_argument,
)
from alphamesh.cli.command import Command
from alphamesh.cli.files import FigureFile
from alphamesh.cli.outputs import Output, Outputs, check_targets, output_options
from alphamesh.cli.periods import periods_option
from alphamesh.cli.progress import Steps
from alphamesh.cli.solids import refuse_solid_options, solid_at, solid_options
from alphamesh.cli.types import Rule
from alphamesh.errors import DimensionError, PeriodicError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from alphamesh.complex import AlphaComplex
    from alphamesh.solid import SolidShape

__all__ = ["VIEWS", "command", "figure_of"]

# Views that are there in space, too; for others, a third coordinate is left out.
_IN_SPACE = ("overview", "cloud", "complex", "surface", "diagram", "barcode", "betti")

# Those of them that show a shape.
_OF_SOLIDS = ("overview", "complex", "surface")

# Each view by its name, and whether it shows a radius.
VIEWS: dict[str, bool] = {
    "story": True,
    "overview": True,
    "outlines": False,
    "radii": False,
    "cloud": False,
    "hull": False,
    "voronoi": False,
    "delaunay": False,
    "frame": False,
    "filtration": False,
    "restricted": True,
    "union": True,
    "complex": True,
    "surface": True,
    "diagram": True,
    "barcode": True,
    "betti": True,
}

# Views that show a frame, whose discs are as large as those of the points.
_FRAMED = ("frame", "outlines")

# What is there to see in a periodic box.
_IN_BOX = ("complex", "diagram", "barcode", "betti")

_EXAMPLES = (
    "alphamesh plot shape.png -o story.png",
    "alphamesh plot points.csv --view restricted --radius 0.5 -o cells.svg",
    "alphamesh plot demo:cheese -n 20000 --view betti -o betti.pdf",
    "alphamesh plot demo:trefoil-surface --view surface -o knot.png",
)


@click.command("plot", cls=Command, examples=_EXAMPLES)
@source_argument
@output_options(FigureFile(".png"), "Write the picture here", name="pictures", required=True)
@click.option(
    "--view",
    type=click.Choice(list(VIEWS)),
    metavar="VIEW",
    help=f"What to draw: {', '.join(VIEWS)}. The story is hull, Voronoi, Delaunay, cut "
    f"cells and complex together; in space there are {', '.join(_IN_SPACE)}.  "
    "[default: story; in space, overview]",
)
@radius_option
@solid_options
@click.option(
    "--dpi",
    type=click.FloatRange(20, 1200),
    metavar="N",
    help="Pixels per inch of a PNG.  [default: 160]",
)
@periods_option
@cloud_options
def command(
    source: str,
    pictures: tuple[Path, ...],
    view: str | None,
    radius: float | Rule,
    dpi: float | None,
    **options: Any,
) -> None:
    """Draw one picture of a cloud.

    INPUT is a mask image, a file of points, "-" for a table on standard input,
    or demo:NAME for a built-in shape or solid. Some views show one radius: it is
    chosen unless given.
    """
    check_targets(pictures, source)
    need_matplotlib()
    outputs = Outputs()
    boxed = options["periods"] is not None
    view = _view_of_box(view) if boxed else view
    with Steps(quiet=options["quiet"]) as steps:
        job = Job.begin(source, options, steps, space=view is None or view in _IN_SPACE)
        in_space = job.complex.points.shape[1] == 3 and not boxed
        view = view or ("overview" if in_space else "story")
        _check_view(view, in_space)
        if view in _FRAMED:
            remedy = "take hull or delaunay"
            refuse_weights(job.complex.weights, "the views frame and outlines", remedy)
        facts: dict[str, Any] = {"view": view}
        lines = {"View": view}
        choice = solid = None
        if in_space and view in _OF_SOLIDS:
            choice, solid = solid_at(job, {**options, "radius": radius}, steps)
        else:
            refuse_solid_options(options, f"the view {view} of these points")
            if VIEWS[view]:
                choice = job.choose(radius, steps)
        if choice is not None:
            facts.update(radius=choice.radius, rule=choice.rule)
            lines["Radius"] = radius_text(choice)
        with steps.step("Drawing"):
            if solid is not None:
                figure = _solid_figure(view, solid.shape)
            else:
                figure = figure_of(view, job.complex, choice.radius if choice else None)
        files = [
            Output(path, lambda path: save_figure(figure, path, dpi), ".png")
            for path in pictures
        ]
        outputs.write(files, steps)
    job.tell(facts, lines, outputs)


def _view_of_box(view: str | None) -> str:
    """Return the view of a periodic box, by default the complex."""
    if view is not None and view not in _IN_BOX:
        raise PeriodicError(
            f"the view {view} is for points without --periods; with them, take one of: "
            f"{', '.join(_IN_BOX)}"
        )
    return view or "complex"


def _check_view(view: str, in_space: bool) -> None:
    if in_space and view not in _IN_SPACE:
        raise DimensionError(
            f"the view {view} is for points in the plane, and these are in space; choose two "
            f"columns with --columns, or one of: {', '.join(_IN_SPACE)}"
        )
    if view == "surface" and not in_space:
        raise DimensionError("the view surface is for points in space; take complex")


def _solid_figure(view: str, shape: SolidShape) -> Figure:
    """Return the figure of a shape in space."""
    from alphamesh import plot
    from alphamesh.plot.overview3d import plot_shape_in_space

    if view == "overview":
        return plot_shape_in_space(shape)
    if view == "surface":
        return plot.plot_surface(shape.surface()).figure
    return plot.plot_solid(shape).figure


def figure_of(view: str, built: AlphaComplex, radius: float | None) -> Figure:
    """Return the figure of a view; `radius` is needed by those that show one."""
    from alphamesh import plot
    from alphamesh.complex3d import AlphaComplex3D
    from alphamesh.frame import framed_delaunay
    from alphamesh.points import Cloud

    composed: dict[str, Callable[[], Figure]] = {
        "story": lambda: plot.plot_story(built, radius),
        "overview": lambda: plot.plot_overview(built, radius),
        "outlines": lambda: plot.plot_outlines(built),
        "radii": lambda: plot.plot_radii(built),
    }
    if view in composed:
        return composed[view]()
    single: dict[str, Callable[[], plot.Drawing]] = {
        "cloud": lambda: (
            plot.plot_cloud_in_space(built.points)
            if isinstance(built, AlphaComplex3D)
            else plot.plot_cloud(built.points)
        ),
        "hull": lambda: plot.plot_hull(built.convex_hull),
        "voronoi": lambda: plot.plot_voronoi(built.voronoi),
        "delaunay": lambda: plot.plot_delaunay(built.delaunay),
        "frame": lambda: plot.plot_frame(
            framed_delaunay(Cloud(built.points, weights=built.weights))
        ),
        "filtration": lambda: plot.plot_filtration(built.filtration),
        "restricted": lambda: plot.plot_restricted_voronoi(built.restricted_voronoi(radius)),
        "union": lambda: plot.plot_union(built.restricted_voronoi(radius)),
        "complex": lambda: built.plot(radius),
        "diagram": lambda: plot.plot_diagram(built.persistence(), radius=radius),
        "barcode": lambda: plot.plot_barcode(built.persistence(), radius=radius),
        "betti": lambda: plot.plot_betti(built.persistence(), radius=radius),
    }
    return single[view]().figure
