"""Which columns of a table are the coordinates."""

from __future__ import annotations

import operator
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from alphamesh.errors import ParameterError, rows_text
from alphamesh.io._sources import Source

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from alphamesh._arrays import FloatArray

__all__ = [
    "Columns",
    "Wanted",
    "choose_columns",
    "exact_floats",
    "find_column",
    "same_name",
    "stack",
    "wanted_columns",
    "without_flat_z",
]

Columns: TypeAlias = "str | Sequence[str | int] | None"


class Wanted(NamedTuple):
    """Which columns are asked for (empty: the usual ones), and how many are needed.

    Where nobody says how many, `dimension` is 2, and `space` tells that a third one is
    taken if it is there: a column z, or, if `unnamed`, just the third of three.
    """

    columns: tuple[str | int, ...]
    dimension: int
    space: bool = False
    unnamed: bool = False


# Names that mean coordinates, in lower case; each row is x, y, z.
_KNOWN = (
    (("x",), ("y",), ("z",)),
    (
        ("lon", "long", "lng", "longitude"),
        ("lat", "latitude"),
        ("alt", "altitude", "elev", "elevation", "height", "z"),
    ),
    (("easting", "east", "e"), ("northing", "north", "n"), ("elevation", "height", "up", "z")),
)
_SHOWN = 12
# From here on float64 skips integers.
_LARGEST_INTEGER = 2**53


def wanted_columns(columns: Columns, dimension: int | None) -> Wanted:
    """Return what the parameters `columns` and `dimension` ask for.

    Raises
    ------
    ParameterError
        If the two parameters are not as :func:`alphamesh.read_points` documents them.
    """
    if dimension not in (None, 2, 3) or isinstance(dimension, float):
        raise ParameterError(f"dimension must be 2 or 3, not {dimension!r}")
    if columns is None:
        return Wanted((), dimension or 2, space=dimension is None)
    wanted = _listed(columns)
    if len(wanted) != (dimension or len(wanted)) or len(wanted) not in (2, 3):
        need = f"{dimension}" if dimension else "two or three"
        raise ParameterError(f"columns={columns!r} must name {need} columns")
    return Wanted(wanted, len(wanted))


def _listed(columns: str | Sequence[str | int]) -> tuple[str | int, ...]:
    if isinstance(columns, str):
        return tuple(part.strip() for part in columns.split(","))
    try:
        return tuple(
            item if isinstance(item, str) else operator.index(item) for item in columns
        )
    except TypeError:
        raise ParameterError(
            f"columns must hold names or numbers that count from 0, not {columns!r}; "
            "for example columns=('x', 'y') or columns=(0, 1)"
        ) from None


def choose_columns(
    source: Source, wanted: Wanted, names: Sequence[str] | None, width: int
) -> tuple[int, ...]:
    """Return the numbers of the columns that hold the coordinates.

    Parameters
    ----------
    source : Source
        For messages.
    wanted : Wanted
    names : sequence of str or None
        The names of all columns, if they have any.
    width : int
        How many columns there are.

    Raises
    ------
    FileReadError
        If a column is missing or ambiguous.
    """
    dimension = wanted.dimension
    if wanted.columns:
        found = tuple(find_column(source, item, names, width) for item in wanted.columns)
        if len(set(found)) < len(found):
            raise ParameterError(f"columns={wanted.columns!r} names one column twice")
        return found
    known = _known_columns(source, names, dimension) if names else None
    if known is not None:
        return (*known, *_named_z(names, known)) if wanted.space else known
    if wanted.space and wanted.unnamed and not names and width >= 3:
        return 0, 1, 2
    if width < dimension:
        raise source.failure(
            f"has {_columns_text(names, width)}, and {dimension} are needed; "
            "check that it is a table of coordinates and that delimiter= is right"
        )
    return tuple(range(dimension))


