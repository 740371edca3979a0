"""Exact, fast alpha complexes: from a cloud of points to a mesh that keeps its holes.

>>> import alphamesh as am
>>> points = am.demo_cloud("eight", 2000, seed=1)
>>> shape = am.AlphaComplex(points).at()
>>> shape.save("mesh.vtu")                                              # doctest: +SKIP

Names are imported when they are first used.
"""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from alphamesh import check, errors, migrate, plot
    from alphamesh._kernels import trim_memory
    from alphamesh.classify import SimplexKind
    from alphamesh.complex import AlphaComplex
    from alphamesh.complex3d import AlphaComplex3D
    from alphamesh.curves import MeasureCurves, measure_curves
    from alphamesh.curves3d import MeasureCurves3D
    from alphamesh.delaunay import Delaunay, delaunay
    from alphamesh.delaunay3d import Delaunay3D
    from alphamesh.film import Film, animate
    from alphamesh.filtration import Filtration, filtration
    from alphamesh.filtration3d import Filtration3D
    from alphamesh.frame import FRAME_SHAPES, Frame, FramedDelaunay, framed_delaunay
    from alphamesh.gis import alpha_shapes
    from alphamesh.hull import ConvexHull, convex_hull
    from alphamesh.hull3d import ConvexHull3D
    from alphamesh.io.geo import GEO_FORMATS, read_geo, write_geo
    from alphamesh.io.images import sample_mask
    from alphamesh.io.meshes import MESH_FORMATS, Mesh, write_mesh
    from alphamesh.io.molecules import read_molecule
    from alphamesh.io.points import read_points, read_table
    from alphamesh.molecule import Molecule
    from alphamesh.outline import Rings
    from alphamesh.periodic import (
        PeriodicFiltration,
        PeriodicPersistence,
        PeriodicShape,
        PeriodicUnionOfBalls,
        PeriodicUnionOfDiscs,
    )
    from alphamesh.periodic_complex import PeriodicComplex
    from alphamesh.persistence import Persistence, persistence
    from alphamesh.planar import Selection
    from alphamesh.queries import Nearest
    from alphamesh.queries3d import Nearest3D
    from alphamesh.radius import RadiusChoice, choose_radius
    from alphamesh.regions import Holes, Regions
    from alphamesh.regions3d import Regions3D, Voids
    from alphamesh.restricted import RestrictedVoronoi, restricted_voronoi
    from alphamesh.sampling import (
        DEMO_SHAPES,
        DEMO_SOLIDS,
        demo_cloud,
        demo_mask,
        sample_solid,
    )
    from alphamesh.shape import AlphaShape
    from alphamesh.shape3d import AlphaShape3D
    from alphamesh.shells import Shells
    from alphamesh.solid import Selection3D
    from alphamesh.surface import Surface, boundary_surface
    from alphamesh.table import PointTable
    from alphamesh.unions import (
        UnionHoles,
        UnionOfBalls,
        UnionOfDiscs,
        UnionVoids,
        union_of_balls,
    )
    from alphamesh.voronoi import ClippedVoronoi, Voronoi, voronoi

    __version__: str

__all__ = [
    "DEMO_SHAPES",
    "DEMO_SOLIDS",
    "FRAME_SHAPES",
    "GEO_FORMATS",
    "MESH_FORMATS",
    "AlphaComplex",
    "AlphaComplex3D",
    "AlphaShape",
    "AlphaShape3D",
    "ClippedVoronoi",
    "ConvexHull",
    "ConvexHull3D",
    "Delaunay",
    "Delaunay3D",
    "Film",
    "Filtration",
    "Filtration3D",
    "Frame",
    "FramedDelaunay",
    "Holes",
    "MeasureCurves",
    "MeasureCurves3D",
    "Mesh",
    "Molecule",
    "Nearest",
    "Nearest3D",
    "PeriodicComplex",
    "PeriodicFiltration",
    "PeriodicPersistence",
    "PeriodicShape",
    "PeriodicUnionOfBalls",
    "PeriodicUnionOfDiscs",
    "Persistence",
    "PointTable",
    "RadiusChoice",
    "Regions",
    "Regions3D",
    "RestrictedVoronoi",
    "Rings",
    "Selection",
    "Selection3D",
    "Shells",
    "SimplexKind",
    "Surface",
    "UnionHoles",
    "UnionOfBalls",
    "UnionOfDiscs",
    "UnionVoids",
    "Voids",
    "Voronoi",
    "__version__",
    "alpha_shapes",
    "animate",
    "boundary_surface",
    "check",
    "choose_radius",
    "convex_hull",
    "delaunay",
    "demo_cloud",
    "demo_mask",
    "errors",
    "filtration",
    "framed_delaunay",
    "measure_curves",
    "migrate",
    "persistence",
    "plot",
    "read_geo",
    "read_molecule",
    "read_points",
    "read_table",
    "restricted_voronoi",
    "sample_mask",
    "sample_solid",
    "trim_memory",
    "union_of_balls",
    "voronoi",
    "write_geo",
    "write_mesh",
]

