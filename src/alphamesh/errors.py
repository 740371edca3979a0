"""Typed errors: each says what is wrong, where, and what to do about it."""

from __future__ import annotations

import sys
from collections.abc import Iterable

__all__ = [
    "AlphameshError",
    "AlphameshWarning",
    "CloudError",
    "CloudShapeError",
    "CloudTooLargeError",
    "CoordinateRangeError",
    "DimensionError",
    "EmptyCloudError",
    "EmptyMaskError",
    "FileReadError",
    "FileWriteError",
    "GeographicCoordinatesWarning",
    "InvalidResultError",
    "LossyFormatWarning",
    "MissingLibraryError",
    "NonFiniteError",
    "ParameterError",
    "PeriodicError",
    "PeriodsError",
    "UnknownElementError",
    "UnweightedOnlyError",
    "WeightsError",
]

_ROWS_SHOWN = 5


def rows_text(rows: Iterable[int], *, total: int | None = None) -> str:
    """Return ``"row 3"`` or ``"rows 1, 2, 3, ... (17 in all)"`` for a message."""
    listed = [int(row) for row in rows]
    count = len(listed) if total is None else total
    shown = ", ".join(str(row) for row in listed[:_ROWS_SHOWN])
    if count == 1:
        return f"row {shown}"
    return f"rows {shown}" if count <= _ROWS_SHOWN else f"rows {shown}, ... ({count} in all)"


def user_stacklevel() -> int:
    """Return the `stacklevel` at which a warning shows the line outside of alphamesh."""
    level, frame = 1, sys._getframe(1)
    inner = ("alphamesh.", "contextlib")
    while frame.f_back and frame.f_globals.get("__name__", "").startswith(inner):
        level, frame = level + 1, frame.f_back
    return level


class AlphameshError(Exception):
    """Base class of every error that alphamesh raises on purpose.

    Attributes
    ----------
    rows : tuple of int
        The offending rows of the input, at most the first few; empty where the
        error is not about rows.
    """

    def __init__(self, message: str, *, rows: Iterable[int] = ()) -> None:
        super().__init__(message)
        self.rows: tuple[int, ...] = tuple(int(row) for row in rows)


class CloudError(AlphameshError, ValueError):
    """A cloud of points that no complex can be built from."""


class CloudShapeError(CloudError):
    """The input is not an ``(n, 2)`` or ``(n, 3)`` array of real numbers."""


class NonFiniteError(CloudError):
    """Some coordinates are NaN or infinite."""


class CoordinateRangeError(CloudError):
    """Coordinates so far apart in scale that exact arithmetic would overflow or underflow."""


class WeightsError(CloudError):
    """Weights that are not one finite number for each point."""


class CloudTooLargeError(CloudError):
    """More points than 32-bit simplex numbers can hold."""


class EmptyCloudError(CloudError):
    """A cloud without points where at least one is needed."""


class EmptyMaskError(CloudError):
    """A mask image in which no pixel is chosen."""


class ParameterError(AlphameshError, ValueError):
    """A parameter outside the values that it can take."""


class UnknownElementError(AlphameshError, ValueError):
    """Atoms of elements that no van der Waals radius is known for."""


class PeriodsError(ParameterError):
    """Side lengths that no periodic box can have."""


class PeriodicError(AlphameshError, AttributeError):
    """Something that clouds in open space have, asked of a cloud in a periodic box."""


class DimensionError(AlphameshError, TypeError):
    """Something that clouds in the plane have, asked of a cloud in space."""


class UnweightedOnlyError(AlphameshError, TypeError):
    """Something that has a meaning for balls of equal size, asked of points with weights."""


class FileReadError(AlphameshError, OSError):
    """A file that cannot be read, or is not what its name says."""


class FileWriteError(AlphameshError, OSError):
    """An output that cannot be written; nothing is left behind at its path."""


class MissingLibraryError(AlphameshError, ImportError):
    """An optional library is not installed; the message names the extra to install."""

    @classmethod
    def of(cls, library: str, extra: str, purpose: str) -> MissingLibraryError:
        """Return the error for `library`, needed for `purpose`, in the extra `extra`."""
        return cls(
            f"{purpose} needs {library}, which is not installed; "
            f'install it with: pip install "alphamesh[{extra}]"'
        )


class InvalidResultError(AlphameshError, AssertionError):
    """A result that breaks an invariant (see :mod:`alphamesh.check`)."""


class AlphameshWarning(UserWarning):
    """Base class of every warning of alphamesh."""


class LossyFormatWarning(AlphameshWarning):
    """A file format that cannot hold all of what is written; the message names the loss."""


class GeographicCoordinatesWarning(AlphameshWarning):
    """Points in degrees of longitude and latitude, where a radius is distorted."""
