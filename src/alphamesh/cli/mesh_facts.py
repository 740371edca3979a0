"""What the triangles of a mesh in space make up, as far as they tell by themselves."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._kernels.topology import component_count
from alphamesh.cli.summary import counted, number
from alphamesh.manifold import is_manifold, is_oriented, side_keys, sides_of
from alphamesh.measures import triangle_areas
from alphamesh.shells import shell_measures

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["tell_surface"]


def tell_surface(
    points: NDArray[np.float64],
    triangles: NDArray[np.integer[Any]] | None,
    facts: dict[str, Any],
    lines: dict[str, str],
) -> None:
    """Tell whether triangles in space are watertight, and what they enclose.

    Parameters
    ----------
    points : (n, 2) or (n, 3) float64
    triangles : (k, 3) int or None
    facts, lines : dict
        The summary for scripts and for people, which are added to.
    """
    flat = points.shape[1] < 3 or len(points) == 0 or not np.ptp(points[:, 2])
    if triangles is None or len(triangles) == 0 or flat:
        return
    corners = np.ascontiguousarray(triangles, dtype=np.int32)
    area = float(triangle_areas(points, corners).sum())
    tight = is_manifold(corners)
    facts |= {"watertight": tight, "area": area}
    lines |= {"Area": number(area), "Watertight": "yes" if tight else _fault(corners)}
    if not tight:
        return
    _, volumes = shell_measures(points, corners, np.zeros(len(corners), dtype=np.int32), 1)
    used, edges = np.unique(corners), len(corners) * 3 // 2
    shells = component_count(len(points), sides_of(corners)) - (len(points) - len(used))
    # The Euler characteristic is 2 - 2 g for each shell.
    genus = shells - (len(used) - edges + len(corners)) // 2
    facts |= {"volume": float(volumes[0]), "shells": shells, "genus": genus}
    lines |= {
        "Volume": number(float(volumes[0])),
        "Shells": f"{shells:,}",
        "Genus": f"{genus:,}" + (" in all" if shells > 1 else ""),
    }


def _fault(triangles: NDArray[np.int32]) -> str:
    """Say why triangles are no closed, oriented manifold."""
    keys = side_keys(triangles)
    _, counts = np.unique(keys, return_counts=True)
    border, crowded = (int(np.count_nonzero(found)) for found in (counts == 1, counts > 2))
    if border:
        return f"no, {counted(border, 'edge')} with one triangle alone"
    if crowded:
        return f"no, {counted(crowded, 'edge')} with more than two triangles"
    if not is_oriented(triangles):
        return "no, neighbouring triangles face opposite ways"
    return "no, it touches itself at vertices"