def find_column(
    source: Source,
    item: str | int,
    names: Sequence[str] | None,
    width: int,
    option: str = "columns",
) -> int:
    """Return the number of one column asked for by its name or number."""
    listed = _columns_text(names, width)
    if isinstance(item, str):
        for key in (str, _plain):
            same = [k for k, name in enumerate(names or ()) if key(name) == key(item)]
            if len(same) == 1:
                return same[0]
            if same:
                raise source.failure(
                    f"has several columns named {item!r} (numbers "
                    f"{', '.join(map(str, same))}, from 0); choose by number with {option}="
                )
        if not (item.isascii() and item.isdigit()):
            raise source.failure(
                f"has no column {item!r}; it has {listed}; choose among these with {option}="
            )
    number = int(item)
    if not 0 <= number < width:
        raise source.failure(
            f"has no column number {number}; it has {listed}, and numbers count from 0"
        )
    return number


def _known_columns(
    source: Source, names: Sequence[str], dimension: int
) -> tuple[int, ...] | None:
    """Return the columns whose names mean x, y (and z), or None where no name does."""
    plain = [_plain(name) for name in names]
    for family in _KNOWN:
        found = [[k for k, name in enumerate(plain) if name in axis] for axis in family]
        found = found[:dimension]
        if not (found[0] or found[1]):
            continue
        if all(len(axis) == 1 for axis in found):
            return tuple(axis[0] for axis in found)
        # A single "e" or "n" is no sign of coordinates, but a lone x or lat is.
        if family is not _KNOWN[-1]:
            missing = next(
                axis for axis, has in zip(family, found, strict=False) if len(has) != 1
            )
            raise source.failure(
                f"has {_columns_text(names, len(names))}: which are the coordinates is "
                f"unclear (not one {missing[0]!r}); choose {dimension} with columns="
            )
    return None


def _named_z(names: Sequence[str] | None, known: tuple[int, ...]) -> tuple[int, ...]:
    """Return the number of a column z that goes with columns x and y, if there is just one.

    A height beside longitude and latitude does not: it is in other units.
    """
    plain = [_plain(name) for name in names or ()]
    if [plain[k] for k in known] != ["x", "y"] or plain.count("z") != 1:
        return ()
    return (plain.index("z"),)


def without_flat_z(points: FloatArray, wanted: Wanted) -> FloatArray:
    """Return the points without a third column that was not asked for and is all one number."""
    flat = wanted.space and points.shape[1] == 3 and (points[:, 2] == points[:1, 2]).all()
    return np.ascontiguousarray(points[:, :2]) if flat else points


def same_name(name: str, other: str) -> bool:
    """Whether two column names differ at most in case and in a unit in brackets."""
    return _plain(name) == _plain(other)


def _plain(name: str) -> str:
    """Return a name in lower case, without a unit in brackets."""
    return re.sub(r"[\[(].*", "", name).strip().casefold()


def _columns_text(names: Sequence[str] | None, width: int) -> str:
    if not names:
        return "1 column" if width == 1 else f"{width} columns"
    listed = ", ".join(repr(name) for name in names[:_SHOWN])
    rest = f", ... ({len(names)} in all)" if len(names) > _SHOWN else ""
    return f"the column{'s' if len(names) > 1 else ''} {listed}{rest}"


def exact_floats(source: Source, column: NDArray[Any], name: str | int) -> FloatArray:
    """Return a column as float64, or an error where that is not possible exactly."""
    if column.dtype.kind not in "iuf":
        raise source.failure(
            f"holds {column.dtype} in column {name!r}, which are no coordinates; "
            "choose numeric columns with columns="
        )
    if column.dtype.kind in "iu" and column.dtype.itemsize == 8:
        bad = np.flatnonzero((column > _LARGEST_INTEGER) | (column < -_LARGEST_INTEGER))
        if len(bad):
            where = rows_text(bad[:6], total=len(bad))
            raise source.failure(
                f"holds integers beyond 2**53 in column {name!r}, {where}, which float64 "
                "would round; subtract a common offset before saving"
            )
    # Signalling NaNs would warn.
    with np.errstate(over="ignore", invalid="ignore"):
        return column.astype(np.float64)


def stack(columns: Sequence[FloatArray]) -> FloatArray:
    """Return the columns side by side, C-contiguous."""
    return np.ascontiguousarray(np.stack(columns, axis=1))
