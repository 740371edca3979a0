"""From whatever users have to a table of floats, or a refusal that names rows and remedy."""

from __future__ import annotations

import os
from collections.abc import Sequence
from numbers import Real
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from alphamesh.errors import CloudShapeError, CoordinateRangeError, rows_text

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray

Array: TypeAlias = "np.ndarray[Any, np.dtype[Any]]"

_MASK_HINT = "if it is a mask image, draw points from it with sample_mask(image, n)"
_MANTISSA = 53
_IN_WORDS = {2: "two", 3: "three"}
_AXES = {2: "x and y", 3: "x, y and z"}
_ANY = (2, 3)


def path_error(path: str | bytes | os.PathLike[Any]) -> CloudShapeError:
    """Return the error for a file name in the place of points."""
    return CloudShapeError(
        "points must be coordinates, not the name of a file; "
        f"read it first: read_points({os.fspath(path)!r})"
    )


def table_of_floats(points: Any, dimension: int | None = None) -> FloatArray:
    """Return a new C-contiguous float64 array of exactly the numbers in `points`.

    It has `dimension` columns; by default two or three.
    """
    allowed = _ANY if dimension is None else (dimension,)
    if isinstance(points, np.ma.MaskedArray):
        _refuse_masked(points)
        points = points.data
    if hasattr(points, "iloc") and hasattr(points, "columns"):
        return _from_frame(points, allowed)
    try:
        array = np.array(points)
    except ValueError as error:
        raise _ragged(points, allowed) from error
    if array.ndim == 0:
        raise CloudShapeError(
            f"points must be an {shape_text(allowed)} table of coordinates; "
            f"got {type(points).__name__}"
        )
    _refuse_kind(array, points)
    _refuse_shape(array, allowed)
    return np.ascontiguousarray(_exact_floats(array))


# What is refused outright


def _refuse_masked(points: np.ma.MaskedArray[Any, Any]) -> None:
    masked = np.atleast_1d(np.ma.getmaskarray(points))
    rows = np.flatnonzero(masked.reshape(len(masked), -1).any(axis=1))
    if len(rows):
        raise CloudShapeError(
            f"masked coordinates in {rows_text(rows[:6], total=len(rows))}; "
            "drop them with numpy.ma.compress_rows(points)",
            rows=rows[:6],
        )


def _refuse_kind(array: Array, source: Any) -> None:
    """Refuse arrays whose elements are not real numbers (objects are looked at later)."""
    kind = array.dtype.kind
    if kind in "US":
        raise _text_error(array, source)
    if kind == "c":
        raise CloudShapeError(
            "complex numbers are not coordinates; split them with "
            "numpy.column_stack([z.real, z.imag])"
        )
    if kind == "b":
        raise CloudShapeError(f"True and False are not coordinates; {_MASK_HINT}")
    if kind == "V":
        names = ", ".join(array.dtype.names or ())
        raise CloudShapeError(
            f"a structured array (fields {names}) is not a table of coordinates; choose two "
            "or three fields: numpy.column_stack([a['x'], a['y']])"
        )
    if kind not in "iufO":
        raise CloudShapeError(
            f"values of type {array.dtype} are not coordinates; convert them to float64 first"
        )


def shape_text(allowed: tuple[int, ...]) -> str:
    """Return ``"(n, 2) or (n, 3)"``."""
    return " or ".join(f"(n, {columns})" for columns in allowed)


def _columns_text(allowed: tuple[int, ...]) -> str:
    """Return ``"two columns, x and y, or three, x, y and z"``."""
    first, *rest = allowed
    text = f"{_IN_WORDS[first]} columns, {_AXES[first]}"
    return ", or ".join([text, *(f"{_IN_WORDS[k]}, {_AXES[k]}" for k in rest)])


