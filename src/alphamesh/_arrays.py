"""Arrays that one stage hands to the next: their types, and the records that hold them."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

import numpy as np

if TYPE_CHECKING:
    from typing import TypeAlias

    from numpy.typing import NDArray

    FloatArray: TypeAlias = NDArray[np.float64]
    ComplexArray: TypeAlias = NDArray[np.complex128]
    IntArray: TypeAlias = NDArray[np.int32]
    CountArray: TypeAlias = NDArray[np.int64]
    KindArray: TypeAlias = NDArray[np.int8]
    CodeArray: TypeAlias = NDArray[np.uint8]
    BoolArray: TypeAlias = NDArray[np.bool_]

AnyArray = TypeVar("AnyArray", bound="np.ndarray[Any, Any]")


def read_only(array: AnyArray) -> AnyArray:
    """Return `array` itself, closed to writing."""
    array.setflags(write=False)
    return array


class Record:
    """Base of the frozen dataclasses of read-only arrays: safe to copy and to pickle.

    Nothing in a record can change, so a copy is the record itself. NumPy forgets the
    read-only flag in a pickle; a record sets it again on the way back.
    """

    __slots__ = ()
    __dataclass_fields__: ClassVar[dict[str, Any]]

    def __copy__(self) -> Record:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Record:
        return self

    def __reduce__(self) -> tuple[Callable[..., Record], tuple[Any, ...]]:
        values = (getattr(self, name) for name in self.__dataclass_fields__)
        return _restored, (type(self), *values)


def _restored(kind: type[Record], *values: Any) -> Record:
    for value in values:
        for part in value if isinstance(value, tuple) else (value,):
            if isinstance(part, np.ndarray):
                read_only(part)
    return kind(*values)
