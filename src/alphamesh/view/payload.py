"""What a view is made of: all simplices in the order in which they come."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.betti import checked_radii
from alphamesh.delaunay3d import outward_triangles
from alphamesh.errors import ParameterError
from alphamesh.filtration import Filtration
from alphamesh.filtration3d import Filtration3D
from alphamesh.periodic import PeriodicFiltration
from alphamesh.view.boxes import box_arrays, box_facts
from alphamesh.view.packing import pack, rising_bits, signed_bits
from alphamesh.view.placing import BoxOrFree, Frame, Order, places_of

if TYPE_CHECKING:
    from alphamesh._arrays import IntArray
    from alphamesh.persistence import Persistence
    from alphamesh.radius import RadiusChoice

__all__ = ["first_radius", "payload"]

_TITLE = "Alpha complex"
_NAMES = ("vertex", "edge", "triangle", "tetrahedron")
_NONE = np.iinfo(np.uint32).max


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
    """
    if title is not None and not isinstance(title, str):
        raise ParameterError(f"title must be text; got {title!r}")
    filtration: BoxOrFree = persistence.filtration
    orders = [Order.of(radii) for radii in filtration.radii]
    rows = filtration.simplices[0][:, 0].take(orders[0].order)
    frame = Frame.of(filtration, rows)
    meta = {
        "title": title or _TITLE,
        "ambient": filtration.points.shape[1],
        "signed": filtration.weights is not None,
        "centre": frame.centre.tolist(),
        "scale": frame.scale,
        "extent": frame.extent.tolist(),
        "box": box_facts(filtration, frame)
        if isinstance(filtration, PeriodicFiltration)
        else None,
        "radius": first_radius(filtration, choice, radius),
        "choice": None if choice is None else _choice(choice),
    }
    arrays = {
        "positions": frame.placed(places_of(filtration).take(rows, axis=0)),
        **_arrays(persistence, orders, rows, frame),
        **_balls(filtration, frame, rows),
    }
    return pack(meta, arrays)


def _balls(
    filtration: BoxOrFree, frame: Frame, rows: IntArray
) -> dict[str, np.ndarray[Any, Any]]:
    """Return the weights of vertices, and the points that are hidden."""
    if filtration.weights is None:
        return {}
    weights = filtration.weights.take(rows) / frame.scale / frame.scale
    limit = float(np.finfo(np.float32).max)
    arrays = {"weights": np.clip(weights, -limit, limit).astype(np.float32)}
    if len(filtration.hidden):
        arrays["hidden"] = filtration.hidden.astype(np.uint32)
        places = places_of(filtration).take(filtration.hidden, axis=0)
        arrays["hidden_positions"] = frame.placed(places)
    return arrays


def _arrays(
    persistence: Persistence, orders: list[Order], rows: IntArray, frame: Frame
) -> dict[str, np.ndarray[Any, Any]]:
    """Return the simplices, each told by its facets; corners follow from edges.

    Vertices are numbered in the order in which they come. In a box corners are told, too.
    """
    filtration: BoxOrFree = persistence.filtration
    signed, boxed = filtration.weights is not None, isinstance(filtration, PeriodicFiltration)
    vertices = np.empty(len(filtration.points), dtype=np.uint32)
    vertices[rows] = np.arange(len(rows), dtype=np.uint32)
    edges = filtration.simplices[1].take(orders[1].order, axis=0)
    arrays: dict[str, np.ndarray[Any, Any]] = {"edges": vertices.take(edges).ravel()}
    facets = {2: filtration.triangle_edges}
    if not isinstance(filtration, Filtration) and len(orders) == 4:
        facets[3] = filtration.tetrahedron_triangles
    bits = signed_bits if signed else rising_bits
    for k, name in enumerate(_NAMES[: len(orders)]):
        arrays[f"{name}_values"] = bits(filtration.radii[k].take(orders[k].order))
        if k in facets:
            faces = facets[k].take(orders[k].order, axis=0)
            arrays[f"{name}_facets"] = orders[k - 1].rank.take(faces).ravel()
        if k in facets or (k == 1 and (signed or boxed)):
            arrays[f"{name}_creators"] = _creators(
                persistence.pairs[k - 1], *orders[k - 1 : k + 1]
            )
    if isinstance(filtration, Filtration3D):
        arrays["triangle_turned"] = _turned(filtration, orders[3].rank)[orders[2].order]
    if isinstance(filtration, PeriodicFiltration):
        arrays |= box_arrays(filtration, orders, frame, vertices)
    if not signed:
        del arrays["vertex_values"]  # all of them come at 0
    if not np.array_equal(rows, np.arange(len(filtration.points))):
        arrays["rows"] = rows.astype(np.uint32)
    return arrays


def _creators(pairs: IntArray, below: Order, here: Order) -> np.ndarray[Any, Any]:
    """Return which simplex began the class that each simplex ends."""
    creators = np.full(len(here.rank), _NONE, dtype=np.uint32)
    creators[here.rank.take(pairs[:, 1])] = below.rank.take(pairs[:, 0])
    return creators


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


def first_radius(
    filtration: BoxOrFree, choice: RadiusChoice | None, radius: float | None
) -> float:
    """Return the radius that is shown first: finite, whatever is given."""
    if radius is None:
        return 0.0 if choice is None else choice.radius
    signed = filtration.weights is not None
    value = float(checked_radii(radius, signed=signed).reshape(()))
    if np.isfinite(value):
        return value
    values = np.concatenate(filtration.radii)
    if len(values) == 0:
        return 0.0
    return float(values.max() if value > 0 else values.min())


def _choice(choice: RadiusChoice) -> dict[str, Any]:
    low, high = choice.interval or (choice.radius, choice.radius)
    return {
        "radius": choice.radius,
        "low": low,
        "high": high if np.isfinite(high) else None,
        "reason": choice.reason,
    }
