"""``alphamesh sample``: points from a mask image."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from alphamesh.cli.command import Command, json_option, overwrite_option, quiet_option
from alphamesh.cli.files import PointsFile
from alphamesh.cli.inputs import Input, InputOptions, load, sampling_options
from alphamesh.cli.kinds import DEMO, IMAGE, kind_of
from alphamesh.cli.outputs import Output, Outputs, check_targets, output_options
from alphamesh.cli.progress import Steps
from alphamesh.cli.summary import print_json, print_lines, size_text
from alphamesh.cli.write_points import write_points

__all__ = ["command"]

_EXAMPLES = (
    "alphamesh sample shape.png --points 5000 -o cloud.csv",
    "alphamesh sample scan.tif --threshold 0.2 --seed 3 -o cloud.npy -o cloud.csv",
    "alphamesh sample demo:target -o - | alphamesh info -",
    "alphamesh sample demo:torus-surface -n 5000 -o scan.ply",
)


@click.command("sample", cls=Command, examples=_EXAMPLES)
@click.argument("source", metavar="IMAGE")
@output_options(PointsFile(".csv"), "Write the points here", required=True)
@sampling_options
@overwrite_option
@json_option
@quiet_option
def command(source: str, files: tuple[Path, ...], **options: Any) -> None:
    """Draw points from the white pixels of a mask image, or from a demo solid.

    IMAGE is any image that Pillow reads, or demo:NAME for a built-in shape, or for
    a solid in space such as demo:torus; demo:torus-surface draws from its surface.
    Coordinates in an image are in pixels, x to the right and y upwards, from the lower
    left corner of the image.
    """
    as_json, quiet = options.pop("as_json"), options.pop("quiet")
    if kind_of(source) not in {IMAGE, DEMO}:
        raise click.UsageError(f"{source!r} is no image; points are drawn from images only")
    check_targets(files, source)
    outputs = Outputs()
    with Steps(quiet=quiet) as steps:
        given = load(source, InputOptions(**options), steps)
        outputs.write(
            [Output(path, lambda path: write_points(given.points, path)) for path in files],
            steps,
        )
    if not outputs.streamed:
        _report(given, outputs, as_json=as_json)
    outputs.raise_failures()


def _report(given: Input, outputs: Outputs, *, as_json: bool) -> None:
    """Print what has become of the points."""
    sizes = outputs.sizes()
    if as_json:
        facts = [{"path": path, "bytes": size} for path, size in sizes.items()]
        print_json(
            {
                "input": given.facts,
                "points": len(given.points),
                "files": facts,
                "failures": outputs.failures,
            }
        )
    else:
        written = [f"{path}  ({size_text(size)})" for path, size in sizes.items()]
        print_lines(
            {
                "Input": given.text,
                "Points": f"{len(given.points):,}",
                "Written": "\n".join(written) or "nothing",
            }
        )
