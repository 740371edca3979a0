"""Arrays as few bytes: planes of bytes, deflated. ``static/data.js`` reads them."""

from __future__ import annotations

import json
import zlib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray

__all__ = ["pack", "rising_bits", "signed_bits"]

# The best level takes four times as long for one per cent.
_LEVEL = 6
_KINDS = {"u1": "u8", "u4": "u32", "f4": "f32", "u8": "rising", "i8": "signed"}
_SIGN = np.uint64(1 << 63)


def pack(meta: Mapping[str, Any], arrays: Mapping[str, np.ndarray[Any, Any]]) -> bytes:
    """Return `meta` and `arrays` as one block in the zlib format.

    Parameters
    ----------
    meta : mapping
        What JSON can hold.
    arrays : mapping of flat arrays
        uint8, uint32, float32, uint64 from :func:`rising_bits`, or int64 from
        :func:`signed_bits`.
    """
    blocks, planes = [], []
    for name, array in arrays.items():
        code = array.dtype.newbyteorder("<")
        blocks.append({"name": name, "type": _KINDS[code.str[1:]], "length": len(array)})
        octets = np.ascontiguousarray(array, dtype=code).view(np.uint8)
        planes.append(octets.reshape(-1, code.itemsize).T.tobytes())
    header = json.dumps({"meta": meta, "arrays": blocks}, allow_nan=False).encode()
    size = len(header).to_bytes(4, "little")
    return zlib.compress(b"".join([size, header, *planes]), _LEVEL)


def rising_bits(values: FloatArray) -> np.ndarray[Any, np.dtype[np.uint64]]:
    """Return the differences of the bit patterns of ascending floats of at least 0.

    The bits of such floats, read as whole numbers, ascend as the floats do; neighbours
    differ by little, so most of the bytes are zero. Nothing is rounded.
    """
    bits = np.ascontiguousarray(np.abs(values), dtype=np.float64).view(np.uint64)
    first = np.zeros(1, dtype=np.uint64)
    return np.diff(bits, prepend=first)


def signed_bits(values: FloatArray) -> np.ndarray[Any, np.dtype[np.int64]]:
    """Return the same of ascending floats of any sign.

    With the sign turned, and all the other bits of negative floats, too, the bits of all
    floats ascend as these do.
    """
    # No negative zero, which would come before zero.
    bits = np.ascontiguousarray(values + 0.0, dtype=np.float64).view(np.uint64)
    rising = np.where(bits >= _SIGN, ~bits, bits | _SIGN)
    return np.diff(rising, prepend=np.zeros(1, dtype=np.uint64)).view(np.int64)
