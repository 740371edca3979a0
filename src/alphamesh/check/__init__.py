"""Validators: each stage's invariants, checked exactly, failures named with their rows.

They prove a result rather than compare it with another program's: triangles that are not
flat, whose inner edges are all locally Delaunay and whose border is one convex ring *are*
the Delaunay triangulation [1]_; so are tetrahedra in space. Ties count too, so that one
result alone passes for each cloud. A million points take a few seconds, in space a minute.

References
----------
.. [1] B. Delaunay, Sur la sphère vide, Bulletin de l'Académie des Sciences de l'URSS,
   Classe des sciences mathématiques et naturelles 6 (1934) 793-800.
"""

from alphamesh.check._delaunay import check_delaunay
from alphamesh.check._filtration import RADIUS_ERROR, check_filtration
from alphamesh.check._periodic import check_periodic
from alphamesh.check._shape import check_shape
from alphamesh.check._space_filtration import RADIUS_ERROR_IN_SPACE
from alphamesh.check._surface import check_surface
from alphamesh.check._weighted import RADIUS_ERROR_WITH_WEIGHTS

__all__ = [
    "RADIUS_ERROR",
    "RADIUS_ERROR_IN_SPACE",
    "RADIUS_ERROR_WITH_WEIGHTS",
    "check_delaunay",
    "check_filtration",
    "check_periodic",
    "check_shape",
    "check_surface",
]