_MODULES = ("check", "errors", "migrate", "plot")
_HOMES = {
    "_kernels": ("trim_memory",),
    "classify": ("SimplexKind",),
    "complex": ("AlphaComplex",),
    "complex3d": ("AlphaComplex3D",),
    "curves": ("MeasureCurves", "measure_curves"),
    "curves3d": ("MeasureCurves3D",),
    "delaunay": ("Delaunay", "delaunay"),
    "delaunay3d": ("Delaunay3D",),
    "film": ("Film", "animate"),
    "filtration": ("Filtration", "filtration"),
    "filtration3d": ("Filtration3D",),
    "frame": ("FRAME_SHAPES", "Frame", "FramedDelaunay", "framed_delaunay"),
    "gis": ("alpha_shapes",),
    "hull": ("ConvexHull", "convex_hull"),
    "hull3d": ("ConvexHull3D",),
    "io.geo": ("GEO_FORMATS", "read_geo", "write_geo"),
    "io.images": ("sample_mask",),
    "io.meshes": ("MESH_FORMATS", "Mesh", "write_mesh"),
    "io.molecules": ("read_molecule",),
    "io.points": ("read_points", "read_table"),
    "molecule": ("Molecule",),
    "outline": ("Rings",),
    "periodic": (
        "PeriodicFiltration",
        "PeriodicPersistence",
        "PeriodicShape",
        "PeriodicUnionOfBalls",
        "PeriodicUnionOfDiscs",
    ),
    "periodic_complex": ("PeriodicComplex",),
    "persistence": ("Persistence", "persistence"),
    "planar": ("Selection",),
    "queries": ("Nearest",),
    "queries3d": ("Nearest3D",),
    "radius": ("RadiusChoice", "choose_radius"),
    "regions": ("Holes", "Regions"),
    "regions3d": ("Regions3D", "Voids"),
    "restricted": ("RestrictedVoronoi", "restricted_voronoi"),
    "sampling": ("DEMO_SHAPES", "DEMO_SOLIDS", "demo_cloud", "demo_mask", "sample_solid"),
    "shape": ("AlphaShape",),
    "shape3d": ("AlphaShape3D",),
    "solid": ("Selection3D",),
    "shells": ("Shells",),
    "surface": ("Surface", "boundary_surface"),
    "table": ("PointTable",),
    "unions": ("UnionHoles", "UnionOfBalls", "UnionOfDiscs", "UnionVoids", "union_of_balls"),
    "voronoi": ("ClippedVoronoi", "Voronoi", "voronoi"),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}


def _version() -> str:
    from importlib.metadata import PackageNotFoundError, version

    try:
        return version(__name__)
    except PackageNotFoundError:  # imported from a source tree
        return "0+unknown"


if not TYPE_CHECKING:  # or a type checker would take any name for granted

    def __getattr__(name: str) -> Any:
        if name in _MODULES:
            return import_module(f"{__name__}.{name}")
        if name in _HOME_OF:
            value = getattr(import_module(f"{__name__}.{_HOME_OF[name]}"), name)
        elif name == "__version__":
            value = _version()
        else:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        globals()[name] = value
        return value


def __dir__() -> list[str]:
    return __all__


class _Package(ModuleType):
    """A package in which a stage's function is not hidden by the module of its name."""

    def __setattr__(self, name: str, value: Any) -> None:
        # Python binds each module that it loads, alphamesh.delaunay too, in the package.
        if isinstance(value, ModuleType) and _HOME_OF.get(name) == name:
            value = getattr(value, name)
        super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package
