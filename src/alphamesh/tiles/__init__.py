"""Clouds larger than memory or one machine: tiles whose union is exact.

A simplex of the alpha complex at radius r lies within 2 r of each of its vertices, and so
does all that decides upon it. So a tile that knows the points of a halo of this width
finds the simplices that begin in it, those of the whole cloud to the last bit.

:func:`plan`, :func:`solve`, :func:`merge` and :func:`finish` are plain functions of
arrays; :func:`run` calls them for files, here or on the workers of a Dask cluster.
"""

from alphamesh.tiles.box_pieces import solve_in_box
from alphamesh.tiles.boxes import plan_in_box, spread_in_box
from alphamesh.tiles.choose import SampledRadius, choose_radius
from alphamesh.tiles.complex import TiledComplex
from alphamesh.tiles.dataset import Chunk, Dataset, dataset
from alphamesh.tiles.merge import Part, Summary, finish, merge, outline, part_of
from alphamesh.tiles.pieces import Boundary, Piece, solve
from alphamesh.tiles.run import run
from alphamesh.tiles.status import Status, status
from alphamesh.tiles.tiling import Tiling, plan
from alphamesh.tiles.weighing import WeightRange

__all__ = [
    "Boundary",
    "Chunk",
    "Dataset",
    "Part",
    "Piece",
    "SampledRadius",
    "Status",
    "Summary",
    "TiledComplex",
    "Tiling",
    "WeightRange",
    "choose_radius",
    "dataset",
    "finish",
    "merge",
    "outline",
    "part_of",
    "plan",
    "plan_in_box",
    "run",
    "solve",
    "solve_in_box",
    "spread_in_box",
    "status",
]
