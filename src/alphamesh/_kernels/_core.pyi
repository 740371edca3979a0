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
def persistence2(
    points: NDArray[np.float64],
    triangles: NDArray[np.int32],
    triangle_radii: NDArray[np.float64],
    edges: NDArray[np.int32],
    edge_radii: NDArray[np.float64],
    edge_triangles: NDArray[np.int32],
    threads: int,
    progress: Callable[[float], object] | None,
) -> tuple[NDArray[np.int32], NDArray[np.int32]]: ...
def orient2(corners: NDArray[np.float64]) -> NDArray[np.int8]: ...
def incircle2(corners: NDArray[np.float64], perturb: bool) -> NDArray[np.int8]: ...
def dot2(corners: NDArray[np.float64]) -> NDArray[np.int8]: ...
def self_test() -> str: ...
