"""Alpha complexes of periodic boxes: a box that stands for all of space, filled with copies."""

from alphamesh.periodic._box import BoxCloud, as_periods, box_cloud, wrapped_points
from alphamesh.periodic._cycles import PeriodicRings, PeriodicShells
from alphamesh.periodic._filtration import PeriodicFiltration
from alphamesh.periodic._making import periodic_filtration
from alphamesh.periodic._persistence import PeriodicPersistence, periodic_persistence
from alphamesh.periodic._radius import PERIODIC_RULES, choose_periodic_radius
from alphamesh.periodic._shape import PeriodicShape
from alphamesh.periodic._tiling import tiled_points
from alphamesh.periodic._union import (
    BallChannels,
    DiscChannels,
    PeriodicUnionOfBalls,
    PeriodicUnionOfDiscs,
    periodic_union,
)

__all__ = [
    "PERIODIC_RULES",
    "BallChannels",
    "BoxCloud",
    "DiscChannels",
    "PeriodicFiltration",
    "PeriodicPersistence",
    "PeriodicRings",
    "PeriodicShape",
    "PeriodicShells",
    "PeriodicUnionOfBalls",
    "PeriodicUnionOfDiscs",
    "as_periods",
    "box_cloud",
    "choose_periodic_radius",
    "periodic_filtration",
    "periodic_persistence",
    "periodic_union",
    "tiled_points",
    "wrapped_points",
]
