"""Clouds from mask images: which pixels are chosen, and points drawn from them."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from alphamesh.errors import (
    EmptyMaskError,
    FileReadError,
    MissingLibraryError,
    ParameterError,
)
from alphamesh.io._sources import Source, open_source
from alphamesh.sampling import Seed, generator, point_count, sample_pixels

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray
    from PIL.Image import Image

    from alphamesh._arrays import BoolArray, FloatArray

    ImageLike: TypeAlias = "str | os.PathLike[str] | Image | ArrayLike"

__all__ = ["read_mask", "sample_mask"]

# Pixels looked at in one go, so that temporary arrays stay small.
_BLOCK = 2**20
# Weights of red, green and blue in the brightness (ITU-R BT.601), in thousandths: as whole
# numbers they make grey in RGB exactly as bright as the same grey in one channel.
_LUMA = np.array([299.0, 587.0, 114.0])


def sample_mask(  # noqa: PLR0913 (one keyword per choice)
    image: ImageLike,
    n: int,
    *,
    threshold: float = 0.5,
    invert: bool = False,
    seed: Seed = None,
    jitter: bool = True,
    replace: bool = False,
) -> FloatArray:
    """Draw points from the bright pixels of an image.

    Parameters
    ----------
    image : str, path-like, PIL image or array
        A file that Pillow reads, an image, or an array as for :func:`read_mask`.
    n : int
        How many points, at least 1.
    threshold : float
        Pixels brighter than this are chosen: see :func:`read_mask`.
    invert : bool
        Choose the other pixels instead: dark drawings on light ground.
    seed : int, numpy.random.Generator or None
        The same integer gives the same points; None gives new ones each time.
    jitter : bool
        True: each point lies uniformly inside its pixel. False: each point is the
        pixel's lower left corner, so that all coordinates are integers.
    replace : bool
        True: every point picks its pixel independently. False: the points use all
        pixels as evenly as can be, each pixel floor(n / pixels) times or once more.

    Returns
    -------
    (n, 2) float64 array
        In random order. Units are pixels, x to the right and y **upwards**: an image of
        height h and width w covers [0, w] x [0, h], and its bottom row has 0 <= y < 1.
        With jitter there may be more points than pixels; points repeat only with
        ``jitter=False, replace=True``.

    Raises
    ------
    EmptyMaskError
        If no pixel is chosen.
    FileReadError
        If the file is missing, damaged, too large or no image.
    ParameterError
        If a parameter has no possible value, or `n` exceeds the number of pixels and
        neither `jitter` nor `replace` allows a pixel twice.
    MissingLibraryError
        If Pillow is needed to open a file and is not installed.
    """
    point_count(n)
    rng = generator(seed)
    mask = read_mask(image, threshold=threshold, invert=invert)
    return sample_pixels(mask, n, seed=rng, jitter=jitter, replace=replace)


def read_mask(image: ImageLike, *, threshold: float = 0.5, invert: bool = False) -> BoolArray:
    """Return which pixels of an image are brighter than a threshold.

    Brightness is a fraction of full scale: 255 for 8-bit images and uint8 arrays, 65535
    for 16 bits, 1 for bool. Colours are weighted as 0.299 R + 0.587 G + 0.114 B. Where
    there is no scale, none is made up: floats are compared with the threshold as they
    are, and an image or integer array of nothing but 0 and 1 is a mask already. NaN,
    and pixels more transparent than opaque, are never chosen, with or without `invert`.

    Parameters
    ----------
    image : str, path-like, PIL image or array
        A file that Pillow reads (of several frames the first; turned as its EXIF tag
        says), an image, or an array of shape (h, w), (h, w, 1) grey, (h, w, 2) grey and
        alpha, (h, w, 3) RGB or (h, w, 4) RGBA, of type bool, uint8, uint16 or float.
    threshold : float
        From 0 to 1; any finite number for floats. Chosen pixels are strictly brighter.
    invert : bool
        Choose the pixels that are not brighter.

    Returns
    -------
    (h, w) bool array
        Row 0 is the top.

    Raises
    ------
    EmptyMaskError
        If no pixel is chosen; the message tells the brightest value there is.
    FileReadError, ParameterError, MissingLibraryError
        As for :func:`sample_mask`.
    """
    level = _level(threshold)
    name, pixels = _pixels(image)
    scale = _full_scale(pixels)
    if pixels.dtype.kind != "f" and not 0 <= level <= 1:
        raise ParameterError(
            f"threshold is a fraction of full scale, from 0 to 1, not {threshold!r}"
            + (f"; {level:g} of {scale:g} is {level / scale:.4g}" if 1 < level <= scale else "")
        )
    mask = np.empty(pixels.shape[:2], np.bool_)
    seen = _Range()
    for rows, brightness, visible in _blocks(pixels, scale):
        bright = brightness > level
        mask[rows] = visible & (~bright if invert else bright)
        seen.add(brightness[visible])
    if not mask.any():
        raise _empty(name, level, invert, seen)
    return mask


@dataclass(slots=True)
class _Range:
    """The darkest and brightest visible values met so far."""

    low: float = math.inf
    high: float = -math.inf

    def add(self, brightness: FloatArray) -> None:
        self.low = float(np.fmin.reduce(brightness, initial=self.low))
        self.high = float(np.fmax.reduce(brightness, initial=self.high))


def _empty(name: str, level: float, invert: bool, seen: _Range) -> EmptyMaskError:
    """Return the error for an image without a chosen pixel."""
    if seen.low > seen.high:
        return EmptyMaskError(
            f"{name} shows nothing: every pixel is transparent or NaN; check the image, or "
            "pass its alpha channel as an array"
        )
    if seen.low == seen.high:
        return EmptyMaskError(
            f"{name} has the same brightness {seen.low:.4g} everywhere, which is "
            f"{'above' if invert else 'not above'} threshold={level:g}; "
            "is it the right image?"
        )
    if invert:
        return EmptyMaskError(
            f"no pixel of {name} is as dark as threshold={level:g}: the darkest is "
            f"{seen.low:.4g}; raise the threshold to between {seen.low:.4g} and "
            f"{seen.high:.4g}, or leave out invert=True if the shape is bright"
        )
    return EmptyMaskError(
        f"no pixel of {name} is brighter than threshold={level:g}: the brightest is "
        f"{seen.high:.4g}; lower the threshold to between {seen.low:.4g} and "
        f"{seen.high:.4g}, or pass invert=True if the shape is dark on light ground"
    )


def _level(threshold: float) -> float:
    try:
        level = float(threshold)
    except (TypeError, ValueError):
        level = math.nan
    if not math.isfinite(level):
        raise ParameterError(f"threshold must be a finite number, not {threshold!r}")
    return level


def _blocks(
    pixels: NDArray[Any], scale: float
) -> Iterator[tuple[slice, FloatArray, BoolArray]]:
    """Yield rows of an image: which they are, their brightness, and what is visible."""
    channels = 1 if pixels.ndim == 2 else pixels.shape[2]
    step = max(1, _BLOCK // max(1, pixels.shape[1]))
    for top in range(0, len(pixels), step):
        rows = slice(top, top + step)
        block = pixels[rows].astype(np.float64).reshape(*pixels[rows].shape[:2], channels)
        visible = np.ones(block.shape[:2], np.bool_)
        if channels in (2, 4):
            visible = block[..., -1] > 0.5 * scale
        if channels >= 3:
            brightness = (block[..., :3] @ _LUMA) / (_LUMA.sum() * scale)
        else:
            brightness = block[..., 0] / scale
        yield rows, brightness, visible & ~np.isnan(brightness)


def _full_scale(pixels: NDArray[Any]) -> float:
    """Return the value that means white, or raise ParameterError where there is none."""
    channels = pixels.shape[2] if pixels.ndim == 3 else 1
    if pixels.ndim not in (2, 3) or not 1 <= channels <= 4:
        raise ParameterError(
            f"an image has shape (h, w), or (h, w, channels) with 1 to 4 channels, not "
            f"{pixels.shape}"
        )
    if pixels.size == 0:
        raise ParameterError(f"an image of shape {pixels.shape} has no pixels")
    if pixels.dtype.kind in "bf":
        return 1.0
    if pixels.dtype.kind not in "iu":
        raise ParameterError(f"an image holds numbers or bools, not {pixels.dtype}")
    if channels == 1 and pixels.max() <= 1 and pixels.min() >= 0:
        return 1.0
    if pixels.dtype.type not in (np.uint8, np.uint16):
        raise ParameterError(
            f"values of type {pixels.dtype} have no full scale that a threshold could be a "
            "part of; pass image.astype('uint8') if they go to 255, or the mask itself, "
            "such as image > 100"
        )
    return float(np.iinfo(pixels.dtype).max)


def _pixels(image: ImageLike) -> tuple[str, NDArray[Any]]:
    """Return what messages call the image, and its pixels."""
    if isinstance(image, str | os.PathLike):
        source = open_source(image)
        return source.name, _decoded(source)
    pillow = sys.modules.get("PIL.Image")
    if pillow is not None and isinstance(image, pillow.Image):
        with _translated("the image"):
            return "the image", _unpacked(image)
    try:
        return "the image", np.asarray(image)
    except ValueError as error:
        raise ParameterError(f"image is not an array of pixels: {error}") from error


def _decoded(source: Source) -> NDArray[Any]:
    """Return the pixels of an image file."""
    try:
        from PIL import Image
    except ImportError as error:
        raise MissingLibraryError.of("Pillow", "io", "reading images") from error
    with source.open() as file, _translated(source.name), Image.open(file) as image:
        return _unpacked(image)


@contextmanager
def _translated(name: str) -> Iterator[None]:
    """Turn what Pillow raises over a file into a FileReadError."""
    from PIL import Image, UnidentifiedImageError

    try:
        yield
    except ParameterError:
        raise
    except UnidentifiedImageError as error:
        raise FileReadError(f"{name} is not an image of a format that Pillow reads") from error
    except (Image.DecompressionBombError, Image.DecompressionBombWarning) as error:
        raise FileReadError(
            f"{name} is too large to be opened safely ({error}); shrink it, or, if you trust "
            "it, raise PIL.Image.MAX_IMAGE_PIXELS"
        ) from error
    # A damaged file makes Pillow's decoders fail with errors of almost any type.
    except Exception as error:
        raise FileReadError(
            f"{name} is damaged or cut off ({error}); save or copy it again"
        ) from error


def _unpacked(image: Image) -> NDArray[Any]:
    """Return the pixels of a PIL image as bool, uint8, uint16 or float32."""
    from PIL import ImageOps

    image = ImageOps.exif_transpose(image)
    mode = image.mode
    if mode == "I":
        return _sixteen_bits(np.asarray(image))
    if mode == "F" or mode.startswith("I;16"):
        return np.asarray(image)
    if mode in ("LA", "PA", "La", "RGBA", "RGBa") or "transparency" in image.info:
        return np.asarray(image.convert("RGBA"))
    if mode in ("1", "L", "RGB"):
        return np.asarray(image)
    return np.asarray(image.convert("RGB"))


def _sixteen_bits(pixels: NDArray[np.int32]) -> NDArray[np.uint16]:
    """Return the 16-bit values that Pillow keeps in 32 bits."""
    low, high = int(pixels.min(initial=0)), int(pixels.max(initial=0))
    if low < 0 or high > 65535:
        raise ParameterError(
            f"the image has 32-bit values, from {low} to {high}, without a full scale; pass "
            "the mask itself as an array, such as numpy.asarray(image) > 100000"
        )
    return pixels.astype(np.uint16)
