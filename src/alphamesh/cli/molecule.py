"""``alphamesh molecule``: volume, surface and voids of a molecule."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
import numpy as np

from alphamesh.cli.building import need_matplotlib, plot_option, save_figure
from alphamesh.cli.command import (
    Command,
    json_option,
    overwrite_option,
    quiet_option,
    threads_option,
)
from alphamesh.cli.files import TableFile
from alphamesh.cli.outputs import Output, Outputs, check_targets, output_options
from alphamesh.cli.progress import Steps
from alphamesh.cli.streams import STDIN, from_standard_input
from alphamesh.cli.summary import counted, number, print_json, print_lines, size_text
from alphamesh.cli.tables import write_table
from alphamesh.cli.types import ElementRadiusType

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from alphamesh.molecule import Molecule
    from alphamesh.unions import UnionOfBalls

__all__ = ["command", "element_colors"]

_EXAMPLES = (
    "alphamesh molecule 1crn.cif.gz",
    "alphamesh molecule 1crn.pdb --probe 1.4 -o atoms.csv --plot surface.png",
    "alphamesh molecule heme.pdb --radius Fe=1.4 --json",
)


# Colours by element, as Corey, Pauling and Koltun chose for their models, but paler.
_COLORS = {
    **{"H": "#f4f4f4", "C": "#909aa6", "N": "#5b7fe0", "O": "#e0564a", "S": "#e8c33c"},
    **{"P": "#ef9440", "F": "#8fd17a", "Cl": "#57b957", "Br": "#a4553f", "I": "#8e4fb0"},
}
_OTHER = "#d58ab8"


@click.command("molecule", cls=Command, examples=_EXAMPLES)
@click.argument("source", metavar="FILE")
@output_options(TableFile(".csv"), "Write one line for each atom here", name="tables")
@plot_option("Draw the atoms, coloured by element.")
@click.option(
    "--probe",
    type=click.FloatRange(min=0),
    default=0.0,
    show_default=True,
    metavar="R",
    help="Make all balls larger by the radius of a probe, in angstroms: 1.4 for water.",
)
@click.option(
    "--model",
    type=click.IntRange(min=1),
    default=1,
    show_default=True,
    metavar="N",
    help="Take this model of several.",
)
@click.option(
    "--alternate",
    metavar="LABEL",
    help="Of atoms in several places, take those so labelled.  [default: of each residue the "
    "most occupied]",
)
@click.option(
    "--hydrogens/--no-hydrogens", default=True, help="Keep hydrogens or not.  [default: keep]"
)
@click.option(
    "--waters/--no-waters", default=False, help="Keep water or not.  [default: leave it out]"
)
@click.option(
    "--hetero/--no-hetero",
    default=True,
    help="Keep ligands, ions and sugars or not.  [default: keep]",
)
@click.option(
    "--radius",
    "radii",
    type=ElementRadiusType(),
    multiple=True,
    metavar="ELEMENT=R",
    help="Give an element another radius, in angstroms. Can be given several times.",
)
@threads_option
@overwrite_option
@json_option
@quiet_option
def command(
    source: str,
    tables: tuple[Path, ...],
    picture: Path | None,
    radii: tuple[tuple[str, float], ...],
    **options: Any,
) -> None:
    """Measure a molecule: volume, surface area and voids, in all and by atoms.

    FILE is a PDB or mmCIF file, also packed with gzip, or "-" for one on
    standard input. Atoms are balls of their van der Waals radii; with --probe
    1.4, what is told is the surface that water can reach. A table has one line
    for each atom: the part of the volume nearest to it, and of the surface.
    """
    check_targets([*tables, *([picture] if picture else [])], source)
    need_matplotlib(picture is not None)
    as_json, quiet, threads = (options.pop(name) for name in ("as_json", "quiet", "threads"))
    probe = options.pop("probe")
    outputs = Outputs()
    with Steps(quiet=quiet) as steps:
        molecule = _read(source, steps, radii=dict(radii), **options)
        found = _measured(molecule, probe, threads, steps)
        files = [Output(path, lambda path: _write(molecule, found, path)) for path in tables]
        if picture is not None:
            files.append(Output(picture, lambda path: _draw(molecule, found, path)))
        outputs.write(files, steps)
    if not outputs.streamed:
        _tell(source, _facts(molecule, probe, found), outputs, as_json=as_json)
    outputs.raise_failures()


def _read(source: str, steps: Steps, **options: Any) -> Molecule:
    from alphamesh.io.molecules import read_molecule

    with steps.step("Reading the molecule"):
        if source != STDIN:
            return read_molecule(source, **options)
        with from_standard_input(".txt") as path:  # what it is, its first bytes tell
            return read_molecule(path, **options)


def _measured(
    molecule: Molecule, probe: float, threads: int | None, steps: Steps
) -> UnionOfBalls:
    from alphamesh.complex3d import AlphaComplex3D

    with steps.step(f"Triangulating {counted(len(molecule), 'atom')}") as done:
        built = AlphaComplex3D(
            molecule.points, weights=molecule.weights(probe), threads=threads, progress=done
        )
    with steps.step("Measuring the balls") as done:
        return built.union(0.0, threads=threads, progress=done)


def _facts(molecule: Molecule, probe: float, found: UnionOfBalls) -> dict[str, Any]:
    voids = zip(found.voids.volumes.tolist(), found.voids.surface_areas.tolist(), strict=True)
    symbols, counts = np.unique(molecule.elements, return_counts=True)
    return {
        "atoms": len(molecule),
        "elements": dict(zip(symbols.tolist(), counts.tolist(), strict=True)),
        "chains": len(np.unique(molecule.chains)),
        "probe": probe,
        "units": "Å",
        "volume": found.volume,
        "surface_area": found.surface_area,
        "buried_atoms": int(np.count_nonzero(found.ball_surface_areas == 0)),
        "voids": [{"volume": volume, "surface_area": area} for volume, area in voids],
    }


def _tell(source: str, facts: dict[str, Any], outputs: Outputs, *, as_json: bool) -> None:
    """Print the measures and the files."""
    sizes = outputs.sizes()
    if as_json:
        files = [{"path": path, "bytes": size} for path, size in sizes.items()]
        print_json({"name": source, **facts, "files": files, "failures": outputs.failures})
        return
    listed = ", ".join(f"{count:,} {symbol}" for symbol, count in facts["elements"].items())
    probe = f"{number(facts['probe'])} Å" if facts["probe"] else "none"
    written = [f"{path}  ({size_text(size)})" for path, size in sizes.items()]
    print_lines(
        {
            "Input": source,
            "Atoms": f"{facts['atoms']:,}: {listed}",
            "Probe": probe,
            "Volume": f"{number(facts['volume'])} Å³",
            "Surface area": f"{number(facts['surface_area'])} Å²",
            "Buried atoms": f"{facts['buried_atoms']:,}, with no part of the surface",
            "Voids": _voids_text([void["volume"] for void in facts["voids"]]),
            **({"Written": "\n".join(written)} if written else {}),
        }
    )


def _voids_text(volumes: list[float]) -> str:
    if not volumes:
        return "none"
    text = f"{len(volumes):,}, of {number(sum(volumes))} Å³"
    return text if len(volumes) == 1 else f"{text} in all, the largest {number(volumes[0])} Å³"


def _write(molecule: Molecule, found: UnionOfBalls, path: Path) -> None:
    """Write one line for each atom."""
    x, y, z = molecule.points.T
    columns: dict[str, NDArray[Any]] = {
        "row": np.arange(len(molecule)),
        "chain": molecule.chains,
        "residue": molecule.residues,
        "residue_id": molecule.residue_ids,
        "insertion_code": molecule.insertion_codes,
        "name": molecule.names,
        "element": molecule.elements,
        "x": x,
        "y": y,
        "z": z,
        "radius": molecule.radii,
        "volume": found.ball_volumes,
        "surface_area": found.ball_surface_areas,
    }
    write_table(path, columns)


def element_colors(molecule: Molecule) -> list[str]:
    """Return the usual color of each atom."""
    return [_COLORS.get(symbol, _OTHER) for symbol in molecule.elements.tolist()]


def _draw(molecule: Molecule, found: UnionOfBalls, path: Path) -> None:
    from alphamesh.plot import plot_balls

    save_figure(plot_balls(found, colors=element_colors(molecule)).figure, path)
