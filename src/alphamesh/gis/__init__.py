"""Shapes and points as tables of geopandas, and one shape for each group of points."""

from __future__ import annotations

from alphamesh.gis._frames import point_frame, shape_frame
from alphamesh.gis._groups import alpha_shapes

__all__ = ["alpha_shapes", "point_frame", "shape_frame"]
