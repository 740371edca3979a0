"""Clouds in space: the solid that is meant, and the surface that is written of it."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click
import numpy as np

from alphamesh.cli.building import Job
from alphamesh.cli.progress import Steps
from alphamesh.cli.summary import area_text, counted, volume_text
from alphamesh.cli.types import AUTO, Rule, SizeType
from alphamesh.errors import FileWriteError, LossyFormatWarning

if TYPE_CHECKING:
    from alphamesh.filtration3d import Filtration3D
    from alphamesh.radius import RadiusChoice
    from alphamesh.solid import SolidShape
    from alphamesh.surface import Surface

__all__ = [
    "Solid",
    "found_scan",
    "refuse_solid_options",
    "solid_at",
    "solid_options",
    "surface_option",
    "void_options",
]

Function = TypeVar("Function", bound=Callable[..., Any])

# Scans have strays: should the surface not close around all points, it may around so many.
_SHARES = (1.0, 0.99)
# A void of more balls than this is no gap between points.
_MANY_BALLS = 8
# Genera and shells that are told one by one.
_TOLD = 8

_FLAGS = {
    "scan": "--scan/--no-scan",
    "fill_voids": "--fill-voids",
    "min_volume": "--min-volume",
    "largest": "--largest",
    "surface": "--surface/--complex",
}
_VOID_OPTIONS = (
    click.option(
        "--scan/--no-scan",
        "scan",
        default=None,
        help="Points in space are those of a scanned surface: close it (--radius enclosed) and "
        "fill it (--fill-voids all).  [default: found out]",
    ),
    click.option(
        "--fill-voids",
        type=SizeType(),
        metavar="VOLUME",
        help="In space: fill voids of at most this volume, or all, before all else.  "
        "[default: none]",
    ),
    click.option(
        "--min-volume",
        type=SizeType(),
        metavar="VOLUME",
        help="In space: drop regions of a smaller volume.  [default: none]",
    ),
)
_OPTIONS = (
    *_VOID_OPTIONS,
    click.option(
        "--largest",
        type=click.IntRange(0),
        metavar="N",
        help="In space: keep the largest N regions.  [default: all]",
    ),
)


def solid_options(command: Function) -> Function:
    """Add the options that `solid_at` understands, besides --radius and `surface_option`."""
    for option in reversed(_OPTIONS):
        command = option(command)
    return command


def refuse_solid_options(
    options: dict[str, Any], what: str, *, but: tuple[str, ...] = ()
) -> None:
    """Raise a usage error if `options` are given that are for solids, which `what` is not."""
    for name, flag in _FLAGS.items():
        if name not in but and options.get(name) is not None:
            raise click.UsageError(
                f"{flag} is for solids in space, and has no meaning for {what}"
            )


def void_options(command: Function) -> Function:
    """Add the options that a command needs beside those of shapes in the plane."""
    for option in reversed(_VOID_OPTIONS):
        command = option(command)
    return command


surface_option = click.option(
    "--surface/--complex",
    "surface",
    default=None,
    help="Formats of surfaces (PLY, OBJ, OFF, STL) of points in space: write the closed "
    "surface of the tetrahedra alone, or their boundary and all simplices beside them.  "
    "[default: surface]",
)


@dataclass(frozen=True, slots=True)
class Solid:
    """A shape in space, and how to tell of it and write it."""

    shape: SolidShape
    is_scan: bool
    as_complex: bool

    def save(self, path: Path) -> None:
        """Write the tetrahedra, or, in a format of surfaces, the surface that is wanted.

        Raises
        ------
        FileWriteError
            If there are no tetrahedra, so that there is no surface; or as other files.
        """
        from alphamesh.io.meshes import mesh_format

        if self.as_complex or "tetra" in mesh_format(path).cells:
            self.shape.save(path)
            return
        surface = self.shape.surface()
        if len(surface.triangles) == 0:
            raise FileWriteError(
                f"{path.name}: there is no surface to write, as no tetrahedron is left at "
                f"radius {self.shape.radius:.6g}; take a larger --radius or drop less, or "
                "write what there is with --complex"
            )
        for loss in [*self._left_out(), *_unfaithful(surface, path)]:
            warnings.warn(f"{path.name}: {loss}", LossyFormatWarning, stacklevel=2)
        surface.save(path)

    def _left_out(self) -> list[str]:
        """Say which simplices are not on the surface."""
        counts = self.shape.counts
        nouns = {
            "singular_triangles": ("singular triangle", "singular triangles"),
            "isolated_edges": ("isolated edge", "isolated edges"),
            "isolated_vertices": ("isolated vertex", "isolated vertices"),
        }
        found = [counted(counts[name], *noun) for name, noun in nouns.items() if counts[name]]
        if not found:
            return []
        return [
            f"what bounds no tetrahedron is left out of the surface: {', '.join(found)}; "
            "--complex writes it, too"
        ]

    def facts(self) -> dict[str, Any]:
        """Return the summary for scripts."""
        shape, surface = self.shape, self.shape.surface()
        shells = surface.shells
        return {
            "scan": self.is_scan,
            "volume": shape.volume,
            "surface_area": shape.surface_area,
            "regions": len(shape.regions),
            "region_volumes": shape.regions.volumes,
            "voids": len(shape.voids),
            "void_volumes": shape.voids.volumes,
            "watertight": len(surface.triangles) > 0 and surface.is_manifold,
            "shells": len(shells),
            "outer_shells": int(np.count_nonzero(shells.is_outer)),
            "genera": shells.genera,
        }

    def lines(self) -> dict[str, str]:
        """Return the summary for people."""
        shape, surface = self.shape, self.shape.surface()
        lines = {
            "Volume": volume_text(shape.volume),
            "Surface area": area_text(shape.surface_area),
            "Regions": f"{len(shape.regions):,}",
            "Voids": f"{len(shape.voids):,}",
        }
        if self.is_scan:
            lines = {
                "Taken for": "the scan of a surface: closed and filled; --no-scan takes the "
                "points for those of a solid",
                **lines,
            }
        if len(surface.triangles):
            lines |= {
                "Surface": f"{counted(len(surface.triangles), 'triangle')}, {_shells(surface)}",
                "Watertight": "yes" if surface.is_manifold else "no",
                "Genus": _genera(surface),
            }
        return lines


def solid_at(job: Job, options: dict[str, Any], steps: Steps) -> tuple[RadiusChoice, Solid]:
    """Return the radius that `options` ask for, and the solid there."""
    choice, is_scan = _chosen(job, options, steps)
    fill = options["fill_voids"]
    if fill is None:
        fill = np.inf if is_scan else 0.0
    least, most = options["min_volume"] or 0.0, options["largest"]
    shape: Any = job.complex.at(choice.radius)
    if fill or least or most is not None:
        with steps.step("Filling and dropping"):
            shape = shape.filtered(
                max_void_volume=fill, min_region_volume=least, keep_largest=most
            )
    # A cloud in one plane has no surface, but a complex of triangles.
    wanted = options.get("surface")
    as_complex = wanted is False or (wanted is None and job.complex.dimension < 3)
    with steps.step("Finding the surface"):
        shape.surface()
    return choice, Solid(shape, is_scan, as_complex)


def _chosen(job: Job, options: dict[str, Any], steps: Steps) -> tuple[RadiusChoice, bool]:
    """Return the radius, and whether the cloud is taken for the scan of a surface."""
    radius, scan = options["radius"], options["scan"]
    is_free = isinstance(radius, Rule) and radius.name == AUTO
    if scan and is_free:
        radius = Rule("enclosed", {})
    elif scan is None and is_free and options["fill_voids"] is None:
        with steps.step("Looking for a surface"):
            found = found_scan(job.complex.filtration)  # type: ignore[arg-type]
        if found is not None:
            return found, True
    return job.choose(radius, steps), bool(scan)


def found_scan(filtration: Filtration3D) -> RadiusChoice | None:
    """Return the radius that closes the surface on which the points lie, if they do.

    Where the complex that closes around the points is for the most part void, it is a film
    around the thing that was scanned. Points that fill a solid leave no voids but some no
    larger than the balls, which do not count; those in a thick wall, smaller ones.
    """
    from alphamesh.radius import choose_radius
    from alphamesh.shape3d import AlphaShape3D

    if filtration.dimension < 3:
        return None
    for share in _SHARES:
        choice = choose_radius(filtration, "enclosed", share=share)
        shape = AlphaShape3D(filtration, choice.radius)
        volumes, ball = shape.voids.volumes, 4 / 3 * np.pi * choice.radius**3
        large = float(volumes[volumes > _MANY_BALLS * ball].sum())
        if large > shape.volume + float(volumes.sum()) - large:
            return choice
    return None


def _shells(surface: Surface) -> str:
    shells = surface.shells
    outer = int(np.count_nonzero(shells.is_outer))
    text = counted(len(shells), "shell")
    walls = len(shells) - outer
    return f"{text}, {walls:,} of them around voids" if walls else text


def _genera(surface: Surface) -> str:
    genera = surface.shells.genera.tolist()
    text = ", ".join(f"{genus:,}" for genus in genera[:_TOLD])
    return text + (f", ... ({sum(genera):,} in all)" if len(genera) > _TOLD else "")


def _unfaithful(surface: Surface, path: Path) -> list[str]:
    """Say where a format without common vertices does not hold the surface as it is."""
    from alphamesh.io.meshes import mesh_format
    from alphamesh.manifold import sides_of

    if mesh_format(path).double:
        return []
    # Vertices are equal to readers if their rounded coordinates are.
    _, rows = np.unique(surface.points.astype(np.float32), axis=0, return_inverse=True)
    sides = np.sort(rows.reshape(-1).take(sides_of(surface.triangles)), axis=1)
    _, counts = np.unique(sides, axis=0, return_counts=True)
    merged = int(np.count_nonzero(counts > 2))
    if merged == 0:
        return []
    return [
        "to readers of STL, which take equal vertices for one, "
        f"{counted(merged, 'edge')} of the surface would have four triangles or more: not "
        "watertight to them; PLY, OBJ and OFF keep them apart"
    ]
