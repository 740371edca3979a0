"""What a command is given: an image, a table of points, or a demo shape."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import PurePath
from typing import TYPE_CHECKING, Any, TypeVar

import click
import numpy as np
from numpy.typing import NDArray

from alphamesh.cli.demos import demo_shape, demo_solid
from alphamesh.cli.kinds import DEMO, MESH, POINTS, kind_of
from alphamesh.cli.progress import Steps
from alphamesh.cli.streams import STDIN, from_standard_input
from alphamesh.cli.summary import counted
from alphamesh.cli.types import ColumnsType
from alphamesh.cli.weights import weights_of
from alphamesh.errors import DimensionError, ParameterError

if TYPE_CHECKING:
    from alphamesh.points import Cloud
    from alphamesh.table import PointTable

__all__ = [
    "Input",
    "InputOptions",
    "load",
    "sampling_options",
    "seed_option",
    "table_options",
]

_DEFAULT_COUNT = 2000
_DEFAULT_THRESHOLD = 0.5
_DEFAULT_SEED = 0

Function = TypeVar("Function", bound=Callable[..., Any])


@dataclass(frozen=True, slots=True, kw_only=True)
class InputOptions:
    """Options of input; None for what the command line does not say."""

    count: int | None = None
    threshold: float | None = None
    invert: bool | None = None
    seed: int | None = None
    jitter: bool | None = None
    replace: bool | None = None
    columns: tuple[str | int, ...] | None = None
    file_format: str | None = None
    delimiter: str | None = None
    decimal: str | None = None
    header: bool | None = None
    skip: int | None = None
    comment: str | None = None
    encoding: str | None = None
    key: str | None = None
    layer: str | None = None
    weights: str | int | None = None
    # Not an option: the number of coordinates that a command takes if no columns are named.
    dimension: int | None = None

    @property
    def suffix(self) -> str | None:
        """The extension that the option --from stands for."""
        return self.file_format and f".{self.file_format.lower().removeprefix('.')}"

    @staticmethod
    def table_names() -> tuple[str, ...]:
        """Return the names of what can be said of a table."""
        return tuple(_TABLE)

    def table(self) -> dict[str, Any]:
        """Return what is said of a table, as keywords of ``read_points``."""
        given = {name: getattr(self, name) for name in _TABLE}
        if self.columns is None:
            given["dimension"] = self.dimension
        return {name: value for name, value in given.items() if value is not None}

    def refuse(self, names: dict[str, str], source: str, what: str) -> None:
        """Raise a usage error if an option is given that has no meaning for `source`."""
        for name, option in names.items():
            if getattr(self, name) is not None:
                raise click.UsageError(f"{option} has no meaning for {source!r}, {what}")


_SAMPLING = {
    "count": "--points",
    "threshold": "--threshold",
    "invert": "--invert",
    "seed": "--seed",
    "jitter": "--jitter/--no-jitter",
    "replace": "--replace",
}
_OF_IMAGES = {name: _SAMPLING[name] for name in ("threshold", "invert")}
_OF_PIXELS = {name: _SAMPLING[name] for name in ("jitter", "replace")}
_TABLE = {
    "columns": "--columns",
    "file_format": "--from",
    "delimiter": "--delimiter",
    "decimal": "--decimal",
    "header": "--header/--no-header",
    "skip": "--skip",
    "comment": "--comment",
    "encoding": "--encoding",
    "key": "--key",
    "layer": "--layer",
}
_OF_TABLES = {name: option for name, option in _TABLE.items() if name != "file_format"}


_SAMPLING_OPTIONS: dict[str, dict[str, Any]] = {
    "count": {
        "type": click.IntRange(min=1),
        "metavar": "N",
        "help": "Draw so many points from an image or a demo shape.  "
        f"[default: {_DEFAULT_COUNT}]",
    },
    "threshold": {
        "type": float,
        "metavar": "T",
        "help": "Pixels brighter than T, between 0 (black) and 1 (white), are inside.  "
        f"[default: {_DEFAULT_THRESHOLD}]",
    },
    "invert": {
        "is_flag": True,
        "help": "Dark pixels are inside instead: for dark drawings on light ground.",
    },
    "seed": {
        "type": click.IntRange(min=0),
        "metavar": "N",
        "help": "Start of the random numbers: the same seed draws the same points.  "
        f"[default: {_DEFAULT_SEED}]",
    },
    "jitter": {
        "help": "Anywhere inside the pixels, or on their lower left corners.  [default: jitter]"
    },
    "replace": {
        "is_flag": True,
        "help": "Draw each point's pixel independently, instead of evenly.",
    },
}
_TABLE_OPTIONS: dict[str, dict[str, Any]] = {
    "columns": {
        "type": ColumnsType(),
        "metavar": "X,Y[,Z]",
        "help": "Table: columns by name or by number from 0; three are points in space.  "
        "[default: x,y]",
    },
    "file_format": {
        "metavar": "FORMAT",
        "help": "Format of INPUT, such as csv.  [default: the extension's; of standard "
        "input: found]",
    },
    "delimiter": {
        "metavar": "CHAR",
        "help": "Text: what stands between columns.  [default: found]",
    },
    "decimal": {"metavar": "CHAR", "help": "Text: the decimal mark, . or ,  [default: .]"},
    "header": {"help": "Text: the first line has names.  [default: found]"},
    "skip": {
        "type": click.IntRange(min=0),
        "metavar": "N",
        "help": "Text: lines to skip at the top.  [default: 0]",
    },
    "comment": {"metavar": "CHAR", "help": "Text: what begins a comment.  [default: #]"},
    "encoding": {"metavar": "NAME", "help": "Text: its encoding.  [default: utf-8]"},
    "key": {
        "metavar": "NAME",
        "help": "NPZ: the array that holds the points.  [default: points]",
    },
    "layer": {
        "metavar": "NAME",
        "help": "GeoPackage: the layer that holds the points.  [default: the only one]",
    },
}


@dataclass(frozen=True, slots=True)
class Input:
    """A cloud, and where it comes from, for people (`text`) and scripts (`facts`).

    `table` holds other columns of its file and the reference system, if these were read;
    `weights` is the column of squared radii of balls, if one was named.
    """

    points: NDArray[np.float64]
    text: str
    facts: dict[str, Any]
    table: PointTable | None = None
    weights: NDArray[Any] | None = None

    def placed(self, crs: str) -> Input:
        """Return it with a reference system, which it must not have already, unless the same.

        Raises
        ------
        ParameterError
            If there is no such system, or the points are in another one.
        """
        from alphamesh.table import PointTable

        columns = {} if self.table is None else self.table.columns
        table = PointTable(self.points, columns, crs)
        known = None if self.table is None else self.table.crs
        if known not in (None, table.crs):
            raise ParameterError(
                f"the points are in {known.name}, not in {crs}: leave --crs out, and project "
                "the result with a GIS"
            )
        return replace(self, table=table)

    @property
    def cloud(self) -> Cloud | PointTable | NDArray[np.float64]:
        """The points with all that is known of them."""
        known = self.points if self.table is None else self.table
        if self.weights is None:
            return known
        from alphamesh.points import as_cloud

        return as_cloud(known, weights=self.weights)


def seed_option(command: Function) -> Function:
    """Add --seed alone."""
    return _with_options(command, {"seed": _SAMPLING_OPTIONS["seed"]})


def sampling_options(command: Function) -> Function:
    """Add the options that tell how points are drawn from an image."""
    return _with_options(command, _SAMPLING_OPTIONS)


def table_options(command: Function) -> Function:
    """Add the options that tell how a table of points is laid out."""
    return _with_options(command, _TABLE_OPTIONS)


def _with_options(command: Function, options: dict[str, dict[str, Any]]) -> Function:
    """Add options that are None unless given, under the names of `InputOptions`."""
    for name, settings in reversed(options.items()):
        flags = {**_SAMPLING, **_TABLE}[name]
        short = ["-n"] if name == "count" else []
        command = click.option(*short, flags, name, default=None, **settings)(command)
    return command


def load(
    source: str, options: InputOptions, steps: Steps, *, attributes: bool = False
) -> Input:
    """Return the cloud that `source` stands for, with other columns if `attributes`.

    Raises
    ------
    click.UsageError
        If an option has no meaning for such a source.
    AlphameshError
        If it cannot be read.
    """
    if source != STDIN:
        return _load(source, source, options, steps, attributes)
    with from_standard_input(options.suffix) as path:
        read = _load(str(path), "standard input", options, steps, attributes)
    return replace(read, facts={**read.facts, "name": STDIN})


def _load(
    source: str, name: str, options: InputOptions, steps: Steps, attributes: bool
) -> Input:
    """Return the cloud in a file called `name`."""
    kind = kind_of(source, options.file_format)
    if kind == MESH:
        raise click.UsageError(
            f"{name!r} is a mesh file already; give an image or points "
            f"(alphamesh info {source} tells what is in it)"
        )
    if kind == POINTS:
        options.refuse(_SAMPLING, name, "which is a table: its points are taken as they are")
        return _load_table(source, name, options, steps, attributes)
    options.refuse({**_OF_TABLES, "weights": "--weights"}, name, "which is no table")
    if kind == DEMO:
        options.refuse(_OF_IMAGES, name, "a demo shape, which has no shades")
        if demo_solid(source) is not None:
            return _load_solid(source, options, steps)
    return _load_pixels(source, name, options, steps)


def _load_table(
    source: str, name: str, options: InputOptions, steps: Steps, attributes: bool
) -> Input:
    from alphamesh.io.geo import GEO_FORMATS
    from alphamesh.io.points import read_points, read_table

    facts: dict[str, Any] = {"kind": POINTS, "name": source}
    text = f"{name} (points)"
    suffix = options.suffix or PurePath(source).suffix.lower()
    if not (attributes or suffix in GEO_FORMATS):
        with steps.step(f"Reading {name}"):
            points = read_points(source, **options.table())
            return Input(points, text, facts, None, weights_of(source, options))
    with steps.step(f"Reading {name}"):
        table = read_table(source, **options.table())
        weights = weights_of(source, options, table)
    if table.crs is not None:
        facts["crs"] = table.crs.to_string()
        text = f"{name} (points in {table.crs.name})"
    return Input(table.points, text, facts, table, weights)


def _load_solid(source: str, options: InputOptions, steps: Steps) -> Input:
    """Draw points from a demo solid or its surface."""
    from alphamesh.sampling import sample_solid

    found = demo_solid(source)
    assert found is not None
    solid, of_surface = found
    if options.dimension == 2:
        raise DimensionError(f"{source} lies in space, and this is for points in the plane")
    options.refuse(_OF_PIXELS, source, "a demo solid, which has no pixels")
    count = _DEFAULT_COUNT if options.count is None else options.count
    seed = _DEFAULT_SEED if options.seed is None else options.seed
    with steps.step(f"Drawing {counted(count, 'point')} from {source}"):
        points = sample_solid(solid.name, count, seed=seed, surface=of_surface)
    what = "surface of a demo solid" if of_surface else "demo solid"
    return Input(
        points,
        f"{source} ({what}: {solid.description})",
        {"kind": DEMO, "name": source, "seed": seed},
    )


def _load_pixels(source: str, name: str, options: InputOptions, steps: Steps) -> Input:
    """Draw points from an image or a demo shape."""
    from alphamesh.io.images import read_mask
    from alphamesh.sampling import demo_mask, sample_pixels

    count = _DEFAULT_COUNT if options.count is None else options.count
    threshold = _DEFAULT_THRESHOLD if options.threshold is None else options.threshold
    seed = _DEFAULT_SEED if options.seed is None else options.seed
    kind = kind_of(source, options.file_format)
    with steps.step(f"Drawing {counted(count, 'point')} from {name}"):
        if kind == DEMO:
            mask = demo_mask(demo_shape(source).name)
        else:
            mask = read_mask(source, threshold=threshold, invert=bool(options.invert))
        points = sample_pixels(
            mask,
            count,
            seed=seed,
            jitter=options.jitter is not False,
            replace=bool(options.replace),
        )
    height, width = mask.shape
    inside = int(np.count_nonzero(mask))
    noun = "demo shape" if kind == DEMO else "image"
    return Input(
        points,
        f"{name} ({noun}, {width} x {height}, {counted(inside, 'pixel')} inside)",
        {
            "kind": kind,
            "name": source,
            "width": width,
            "height": height,
            "pixels_inside": inside,
            "seed": seed,
        },
    )
