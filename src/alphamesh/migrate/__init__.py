"""The interfaces of other libraries, made of exact alpha complexes.

Each name takes what its model takes and returns what that returns, so that changing an
import is enough to begin with. Where the results differ, the docstring says how. The page
``docs/migration.md`` shows what to write in alphamesh itself instead.
"""

from __future__ import annotations

from alphamesh.migrate._alphashape import alphashape, optimizealpha
from alphamesh.migrate._libpysal import alpha_shape, alpha_shape_auto
from alphamesh.migrate._matlab import alphaShape
from alphamesh.migrate._open3d import create_from_point_cloud_alpha_shape
from alphamesh.migrate._scipy import Delaunay

__all__ = [
    "Delaunay",
    "alphaShape",
    "alpha_shape",
    "alpha_shape_auto",
    "alphashape",
    "create_from_point_cloud_alpha_shape",
    "optimizealpha",
]