def _refuse_shape(array: Array, allowed: tuple[int, ...]) -> None:
    shape = array.shape
    if array.dtype.kind == "O" and len(shape) == 1 and all(_is_row(row) for row in array):
        raise _ragged(list(array), allowed)
    if len(shape) != 2:
        raise CloudShapeError(
            f"points must have shape {shape_text(allowed)}; got {shape}; "
            f"{_remedy(array, allowed)}"
        )
    if shape[1] not in allowed:
        raise CloudShapeError(
            f"points must have {_columns_text(allowed)}; got shape {shape}; "
            f"{_remedy(array, allowed)}"
        )


def _remedy(array: Array, allowed: tuple[int, ...]) -> str:
    """Return what most likely turns an array of the wrong shape into a cloud."""
    shape, columns = array.shape, allowed[0]
    if array.size == 0:
        return f"a cloud without points is numpy.empty((0, {columns}))"
    if len(shape) > 2:
        return f"flatten it with points.reshape(-1, {columns}), or {_MASK_HINT}"
    names = ", ".join("xyz"[:columns])
    if len(shape) == 1 or shape[1] == 1:
        side_by_side = f"put coordinates side by side with numpy.column_stack([{names}])"
        single = len(shape) == 1 and shape[0] in allowed
        return f"one point is [[{', '.join('xyz'[: shape[0]])}]]" if single else side_by_side
    if shape[1] in _ANY:
        return _other_dimension(columns)
    if shape[0] in allowed:
        return "its rows and columns look swapped: pass points.T"
    return f"choose {_IN_WORDS[columns]} columns with points[:, :{columns}]; {_MASK_HINT}"


def _other_dimension(columns: int) -> str:
    """Return what to do with points in the plane where space is meant, or the reverse."""
    if columns == 2:
        return "this works in the plane alone: project the points, or choose points[:, :2]"
    return (
        "this works in space alone: add a third column with "
        "numpy.column_stack([points, numpy.zeros(len(points))])"
    )


def _ragged(rows: Any, allowed: tuple[int, ...]) -> CloudShapeError:
    """Return the error for rows of unequal length, or of a kind that NumPy cannot stack."""
    sizes = [len(row) if _is_row(row) else -1 for row in rows]
    columns = max(allowed, key=sizes.count)
    bad = [i for i, size in enumerate(sizes) if size != columns]
    if not bad:
        return CloudShapeError(
            "points is a list of rows that do not form a table of numbers; "
            "build one with numpy.array([tuple(p) for p in points], dtype=float)"
        )
    first = "is a single value" if sizes[bad[0]] < 0 else f"has {sizes[bad[0]]}"
    return CloudShapeError(
        f"every row must hold {_IN_WORDS[columns]} coordinates: look at "
        f"{rows_text(bad[:6], total=len(bad))} (row {bad[0]} {first}); drop or complete them",
        rows=bad[:6],
    )


def _is_row(value: Any) -> bool:
    return isinstance(value, Sequence | np.ndarray) and not isinstance(value, str | bytes)


def _text_error(array: Array, source: Any) -> CloudShapeError:
    """Tell numbers written as text from words among numbers."""
    # A list that mixes words and numbers has become all text: look at the original.
    items = array if isinstance(source, np.ndarray) else np.array(source, dtype=object)
    rows = items.reshape(len(items), -1)
    bad = [i for i, row in enumerate(rows) if not all(_reads_as_number(v) for v in row)]
    if not bad:
        return CloudShapeError(
            "the coordinates are numbers written as text; "
            "convert them with numpy.asarray(points, dtype=float)"
        )
    word = next(value for value in rows[bad[0]] if not _reads_as_number(value))
    return CloudShapeError(
        f"text in the place of coordinates in {rows_text(bad[:6], total=len(bad))} "
        f"(row {bad[0]} holds {_short(word)}); drop or mend these rows",
        rows=bad[:6],
    )


def _reads_as_number(value: Any) -> bool:
    try:
        float(value)
    except (TypeError, ValueError):
        return False
    return True


def _short(value: Any) -> str:
    text = str(value) if isinstance(value, np.generic) else repr(value)
    if isinstance(value, str | bytes):
        text = repr(value.item() if isinstance(value, np.generic) else value)
    return text if len(text) <= 30 else text[:27] + "..."


# Numbers, held exactly


