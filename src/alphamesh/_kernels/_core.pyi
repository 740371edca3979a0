"""Types of the compiled core (cpp/bindings.cpp)."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

class BadCoordinates(Exception): ...  # noqa: N818
class TooManyPoints(Exception): ...  # noqa: N818

def alpha2(
    points: NDArray[np.float64],
    threads: int,
    progress: Callable[[float], object] | None,
) -> tuple[
    NDArray[np.int32] | None,
    NDArray[np.int32],
    NDArray[np.float64],
    NDArray[np.int32],
    NDArray[np.float64],
    NDArray[np.int32],
]: ...
def delaunay2(
    points: NDArray[np.float64],
    threads: int,
    progress: Callable[[float], object] | None,
) -> tuple[
    NDArray[np.int32] | None,
    NDArray[np.int32],
    NDArray[np.int32],
    NDArray[np.int32],
]: ...
def regular2(
    points: NDArray[np.float64],
    weights: NDArray[np.float64],
    threads: int,
    progress: Callable[[float], object] | None,
) -> tuple[
    int,
    NDArray[np.int32] | None,
    NDArray[np.int32],
    NDArray[np.int32],
    NDArray[np.float64],
    NDArray[np.int32],
    NDArray[np.float64],
    NDArray[np.int32],
    NDArray[np.int32],
    NDArray[np.float64],
]: ...
def regular3(
    points: NDArray[np.float64],
    weights: NDArray[np.float64],
    threads: int,
    progress: Callable[[float], object] | None,
) -> tuple[
    int,
    NDArray[np.int32] | None,
    NDArray[np.int32],
    NDArray[np.int32],
    NDArray[np.float64],
    NDArray[np.int32],
    NDArray[np.float64],
    NDArray[np.int32],
    NDArray[np.int32],
    NDArray[np.float64],
    NDArray[np.int32],
    NDArray[np.float64],
]: ...
def persistence2(
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    triangle_radii: NDArray[np.float64],
    edges: NDArray[np.int32],
    edge_radii: NDArray[np.float64],
    edge_triangles: NDArray[np.int32],
    births: NDArray[np.float64],
    threads: int,
    progress: Callable[[float], object] | None,
) -> tuple[NDArray[np.int32], NDArray[np.int32]]: ...
def persistence3(
    n: int,
    edges: NDArray[np.int32],
    edge_radii: NDArray[np.float64],
    triangle_edges: NDArray[np.int32],
    triangle_radii: NDArray[np.float64],
    triangle_tetrahedra: NDArray[np.int32],
    tetrahedron_radii: NDArray[np.float64],
    births: NDArray[np.float64],
    threads: int,
    progress: Callable[[float], object] | None,
) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.int32]]: ...
def periodic_star(
    high: NDArray[np.float64],
    low: NDArray[np.float64],
    weights: NDArray[np.float64],
    unit: float,
    base: int,
    progress: Callable[[float], object] | None,
) -> tuple[int, NDArray[np.int32], NDArray[np.float64], NDArray[np.float64], bool]: ...
def periodic_complex(
    rows: NDArray[np.int32],
    offsets: NDArray[np.int8],
    base: int,
    cells: NDArray[np.int32],
    anchors: NDArray[np.float64],
    shifts: NDArray[np.int8],
    weights: NDArray[np.float64] | None,
    periods: NDArray[np.float64],
    exponent: int,
    threads: int,
) -> tuple[
    list[
        tuple[
            NDArray[np.int32],
            NDArray[np.int8],
            NDArray[np.int32],
            NDArray[np.float64],
        ]
    ],
    NDArray[np.int32],
]: ...
def periodic_check(
    cells: NDArray[np.int32],
    offsets: NDArray[np.int8],
    faces: NDArray[np.int32],
    facet_cells: NDArray[np.int32],
    anchors: NDArray[np.float64],
    shifts: NDArray[np.int8],
    weights: NDArray[np.float64] | None,
    periods: NDArray[np.float64],
    threads: int,
) -> NDArray[np.int8]: ...
def periodic_parts(
    second: NDArray[np.int8],
    faces: NDArray[np.int32],
    facet_cells: NDArray[np.int32],
    inside: NDArray[np.bool_],
    wall: NDArray[np.bool_],
) -> tuple[NDArray[np.int32], NDArray[np.int8]]: ...
def component_count(n: int, pairs: NDArray[np.int32]) -> int: ...
def triangle_edges2(
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    edges: NDArray[np.int32],
    edge_triangles: NDArray[np.int32],
    threads: int,
) -> NDArray[np.int32]: ...
def rings2(
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    edges: NDArray[np.int32],
    edge_triangles: NDArray[np.int32],
    threads: int,
) -> tuple[NDArray[np.int64], NDArray[np.int32], NDArray[np.int32]]: ...
def voronoi_vertices2(
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    edges: NDArray[np.int32],
    edge_triangles: NDArray[np.int32],
    weights: NDArray[np.float64],
    threads: int,
) -> tuple[NDArray[np.float64], NDArray[np.int32]]: ...
def restricted2(
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    has_triangle: NDArray[np.bool_],
    edges: NDArray[np.int32],
    has_edge: NDArray[np.bool_],
    edge_triangles: NDArray[np.int32],
    active: NDArray[np.bool_],
    radius: float,
    weights: NDArray[np.float64],
    threads: int,
    progress: Callable[[float], object] | None,
) -> tuple[
    NDArray[np.int64],
    NDArray[np.float64],
    NDArray[np.float64],
    NDArray[np.int32],
    NDArray[np.float64],
    NDArray[np.float64],
    NDArray[np.float64],
    NDArray[np.float64],
]: ...
def hull2(points: NDArray[np.float64], collinear: bool, threads: int) -> NDArray[np.int32]: ...
def locate2(
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    neighbors: NDArray[np.int32],
    queries: NDArray[np.float64],
    threads: int,
) -> NDArray[np.int32]: ...
def parts2(
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    edges: NDArray[np.int32],
    edge_triangles: NDArray[np.int32],
    inside: NDArray[np.bool_],
) -> NDArray[np.int32]: ...
def outlines2(
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    edges: NDArray[np.int32],
    edge_triangles: NDArray[np.int32],
    region: NDArray[np.int32],
    threads: int,
) -> tuple[
    NDArray[np.int64],
    NDArray[np.int32],
    NDArray[np.int32],
    NDArray[np.int32],
    NDArray[np.bool_],
]: ...
def segment_tree2(
    points: NDArray[np.float64], edges: NDArray[np.int32], threads: int
) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.float64]]: ...
def nearest2(
    segments: NDArray[np.float64],
    place: NDArray[np.int32],
    boxes: NDArray[np.float64],
    queries: NDArray[np.float64],
    threads: int,
    progress: Callable[[float], object] | None,
) -> tuple[NDArray[np.int32], NDArray[np.float64], NDArray[np.float64]]: ...
def orient2(corners: NDArray[np.float64]) -> NDArray[np.int8]: ...
def incircle2(corners: NDArray[np.float64], perturb: bool) -> NDArray[np.int8]: ...
def dot2(corners: NDArray[np.float64]) -> NDArray[np.int8]: ...
def alpha3(
    points: NDArray[np.float64],
    threads: int,
    progress: Callable[[float], object] | None,
) -> tuple[
    int,
    NDArray[np.int32] | None,
    NDArray[np.int32],
    NDArray[np.float64],
    NDArray[np.int32],
    NDArray[np.float64],
    NDArray[np.int32],
    NDArray[np.int32],
    NDArray[np.float64],
]: ...
def tetrahedron_triangles3(
    tetrahedra: NDArray[np.int32],
    triangles: NDArray[np.int32],
    triangle_tetrahedra: NDArray[np.int32],
    threads: int,
) -> NDArray[np.int32]: ...
def triangle_edges3(
    n: int, triangles: NDArray[np.int32], edges: NDArray[np.int32], threads: int
) -> NDArray[np.int32]: ...
def parts3(
    triangle_tetrahedra: NDArray[np.int32],
    inside: NDArray[np.bool_],
    wall: NDArray[np.bool_],
) -> NDArray[np.int32]: ...
def delaunay3(
    points: NDArray[np.float64],
    threads: int,
    progress: Callable[[float], object] | None,
) -> tuple[int, NDArray[np.int32] | None, NDArray[np.int32], NDArray[np.int32]]: ...
def orient3(corners: NDArray[np.float64]) -> NDArray[np.int8]: ...
def insphere3(corners: NDArray[np.float64], perturb: bool) -> NDArray[np.int8]: ...
def surface3(
    points: NDArray[np.float64],
    tetrahedra: NDArray[np.int32],
    triangles: NDArray[np.int32],
    triangle_tetrahedra: NDArray[np.int32],
    tetrahedron_triangles: NDArray[np.int32],
    inside: NDArray[np.bool_],
    threads: int,
) -> tuple[
    NDArray[np.int32],
    NDArray[np.int32],
    NDArray[np.int32],
    NDArray[np.int32],
    NDArray[np.int32],
    NDArray[np.int32],
]: ...
def outer_shells3(
    shell: NDArray[np.int32], region: NDArray[np.int32], part: NDArray[np.int32]
) -> NDArray[np.bool_]: ...
def locate3(
    points: NDArray[np.float64],
    tetrahedra: NDArray[np.int32],
    triangle_tetrahedra: NDArray[np.int32],
    tetrahedron_triangles: NDArray[np.int32],
    label: NDArray[np.int32],
    queries: NDArray[np.float64],
    threads: int,
) -> tuple[NDArray[np.int32], NDArray[np.int8]]: ...
def triangle_tree3(
    points: NDArray[np.float64], triangles: NDArray[np.int32], threads: int
) -> tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.float64]]: ...
def nearest3(
    triangles: NDArray[np.float64],
    place: NDArray[np.int32],
    boxes: NDArray[np.float64],
    queries: NDArray[np.float64],
    threads: int,
) -> tuple[NDArray[np.int32], NDArray[np.float64], NDArray[np.float64]]: ...
def trim_memory() -> None: ...
def union2(
    high: NDArray[np.float64],
    low: NDArray[np.float64] | None,
    weights: NDArray[np.float64] | None,
    row: NDArray[np.int32] | None,
    power: float,
    simplices: tuple[NDArray[np.int32], ...],
    sides: tuple[NDArray[np.int32], ...],
    has: tuple[NDArray[np.bool_], ...],
    cofaces: NDArray[np.int32],
    hole: NDArray[np.int32],
    holes: int,
    threads: int,
    progress: Callable[[float], object] | None,
) -> tuple[
    float,
    NDArray[np.float64],
    NDArray[np.float64],
    NDArray[np.float64],
    NDArray[np.float64],
]: ...
def union3(
    high: NDArray[np.float64],
    low: NDArray[np.float64] | None,
    weights: NDArray[np.float64] | None,
    row: NDArray[np.int32] | None,
    power: float,
    simplices: tuple[NDArray[np.int32], ...],
    sides: tuple[NDArray[np.int32], ...],
    has: tuple[NDArray[np.bool_], ...],
    cofaces: NDArray[np.int32],
    hole: NDArray[np.int32],
    holes: int,
    threads: int,
    progress: Callable[[float], object] | None,
) -> tuple[
    float,
    NDArray[np.float64],
    NDArray[np.float64],
    NDArray[np.float64],
    NDArray[np.float64],
]: ...
def self_test() -> str: ...

class Recycling:
    def __init__(self) -> None: ...

_Border = tuple[int, NDArray[np.int64], NDArray[np.int32]]
_Points = tuple[NDArray[np.int64], NDArray[np.float64], NDArray[np.int64]]

def tile2(
    points: NDArray[np.float64],
    weights: NDArray[np.float64] | None,
    rows: NDArray[np.int64],
    bounds: NDArray[np.float64],
    radius: float,
    threads: int,
    progress: Callable[[float], object] | None,
) -> tuple[
    _Points,
    NDArray[np.int64],
    NDArray[np.float64] | None,
    NDArray[np.int64],
    NDArray[np.float64],
    NDArray[np.int8],
    NDArray[np.int64],
    NDArray[np.float64],
    NDArray[np.int32],
    NDArray[np.int32],
    NDArray[np.float64],
    _Border,
    _Border,
]: ...
def tile_share3(
    points: NDArray[np.float64],
    real: int,
    rows: NDArray[np.int64],
    representative: NDArray[np.int32],
    vertex_radii: NDArray[np.float64] | None,
    edges: NDArray[np.int32],
    edge_radii: NDArray[np.float64],
    triangles: NDArray[np.int32],
    triangle_radii: NDArray[np.float64],
    triangle_tetrahedra: NDArray[np.int32],
    tetrahedra: NDArray[np.int32],
    tetrahedron_radii: NDArray[np.float64],
    bounds: NDArray[np.float64],
    radius: float,
    progress: Callable[[float], object] | None,
) -> tuple[
    _Points,
    NDArray[np.int64],
    NDArray[np.float64] | None,
    NDArray[np.int64],
    NDArray[np.float64],
    NDArray[np.int64],
    NDArray[np.float64],
    NDArray[np.int8],
    NDArray[np.int64],
    NDArray[np.float64],
    NDArray[np.int32],
    NDArray[np.int32],
    NDArray[np.float64],
    _Border,
    _Border,
    _Border,
]: ...
def spread(
    points: NDArray[np.float64],
    axes: NDArray[np.int64],
    low: NDArray[np.float64],
    high: NDArray[np.float64],
    below: NDArray[np.int64],
    above: NDArray[np.int64],
    progress: Callable[[float], object] | None,
) -> tuple[NDArray[np.int64], NDArray[np.int32], NDArray[np.float64]]: ...
def checksum(content: NDArray[np.uint8], before: int) -> int: ...
def memory(size: int) -> NDArray[np.uint8]: ...
