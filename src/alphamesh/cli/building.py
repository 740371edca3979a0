"""From an input to its complex: the steps that most commands share."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from alphamesh.cli.command import (
    json_option,
    overwrite_option,
    quiet_option,
    setting,
    threads_option,
    units_option,
)
from alphamesh.cli.files import FigureFile
from alphamesh.cli.inputs import Input, InputOptions, load, sampling_options, table_options
from alphamesh.cli.outputs import Outputs, write_bytes
from alphamesh.cli.periods import periods_facts
from alphamesh.cli.progress import Steps
from alphamesh.cli.summary import (
    counted,
    length_text,
    points_text,
    print_json,
    print_lines,
    size_text,
)
from alphamesh.cli.types import AUTO, RadiusType, Rule, SourceType
from alphamesh.cli.weights import weights_option
from alphamesh.errors import DimensionError

if TYPE_CHECKING:
    from alphamesh.complex import AlphaComplex
    from alphamesh.radius import RadiusChoice

__all__ = [
    "Job",
    "cloud_options",
    "need_matplotlib",
    "plot_option",
    "radius_option",
    "radius_text",
    "save_figure",
    "source_argument",
]

Function = TypeVar("Function", bound=Callable[..., Any])

source_argument = click.argument("source", metavar="INPUT", type=SourceType())

radius_option = click.option(
    "-r",
    "--radius",
    type=RadiusType(),
    default=AUTO,
    show_default=True,
    help="Radius in the units of the points, or the rule that chooses it, such as "
    "all-points or topology:holes=2. With --weights it may be negative.",
)


def plot_option(what: str) -> Callable[[Function], Function]:
    """Return a decorator that adds --plot; `what` is its help."""
    return click.option("--plot", "picture", type=FigureFile(), metavar="FILE", help=what)


def cloud_options(command: Function) -> Function:
    """Add the options of every command that reads a cloud and tells of it."""
    common = (quiet_option, json_option, units_option, overwrite_option, threads_option)
    for option in (*common, weights_option, table_options, sampling_options):
        command = option(command)
    return command


def need_matplotlib(pictures: bool = True) -> None:
    """Say before the work if matplotlib is missing though pictures are asked for."""
    if pictures:
        import alphamesh.plot  # noqa: F401


@dataclass(frozen=True, slots=True)
class Job:
    """An input, the complex that was made of it, and how to tell of both."""

    given: Input
    complex: AlphaComplex
    as_json: bool

    @classmethod
    def begin(  # noqa: PLR0913 (what an input is read for)
        cls,
        source: str,
        options: dict[str, Any],
        steps: Steps,
        *,
        space: bool = False,
        attributes: bool = False,
        crs: str | None = None,
    ) -> Job:
        """Read `source` and build its complex; of `options`, those of `cloud_options` count.

        Without `space`, a third coordinate is left out unless --columns names it.
        With `attributes`, other columns of its file are read, too. `crs` is the reference
        system of points that come with none.
        """
        from alphamesh.complex import AlphaComplex

        known = [field.name for field in fields(InputOptions) if field.name in options]
        of_input = {name: options[name] for name in known}
        wanted = InputOptions(**of_input, dimension=None if space else 2)
        given = load(source, wanted, steps, attributes=attributes)
        if crs is not None:
            given = given.placed(crs)
        with steps.step(f"Triangulating {counted(len(given.points), 'point')}") as done:
            built = AlphaComplex(
                given.cloud,
                periods=options.get("periods"),
                threads=options["threads"],
                progress=done,
            )
        return cls(given, built, options["as_json"])

    def choose(self, radius: float | Rule, steps: Steps) -> RadiusChoice:
        """Return the radius given, or the one that a rule chooses."""
        from alphamesh.radius import RadiusChoice

        if not isinstance(radius, Rule):
            return RadiusChoice(radius, "given", "Given on the command line.")
        with steps.step("Choosing the radius"):
            name = None if radius.name == AUTO else radius.name
            return self.complex.choose_radius(name, **radius.options)

    def need_plane(self) -> None:
        """Refuse points in space, of which the command could not tell."""
        if self.complex.points.shape[1] == 3:
            raise DimensionError(
                "this command is for points in the plane, and these are in space; choose two "
                "columns with --columns, or make a mesh of them with alphamesh mesh"
            )

    @property
    def periodic(self) -> bool:
        """Whether the points lie in a periodic box."""
        return getattr(self.complex, "periods", None) is not None

    @property
    def duplicates(self) -> int:
        """Points that repeat an earlier one."""
        return len(self.complex.points) - len(self.complex.simplices[0]) - self.hidden

    @property
    def hidden(self) -> int:
        """Points that heavier ones leave no part of the power diagram."""
        return len(self.complex.hidden)

    def tell(self, facts: dict[str, Any], lines: dict[str, str], outputs: Outputs) -> None:
        """Print input, results and files; end with an error if a file failed."""
        points = len(self.complex.points)
        sizes = outputs.sizes()
        units = setting("units")
        box, box_line = periods_facts(self.complex)
        if outputs.streamed:
            pass  # standard output is taken
        elif self.as_json:
            print_json(
                {
                    "input": self.given.facts,
                    "points": points,
                    "duplicates": self.duplicates,
                    **({} if self.complex.weights is None else {"hidden": self.hidden}),
                    **({"units": units} if units else {}),
                    **box,
                    **facts,
                    "files": [{"path": path, "bytes": size} for path, size in sizes.items()],
                    "failures": outputs.failures,
                }
            )
        else:
            written = [f"{path}  ({size_text(size)})" for path, size in sizes.items()]
            print_lines(
                {
                    "Input": self.given.text,
                    "Points": points_text(points, self.duplicates, self.hidden),
                    **box_line,
                    **lines,
                    **({"Written": "\n".join(written)} if written else {}),
                }
            )
        outputs.raise_failures()


def radius_text(choice: RadiusChoice) -> str:
    """Return a radius, and where it comes from."""
    return f"{length_text(choice.radius)}  ({choice.rule})"


def save_figure(figure: Any, path: Path, dpi: float | None = None) -> None:
    """Write a figure, whole or not at all."""
    from alphamesh.plot import figure_bytes

    write_bytes(figure_bytes(figure, path.suffix.lower().removeprefix("."), dpi=dpi), path)
