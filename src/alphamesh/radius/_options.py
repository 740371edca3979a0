"""Options of rules, checked."""

from __future__ import annotations

import operator
from typing import Any

from alphamesh.errors import ParameterError

__all__ = ["whole_number"]


def whole_number(name: str, value: Any, least: int) -> int:
    """Return `value` as an int of at least `least`, or raise ParameterError."""
    try:
        number = operator.index(value)
    except TypeError:
        number = least - 1
    if isinstance(value, bool) or number < least:
        raise ParameterError(
            f"{name} must be a whole number of at least {least}; got {value!r}"
        )
    return number
