"""Regions and voids of a set of tetrahedra: which there are, and how large."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh._kernels.space import parts3
from alphamesh.measures import tetrahedron_volumes
from alphamesh.parts import (
    Parts,
    centroids,
    labelled,
    ranked_parts,
    ranks,
    require_size,
    totals,
)

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, CountArray, FloatArray, IntArray
    from alphamesh.filtration3d import Filtration3D

__all__ = ["Regions3D", "Voids", "find_parts", "find_regions", "find_voids", "without_voids"]


@dataclass(frozen=True, eq=False, repr=False)
class Regions3D(Record):
    """The regions of a shape in space: sets of tetrahedra connected by triangles.

    Regions that touch at an edge or a point are two. The largest comes first; equally
    large ones come in the order of their first tetrahedra.

    Attributes
    ----------
    labels : (k,) int32
        The region of each of the tetrahedra of the shape.
    vertex_labels : (n,) int32
        The region that each point is a corner of, the lowest if there are several; -1
        if none. Duplicates have the one of their representative.
    volumes : (r,) float64
        In cubed units of the points.
    surface_areas : (r,) float64
        Area of the boundary, around the region and its voids.
    centroids : (r, 3) float64
        Centres of volume.
    tetrahedron_counts : (r,) int64

    All arrays are read-only.
    """

    labels: IntArray
    vertex_labels: IntArray
    volumes: FloatArray
    surface_areas: FloatArray
    centroids: FloatArray
    tetrahedron_counts: CountArray

    def __len__(self) -> int:
        return len(self.volumes)

    def __repr__(self) -> str:
        return f"<Regions3D: {len(self):,}, with {len(self.labels):,} tetrahedra>"


@dataclass(frozen=True, eq=False, repr=False)
class Voids(Record):
    """The voids of a shape: bounded parts of space without it, the largest first.

    A void is a set of tetrahedra that are not in the shape, connected by triangles that
    are not in it either. So singular triangles can close a void, and there are as many
    as the second Betti number of the complex tells.

    Attributes
    ----------
    labels : (T,) int32
        The void that each tetrahedron of the filtration lies in; -1 if none.
    volumes : (v,) float64
        In cubed units of the points.
    surface_areas : (v,) float64
        Area of the triangles that part the void from the shape, from other voids and from
        the outside; without those that have it on either side.
    tetrahedron_counts : (v,) int64

    All arrays are read-only.
    """

    labels: IntArray
    volumes: FloatArray
    surface_areas: FloatArray
    tetrahedron_counts: CountArray

    def __len__(self) -> int:
        return len(self.volumes)

    def __repr__(self) -> str:
        return f"<Voids: {len(self):,}>"


def find_parts(filtration: Filtration3D, has_tetrahedron: BoolArray, wall: BoolArray) -> Parts:
    """Divide the tetrahedra of a filtration into regions, voids and the outside.

    Parameters
    ----------
    filtration : Filtration3D
    has_tetrahedron : (T,) bool
        Which tetrahedra the shape has.
    wall : (F,) bool
        Which triangles it has.
    """
    found = parts3(filtration.triangle_tetrahedra, has_tetrahedron, wall)
    return ranked_parts(filtration, found)


def find_regions(filtration: Filtration3D, parts: Parts) -> Regions3D:
    """Measure the regions of a set of tetrahedra."""
    inside = parts.labels >= 0
    labels = read_only(parts.labels.compress(inside))
    tetrahedra = filtration.simplices[3].compress(inside, axis=0)
    sizes = filtration.tetrahedron_volumes.compress(inside)
    volumes = parts.region_sizes
    return Regions3D(
        labels,
        _vertex_labels(filtration, tetrahedra, labels),
        volumes,
        _surface_areas(filtration, parts.labels, len(volumes)),
        centroids(filtration.points, tetrahedra, labels, sizes, tetrahedron_volumes),
        read_only(np.bincount(labels, minlength=len(volumes))),
    )


def _vertex_labels(
    filtration: Filtration3D, tetrahedra: IntArray, labels: IntArray
) -> IntArray:
    """Return the lowest label at each row of points, -1 where there is none."""
    none = np.iinfo(np.int32).max
    lowest = np.full(len(filtration.points), none, dtype=np.int32)
    for corner in range(4):
        np.minimum.at(lowest, tetrahedra[:, corner], labels)
    lowest[lowest == none] = -1
    return read_only(lowest.take(filtration.representative))


def _surface_areas(filtration: Filtration3D, labels: IntArray, count: int) -> FloatArray:
    """Return the area of the triangles with a tetrahedron of each label on one side alone."""
    # Row -1, no tetrahedron, reads the last entry: no label.
    sides = np.append(labels, np.int32(-1)).take(filtration.triangle_tetrahedra, mode="wrap")
    areas = np.zeros(count)
    for side in (0, 1):
        bounding = (sides[:, 0] != sides[:, 1]) & (sides[:, side] >= 0)
        found = filtration.triangle_areas.compress(bounding)
        areas += totals(sides[:, side].compress(bounding), found, count)
    return read_only(areas)


def find_voids(filtration: Filtration3D, parts: Parts) -> Voids:
    """Measure the voids of a set of tetrahedra."""
    places = ranks(parts.enclosed_sizes)
    labels = np.append(places, np.int32(-1)).take(parts.enclosed, mode="wrap")
    volumes = np.empty(len(places))
    volumes[places] = parts.enclosed_sizes
    counts = np.bincount(labels.compress(labels >= 0), minlength=len(places))
    return Voids(
        read_only(labels),
        read_only(volumes),
        _surface_areas(filtration, labels, len(places)),
        read_only(counts),
    )


def without_voids(
    filtration: Filtration3D,
    has_tetrahedron: BoolArray,
    wall: BoolArray,
    parts: Parts,
    max_volume: float,
) -> Parts:
    """Return the parts of space once voids of at most `max_volume` are filled.

    Parameters
    ----------
    filtration : Filtration3D
    has_tetrahedron : (T,) bool
    wall : (F,) bool
    parts : Parts
        Those of `has_tetrahedron` and `wall`.
    max_volume : float

    Raises
    ------
    ParameterError
        If `max_volume` is negative or NaN.
    """
    require_size("max_void_volume", max_volume)
    small = parts.enclosed_sizes <= max_volume
    if max_volume == 0 or not small.any():
        return parts
    filled = has_tetrahedron | labelled(parts.enclosed, small)
    return find_parts(filtration, filled, wall)
