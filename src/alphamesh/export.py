"""Filtrations for other libraries: nobody is locked in."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

import numpy as np

from alphamesh._weights import signed_square
from alphamesh.errors import MissingLibraryError

if TYPE_CHECKING:
    import os
    from collections.abc import Sequence
    from typing import Self

    from alphamesh._arrays import FloatArray, IntArray

    Array: TypeAlias = np.ndarray[Any, Any]

__all__ = ["Exports", "to_gudhi", "to_numpy", "write_arrays", "write_npz"]

_NAMES = ("vertices", "edges", "triangles", "tetrahedra")
_RADII = ("vertex_radii", "edge_radii", "triangle_radii", "tetrahedron_radii")


class Filtered(Protocol):
    """A filtration of any dimension."""

    @property
    def points(self) -> FloatArray:
        """The cloud."""
        ...

    @property
    def representative(self) -> IntArray:
        """The lowest row with the coordinates of each row."""
        ...

    @property
    def simplices(self) -> Sequence[IntArray]:
        """Rows of the cloud, by dimension."""
        ...

    @property
    def radii(self) -> Sequence[FloatArray]:
        """Values of the simplices, by dimension."""
        ...

    @property
    def weights(self) -> FloatArray | None:
        """Squared radii of balls, or None."""
        ...

    @property
    def hidden(self) -> IntArray:
        """Rows that are in no simplex."""
        ...


def to_gudhi(filtration: Filtered, *, squared: bool = False) -> Any:
    """Return a filtration as a ``gudhi.SimplexTree``.

    Parameters
    ----------
    filtration : Filtration
    squared : bool, default False
        Give squared radii, as GUDHI's own alpha complexes do: with weights, power values.

    Returns
    -------
    gudhi.SimplexTree
        Its vertices are the rows of the cloud, without duplicates and hidden ones.

    Raises
    ------
    MissingLibraryError
        If gudhi is not installed.
    """
    try:
        from gudhi import SimplexTree
    except ImportError as missing:
        raise MissingLibraryError.of("gudhi", "gudhi", "A simplex tree") from missing
    tree = SimplexTree()
    for rows, radii in zip(filtration.simplices, filtration.radii, strict=True):
        values = signed_square(radii) if squared else np.array(radii)
        tree.insert_batch(np.array(rows.T, order="C"), values)
    return tree


def to_numpy(filtration: Filtered) -> dict[str, Array]:
    """Return a filtration as a plain dict of arrays.

    Returns
    -------
    dict of str to ndarray
        ``points`` (n, d) float64; ``representative`` (n,) int32; then for each dimension
        the simplices, ``vertices`` (m_0, 1), ``edges`` (m_1, 2), ``triangles`` (m_2, 3)
        int32, rows of the points; and their values ``vertex_radii``, ``edge_radii``,
        ``triangle_radii`` (m_k,) float64, in the units of the points. With weights, also
        ``weights`` (n,) float64 and ``hidden`` (h,) int32. The arrays are those of the
        filtration: read-only, not copied.
    """
    arrays: dict[str, Array] = {
        "points": filtration.points,
        "representative": filtration.representative,
    }
    arrays.update(zip(_NAMES, filtration.simplices, strict=False))
    arrays.update(zip(_RADII, filtration.radii, strict=False))
    if filtration.weights is not None:
        arrays["weights"], arrays["hidden"] = filtration.weights, filtration.hidden
    return arrays


def write_npz(filtration: Filtered, path: str | os.PathLike[str]) -> None:
    """Write :func:`to_numpy` into one file, to be read by ``numpy.load``.

    Parameters
    ----------
    filtration : Filtration
    path : path-like
        The name is taken as it is; ``.npz`` is usual. The file is written whole or not at
        all.

    Raises
    ------
    FileWriteError
        If the file cannot be written.
    """
    write_arrays(to_numpy(filtration), path)


def write_arrays(arrays: dict[str, Array], path: str | os.PathLike[str]) -> None:
    """Write arrays by name into one file; parameters and errors are those of `write_npz`."""
    from alphamesh.io._atomic import atomic_path

    with atomic_path(path) as temporary, temporary.open("wb") as file:
        named: Any = arrays
        np.savez(file, **named)


class Exports:
    """What complexes that users hold have in common, whatever their filtration.

    Nothing in them can change: a copy is the object itself.
    """

    __slots__ = ()

    _filtration: Any

    @property
    def crs(self) -> Any:
        """The coordinate reference system that came with the points, or None."""
        return self._filtration.crs

    @property
    def weights(self) -> FloatArray | None:
        """Squared radii of the balls, ``(n,)`` float64; None for balls of equal size."""
        weights: FloatArray | None = self._filtration.weights
        return weights

    @property
    def hidden(self) -> IntArray:
        """Rows that heavier points leave no part of the power diagram, ``(h,)`` int32."""
        hidden: IntArray = self._filtration.hidden
        return hidden

    def to_gudhi(self, *, squared: bool = False) -> Any:
        """Return the complex as a ``gudhi.SimplexTree``, its values radii or their squares.

        Parameters and errors are those of :func:`alphamesh.export.to_gudhi`.
        """
        return to_gudhi(self._filtration, squared=squared)

    def to_numpy(self) -> dict[str, Array]:
        """Return points, simplices and radii as a plain dict of arrays.

        The names are those of :func:`alphamesh.export.to_numpy`.
        """
        return to_numpy(self._filtration)

    def save_npz(self, path: str | os.PathLike[str]) -> None:
        """Write :meth:`to_numpy` into one file, to be read by ``numpy.load``.

        Parameters and errors are those of :func:`alphamesh.export.write_npz`.
        """
        write_npz(self._filtration, path)

    def __copy__(self) -> Self:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Self:
        return self
