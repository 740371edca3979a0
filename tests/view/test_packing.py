"""Arrays on their way to the page: packed, and read back to the last digit."""

from __future__ import annotations

import json
import zlib

import numpy as np
from hypothesis import given, settings

import alphamesh as am
from alphamesh.view.packing import pack, rising_bits, signed_bits
from strategies import clouds
from view_facts import packed


@given(clouds())
@settings(max_examples=15)
def test_packed_data_read_back_to_the_last_digit(points):
    cx = am.AlphaComplex(points)
    raw = zlib.decompress(packed(cx))
    size = int.from_bytes(raw[:4], "little")
    header = json.loads(raw[4 : 4 + size])
    at = 4 + size
    for block in header["arrays"]:
        wide = 8 if block["type"] == "rising" else 4
        planes = np.frombuffer(raw, np.uint8, wide * block["length"], at)
        at += wide * block["length"]
        if block["name"] == "edge_values":
            bits = planes.reshape(wide, -1).T.copy().view(np.uint64).ravel()
            assert np.array_equal(np.cumsum(bits).view(np.float64), np.sort(cx.radii[1]))
    assert at == len(raw)


def test_signed_bits_ascend():
    values = np.array([-1.7e308, -2.0, -5e-324, -0.0, 0.0, 5e-324, 1.0, 1.7e308])
    rising = np.cumsum(signed_bits(values).view(np.uint64))
    assert (np.diff(rising.astype(object)) >= 0).all()
    top = np.uint64(1 << 63)
    bits = np.where(rising >= top, rising ^ top, ~rising)
    assert np.array_equal(bits.view(np.float64), values)


def test_rising_bits_of_zeros_of_either_sign():
    values = np.array([-0.0, 0.0, 5e-324, 1.0, 1.0, 1.7e308])
    assert np.array_equal(np.cumsum(rising_bits(values)).view(np.float64), np.abs(values))
    assert len(pack({"a": 1}, {})) > 0
