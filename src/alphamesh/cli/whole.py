"""Hull and triangulation of points in space: what the whole cloud gives, without a radius."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.cli.building import Job, save_figure
from alphamesh.cli.solids import Solid
from alphamesh.cli.summary import area_text, volume_text
from alphamesh.cli.tables import write_table
from alphamesh.errors import FileWriteError

if TYPE_CHECKING:
    from alphamesh.hull3d import ConvexHull3D
    from alphamesh.surface import Surface

__all__ = ["SpatialDelaunay", "SpatialHull"]

_TABLES = (".csv", ".tsv", ".npz", ".parquet")


class SpatialHull:
    """The convex hull of points in space, and how to tell of it, write it and draw it."""

    def __init__(self, job: Job) -> None:
        self._complex: Any = job.complex

    @property
    def _hull(self) -> ConvexHull3D:
        hull: ConvexHull3D = self._complex.convex_hull
        return hull

    @cached_property
    def _surface(self) -> Surface:
        surface: Surface = self._complex.at(np.inf).surface()
        return surface

    def save(self, path: Path) -> None:
        """Write its corners into a table, or its triangles into a mesh."""
        if path.suffix.lower() in _TABLES:
            rows = self._hull.vertices
            x, y, z = self._hull.points[rows].T
            write_table(path, {"row": rows, "x": x, "y": y, "z": z})
            return
        if len(self._hull.triangles) == 0:
            raise FileWriteError(
                f"{path.name}: the hull has no triangles, as all points lie in one plane; "
                "leave a coordinate out with --columns x,y for the hull in the plane"
            )
        self._surface.save(path)

    def draw(self, path: Path) -> None:
        """Draw it, lit."""
        from alphamesh.plot import plot_surface

        save_figure(plot_surface(self._surface).figure, path)

    def told(self) -> tuple[dict[str, Any], dict[str, str]]:
        """Return the summary for scripts and that for people."""
        hull = self._hull
        corners, triangles = len(hull.vertices), len(hull.triangles)
        facts = {
            "corners": corners,
            "triangles": triangles,
            "volume": hull.volume,
            "area": hull.area,
        }
        lines = {
            "Corners": f"{corners:,}",
            "Triangles": f"{triangles:,}",
            "Volume": volume_text(hull.volume),
            "Area": area_text(hull.area),
        }
        return facts, lines


class SpatialDelaunay:
    """The triangulation of points in space, and how to tell of it, write it and draw it."""

    def __init__(self, job: Job) -> None:
        self._complex: Any = job.complex

    def save(self, path: Path) -> None:
        """Write the tetrahedra, or, in formats of surfaces, their boundary."""
        Solid(self._complex.at(np.inf), is_scan=False, as_complex=True).save(path)

    def draw(self, path: Path) -> None:
        """Draw it cut open."""
        save_figure(self._complex.at(np.inf).plot(cut="-y").figure, path)

    def told(self) -> tuple[dict[str, Any], dict[str, str]]:
        """Return the summary for scripts and that for people."""
        made = self._complex.delaunay
        boundary = len(made.convex_hull.triangles)
        volume = made.convex_hull.volume
        facts = {
            "tetrahedra": len(made.tetrahedra),
            "triangles": len(made.triangles),
            "edges": len(made.edges),
            "boundary_triangles": boundary,
            "volume": volume,
        }
        lines = {
            "Tetrahedra": f"{len(made.tetrahedra):,}",
            "Triangles": f"{len(made.triangles):,}, {boundary:,} of them on the boundary",
            "Edges": f"{len(made.edges):,}",
            "Volume": volume_text(volume),
        }
        return facts, lines
