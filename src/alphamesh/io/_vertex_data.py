"""Columns of points as numbers of the vertices of a mesh."""

from __future__ import annotations

import os
import re
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh.errors import LossyFormatWarning, ParameterError, user_stacklevel
from alphamesh.table import as_columns

if TYPE_CHECKING:
    from alphamesh.io._mesh import Numbers

__all__ = ["tell_of_lost_data", "vertex_data"]


def vertex_data(columns: Any, count: int) -> dict[str, Numbers]:
    """Return the columns that hold numbers, under names that all mesh files take.

    Parameters
    ----------
    columns : mapping, DataFrame, PointTable or None
    count : int
        How many points there are.

    Raises
    ------
    ParameterError
        If a column has not `count` values, or two get the same name.

    Warns
    -----
    LossyFormatWarning
        If columns hold no numbers and are left out.
    """
    if columns is None:
        return {}
    made: dict[str, Numbers] = {}
    left_out = []
    for name, values in as_columns(columns, count).items():
        if values.dtype.kind not in "biuf":
            left_out.append(repr(name))
            continue
        plain = re.sub(r"[^!-~]+|[\"'<>&]+", "_", name) or "values"
        if plain in made:
            raise ParameterError(
                f"two columns would both be called {plain!r} in a mesh file; rename one"
            )
        made[plain] = values if values.dtype != np.float16 else values.astype(np.float32)
    if left_out:
        warnings.warn(
            f"meshes hold numbers alone: left out {', '.join(left_out[:9])}; number the "
            "values, or save a table of points with to_geopandas('points')",
            LossyFormatWarning,
            stacklevel=user_stacklevel(),
        )
    return made


def tell_of_lost_data(path: str | os.PathLike[str], name: str) -> None:
    """Warn that a format holds no numbers of vertices.

    Warns
    -----
    LossyFormatWarning
    """
    warnings.warn(
        f"{os.fspath(path)}: {name} files hold no numbers of points: point_data is left out; "
        ".ply and .vtu hold them",
        LossyFormatWarning,
        stacklevel=user_stacklevel(),
    )
