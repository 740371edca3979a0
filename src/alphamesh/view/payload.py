"""What a view is made of: all simplices in the order in which they come."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._weights import refuse_weights
from alphamesh.betti import checked_radii
from alphamesh.delaunay3d import outward_triangles
from alphamesh.errors import ParameterError
from alphamesh.filtration3d import Filtration3D
from alphamesh.view.packing import pack, rising_bits

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray, IntArray
    from alphamesh.filtration import AnyFiltration
    from alphamesh.persistence import Persistence
    from alphamesh.radius import RadiusChoice

__all__ = ["first_radius", "payload"]

_TITLE = "Alpha complex"
_NAMES = ("vertex", "edge", "triangle", "tetrahedron")
_NONE = np.iinfo(np.uint32).max


@dataclass(frozen=True, slots=True)
class _Order:
    """Simplices by filtration value: which comes when, and when comes which."""

    order: np.ndarray[Any, np.dtype[np.intp]]
    rank: np.ndarray[Any, np.dtype[np.uint32]]

    @classmethod
    def of(cls, radii: FloatArray) -> _Order:
        order = np.argsort(radii, kind="stable")
        rank = np.empty(len(order), dtype=np.uint32)
        rank[order] = np.arange(len(order), dtype=np.uint32)
        return cls(order, rank)


def payload(
    persistence: Persistence,
    choice: RadiusChoice | None,
    *,
    radius: float | None = None,
    title: str | None = None,
) -> bytes:
    """Return all that the page and the widget show, in a few bytes for each simplex.

    Parameters
    ----------
    persistence : Persistence
        Of the filtration to show.
    choice : RadiusChoice or None
        The radius that is marked; None if there is none to choose.
    radius : float, optional
        The radius that is shown first; by default the chosen one.
    title : str, optional

    Raises
    ------
    ParameterError
        If `radius` or `title` is not what it must be.
    UnweightedOnlyError
        If the points have weights.
    """
    if title is not None and not isinstance(title, str):
        raise ParameterError(f"title must be text; got {title!r}")
    filtration = persistence.filtration
    refuse_weights(
        filtration.weights, "interactive views", "draw pictures with cx.at(radius).plot()"
    )
    positions, placing = _positions(filtration)
    meta = {
        "title": title or _TITLE,
        "ambient": filtration.points.shape[1],
        **placing,
        "radius": first_radius(filtration, choice, radius),
        "choice": None if choice is None else _choice(choice),
    }
    return pack(meta, {"positions": positions, **_arrays(persistence)})


def _positions(filtration: AnyFiltration) -> tuple[np.ndarray[Any, Any], dict[str, Any]]:
    """Return the distinct points, moved and scaled into a square, or a cube, from -1 to 1."""
    points = filtration.points.take(filtration.simplices[0][:, 0], axis=0)
    if len(points) == 0:
        low = high = np.zeros(points.shape[1])
    else:
        low, high = points.min(axis=0), points.max(axis=0)
    centre, half = low / 2 + high / 2, high / 2 - low / 2
    scale = float(half.max()) or 1.0
    placed = ((points - centre) / scale).astype(np.float32)
    extent = (half / scale).tolist()
    return placed.ravel(), {"centre": centre.tolist(), "scale": scale, "extent": extent}


def _arrays(persistence: Persistence) -> dict[str, np.ndarray[Any, Any]]:
    """Return the simplices, each told by its facets; corners follow from edges."""
    filtration = persistence.filtration
    rows = filtration.simplices[0]
    orders = [_Order.of(radii) for radii in filtration.radii]
    edges = filtration.simplices[1].take(orders[1].order, axis=0)
    arrays: dict[str, np.ndarray[Any, Any]] = {"edges": _numbered(edges, rows[:, 0]).ravel()}
    facets = {2: filtration.triangle_edges}
    if isinstance(filtration, Filtration3D):
        facets[3] = filtration.tetrahedron_triangles
    for k, name in enumerate(_NAMES[: len(orders)]):
        arrays[f"{name}_values"] = rising_bits(filtration.radii[k].take(orders[k].order))
        if k in facets:
            faces = facets[k].take(orders[k].order, axis=0)
            arrays[f"{name}_facets"] = orders[k - 1].rank.take(faces).ravel()
            creators = np.full(len(faces), _NONE, dtype=np.uint32)
            pairs = persistence.pairs[k - 1]
            ends = orders[k].rank.take(pairs[:, 1])
            creators[ends] = orders[k - 1].rank.take(pairs[:, 0])
            arrays[f"{name}_creators"] = creators
    if isinstance(filtration, Filtration3D):
        arrays["triangle_turned"] = _turned(filtration, orders[3].rank)[orders[2].order]
    del arrays["vertex_values"]  # all of them come at 0
    if len(rows) < len(filtration.points):
        arrays["rows"] = rows[:, 0].astype(np.uint32)
    return arrays


def _turned(
    filtration: Filtration3D, rank: np.ndarray[Any, Any]
) -> np.ndarray[Any, np.dtype[np.uint8]]:
    """Return which triangles run clockwise seen from outside their first tetrahedron."""
    triangles, tetrahedra = filtration.simplices[2:]
    turned = np.zeros(len(triangles), dtype=np.uint8)
    some = np.flatnonzero(filtration.triangle_tetrahedra.max(axis=1, initial=-1) >= 0)
    one, two = filtration.triangle_tetrahedra.take(some, axis=0).T
    ranks = np.append(rank.astype(np.int64), len(rank))  # row -1, none, reads the last entry
    inner = np.where(ranks.take(one) < ranks.take(two), one, two)
    faces = triangles.take(some, axis=0)
    apexes = tetrahedra.take(inner, axis=0).sum(axis=1) - faces.sum(axis=1)
    outward = outward_triangles(filtration.points, faces, apexes.astype(np.int32))
    turned[some] = (outward != faces).any(axis=1)
    return turned


def _numbered(simplices: IntArray, rows: IntArray) -> np.ndarray[Any, np.dtype[np.uint32]]:
    """Return rows of points as numbers of distinct points."""
    if len(rows) and int(rows[-1]) == len(rows) - 1:
        return simplices.astype(np.uint32)
    return np.searchsorted(rows, simplices).astype(np.uint32)


def first_radius(
    filtration: AnyFiltration, choice: RadiusChoice | None, radius: float | None
) -> float:
    """Return the radius that is shown first: finite, whatever is given."""
    if radius is None:
        return 0.0 if choice is None else choice.radius
    value = float(checked_radii(radius).reshape(()))
    greatest = max((float(radii.max(initial=0.0)) for radii in filtration.radii), default=0.0)
    return value if np.isfinite(value) else greatest


def _choice(choice: RadiusChoice) -> dict[str, Any]:
    low, high = choice.interval or (choice.radius, choice.radius)
    return {
        "radius": choice.radius,
        "low": low,
        "high": high if np.isfinite(high) else None,
        "reason": choice.reason,
    }
