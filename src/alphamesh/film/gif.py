"""GIF files written frame by frame: one palette for all, and only what changes."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from typing import IO, TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from PIL import Image

__all__ = ["GifWriter", "Palette"]

# The last colour stands for "as in the frame before".
_SAME = 255

# So many colours are kept as they are; the others are averages.
_EXACT = 40

Pixels = NDArray[np.uint8]


class Palette:
    """The colours of a film, and the nearest of them to any other.

    Parameters
    ----------
    pictures : list of (height, width, 3) uint8
        Some of its frames. Frequent colours count more than rare ones, though not in
        proportion: most of a picture is paper.
    """

    def __init__(self, pictures: list[Pixels]) -> None:
        from PIL import Image

        codes, counts = np.unique(
            np.concatenate([_codes(picture).ravel() for picture in pictures]),
            return_counts=True,
        )
        weighted = np.repeat(codes, np.ceil(np.log2(counts + 1)).astype(np.int64))
        sample = Image.fromarray(_colors(weighted)[np.newaxis])
        cut = sample.quantize(_SAME - _EXACT, method=Image.Quantize.MEDIANCUT)
        others = np.array(cut.getpalette(), dtype=np.uint8).reshape(-1, 3)
        exact = _most_frequent(pictures)
        self.colors = np.concatenate((exact, others))[:_SAME]
        self._nearest = self._nearest_of(_colors(np.arange(1 << 15)))
        # Backwards: of two exact colours with the same code, the more frequent one counts.
        self._nearest[_codes(exact)[::-1]] = np.arange(len(exact), dtype=np.uint8)[::-1]

    def _nearest_of(self, colors: Pixels) -> Pixels:
        mine = self.colors.astype(np.float32)
        nearest = [
            np.square(part[:, np.newaxis] - mine).sum(axis=2).argmin(axis=1)
            for part in np.array_split(colors.astype(np.float32), 16)
        ]
        return np.concatenate(nearest).astype(np.uint8)

    def indices(self, picture: Pixels) -> Pixels:
        """Return the number of the colour of each pixel, ``(height, width)`` uint8."""
        return self._nearest[_codes(picture)]


def _most_frequent(pictures: list[Pixels]) -> Pixels:
    """Return the most frequent colours as they are: those of paper and of filled areas."""
    wide = [picture.astype(np.uint32) for picture in pictures]
    packed = [(rgb[..., 0] << 16 | rgb[..., 1] << 8 | rgb[..., 2]).ravel() for rgb in wide]
    values, counts = np.unique(np.concatenate(packed), return_counts=True)
    top = values[np.argsort(-counts, kind="stable")[:_EXACT]]
    return np.stack([top >> shift & 255 for shift in (16, 8, 0)], axis=1).astype(np.uint8)


def _codes(picture: Pixels) -> NDArray[np.uint16]:
    """Return the colour of each pixel as one number of fifteen bits."""
    red, green, blue = np.moveaxis(picture.astype(np.uint16) >> 3, -1, 0)
    return np.asarray(red << 10 | green << 5 | blue)


def _colors(codes: NDArray[np.integer]) -> Pixels:
    """Return the colours that such numbers stand for; the last is white."""
    parts = np.stack([(codes >> shift) & 31 for shift in (10, 5, 0)], axis=-1)
    return (parts << 3 | parts >> 2).astype(np.uint8)


class GifWriter:
    """Writes an endless GIF; holds no more than two frames.

    Parameters
    ----------
    target : binary file
    size : (width, height)
        In pixels.
    palette : Palette
    """

    def __init__(self, target: IO[bytes], size: tuple[int, int], palette: Palette) -> None:
        self._target = target
        self._palette = palette
        self._before: Pixels | None = None
        colors = palette.colors.tobytes()
        target.write(b"GIF89a" + struct.pack("<HHBBB", *size, 0xF7, 0, 0))
        target.write(colors + bytes(3 * 256 - len(colors)))
        # Netscape's extension: repeat for ever.
        target.write(b"\x21\xff\x0bNETSCAPE2.0\x03\x01\x00\x00\x00")

    def add(self, picture: Pixels, milliseconds: int) -> None:
        """Write a frame that stays for so long, in steps of ten milliseconds."""
        from PIL import Image

        pixels = self._palette.indices(picture)
        x, y, part = self._change(pixels)
        for block in _blocks(Image.fromarray(part), (x, y), milliseconds):
            self._target.write(block)
        self._before = pixels

    def _change(self, pixels: Pixels) -> tuple[int, int, Pixels]:
        """Return the least box in which something changed, and what."""
        if self._before is None:
            return 0, 0, pixels
        changed = pixels != self._before
        rows, columns = np.flatnonzero(changed.any(axis=1)), np.flatnonzero(changed.any(axis=0))
        if len(rows) == 0:
            rows = columns = np.zeros(1, dtype=np.intp)
        box = slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
        part = np.where(changed[box], pixels[box], np.uint8(_SAME))
        return int(columns[0]), int(rows[0]), part

    def finish(self) -> None:
        """Write the end."""
        self._target.write(b"\x3b")


def _blocks(image: Image.Image, offset: tuple[int, int], milliseconds: int) -> Iterator[bytes]:
    """Return the blocks of one frame, compressed by Pillow."""
    from PIL import GifImagePlugin

    yield from GifImagePlugin.getdata(
        image.convert("P") if image.mode != "P" else image,
        offset,
        duration=milliseconds,
        disposal=1,
        transparency=_SAME,
    )