def _exact_floats(array: Array) -> FloatArray:
    """Return the same numbers as float64; refuse rows where they would change."""
    if array.dtype.kind == "O":
        _refuse_objects(array)
        floats, same = _floats_of_objects(array)
    else:
        with np.errstate(over="ignore"):
            floats = array.astype(np.float64)
        if array.dtype.kind in "iu":
            same = _integers_fit(array)
        elif array.dtype.itemsize > 8:
            same = (floats == array) | np.isnan(array)
        else:
            return floats
    rows = np.flatnonzero(~same.all(axis=tuple(range(1, same.ndim))))
    if len(rows):
        raise CoordinateRangeError(
            f"float64 would round the numbers in {rows_text(rows[:6], total=len(rows))}; "
            "subtract a common offset before you convert them, or round them yourself with "
            "numpy.asarray(points, dtype=float)",
            rows=rows[:6],
        )
    return floats


def _integers_fit(array: Array) -> Array:
    """Return which integers have no more binary digits than float64 holds."""
    if array.dtype.itemsize <= 4:
        return np.ones(array.shape, dtype=bool)
    magnitudes = array.astype(np.uint64)
    magnitudes = np.where(array < 0, ~magnitudes + np.uint64(1), magnitudes)
    fit: Array = magnitudes <= np.uint64(2**_MANTISSA)
    if not fit.all():
        big = magnitudes[~fit]
        last_digit = big & (~big + np.uint64(1))
        fit[~fit] = big // last_digit < np.uint64(2**_MANTISSA)
    return fit


def _refuse_objects(array: Array) -> None:
    rows = array.reshape(len(array), -1)
    bad = [i for i, row in enumerate(rows) if not all(_is_real(value) for value in row)]
    if bad:
        value = next(value for value in rows[bad[0]] if not _is_real(value))
        raise CloudShapeError(
            f"values that are not numbers in {rows_text(bad[:6], total=len(bad))} "
            f"(row {bad[0]} holds {_short(value)}, a {type(value).__name__}); "
            "drop or mend these rows",
            rows=bad[:6],
        )


def _is_real(value: Any) -> bool:
    return isinstance(value, Real) and not isinstance(value, bool)


def _floats_of_objects(array: Array) -> tuple[FloatArray, Array]:
    floats = np.empty(array.shape)
    same = np.ones(array.shape, dtype=bool)
    for index, value in np.ndenumerate(array):
        try:
            floats[index] = value
        except OverflowError:
            same[index] = False
        else:
            same[index] = value == float(floats[index]) or value != value  # noqa: PLR0124 (NaN)
    return floats, same


# Tables with named columns


def _from_frame(frame: Any, allowed: tuple[int, ...]) -> FloatArray:
    """Return the numeric columns of a pandas-like DataFrame."""
    names = [str(name) for name in frame.columns]
    columns = [np.asarray(frame.iloc[:, k]) for k in range(len(names))]
    other = [name for name, column in zip(names, columns, strict=True) if not _numeric(column)]
    numeric = [name for name in names if name not in other]
    wanted = len(numeric) if len(numeric) in allowed else allowed[0]
    some = (numeric if len(numeric) >= wanted else list("xyz"))[:wanted]
    choose = f"choose {_IN_WORDS[wanted]} columns: df[{some}]"
    if other:
        listed = ", ".join(repr(name) for name in other[:5])
        raise CloudShapeError(f"columns that are not numeric: {listed}; {choose}")
    if len(names) not in allowed:
        listed = ", ".join(repr(name) for name in names[:5])
        raise CloudShapeError(f"a cloud has {_columns_text(allowed)}; got {listed}; {choose}")
    return np.ascontiguousarray(np.column_stack([_exact_floats(column) for column in columns]))


def _numeric(column: Array) -> bool:
    if column.dtype.kind == "O":
        return all(_is_real(value) or _is_missing(value) for value in column)
    return column.dtype.kind in "iuf"


def _is_missing(value: Any) -> bool:
    """Return whether this is None or pandas.NA: its row is named later, not its column."""
    return value is None or type(value).__name__ == "NAType"
