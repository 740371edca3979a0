"""The alpha complex at one radius: what is in it, where, and how large it is."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from alphamesh._arrays import read_only
from alphamesh.classify import checked_radius, chosen, reached
from alphamesh.planar import PlanarShape

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, IntArray, KindArray

__all__ = ["AlphaShape"]


@dataclass(frozen=True, eq=False, repr=False)
class AlphaShape(PlanarShape):
    """The alpha complex of a cloud at one radius: all simplices of value <= radius.

    Making one costs nothing; each property is computed when it is first asked for, in a
    few passes over arrays, and kept. Simplices are rows of `points`, in the order of the
    filtration. Arrays are read-only.

    Parameters
    ----------
    filtration : Filtration
    radius : float
        In the units of the points, not negative unless these have weights.
        ``numpy.inf`` gives the whole triangulation.

    Raises
    ------
    ParameterError
        If `radius` is not a number, or NaN, or negative without weights.

    Notes
    -----
    A simplex of the complex is *singular* if it belongs to none of its triangles,
    *regular* if it lies on the boundary of the triangles, else *interior*. The
    *regularized* shape is made of the triangles alone.
    """

    def __post_init__(self) -> None:
        signed = self.filtration.weights is not None
        object.__setattr__(self, "radius", checked_radius(self.radius, signed=signed))

    @cached_property
    def _vertex_kinds(self) -> KindArray:
        return self.filtration.vertex_intervals.kinds_at(self.radius)

    @cached_property
    def _edge_kinds(self) -> KindArray:
        return self.filtration.edge_intervals.kinds_at(self.radius)

    @cached_property
    def _has_triangle(self) -> BoolArray:
        return read_only(self.filtration.radii[2] <= self.radius)

    @cached_property
    def edges(self) -> IntArray:
        """All edges of the complex, ``(k, 2)`` int32, each ascending."""
        return chosen(self.filtration.simplices[1], self.filtration.radii[1] <= self.radius)

    @cached_property
    def isolated_vertices(self) -> IntArray:
        """Vertices without any edge, ``(k,)`` int32."""
        alone = reached(self.filtration.radii[0], self.radius)
        alone &= ~reached(self.filtration.joined_from, self.radius)
        return chosen(self._vertices, alone)

    def _repr_html_(self) -> str:
        """Return what notebooks show: a small picture and the facts."""
        from alphamesh.view.card import shape_card

        return shape_card(self)

    def __repr__(self) -> str:
        counts = self.counts
        kinds = ["triangles"] + [
            k for k in ("singular_edges", "isolated_vertices") if counts[k]
        ]
        facts = [f"{counts[kind]:,} {kind.replace('_', ' ')}" for kind in kinds]
        return f"<AlphaShape at radius {self.radius:.6g}: {', '.join(facts)}>"
