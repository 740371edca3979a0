"""Masks from images: brightness, transparency, and files that are not images."""

from __future__ import annotations

import io
import struct
import sys
import zlib

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image

from alphamesh.errors import EmptyMaskError, FileReadError, MissingLibraryError, ParameterError
from alphamesh.io.images import read_mask, sample_mask

MASK = np.array([[0, 1, 1, 0], [0, 0, 1, 0], [1, 0, 0, 0]], dtype=bool)
GREY = (MASK * 255).astype(np.uint8)


def rgba(grey: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    return np.dstack([grey, grey, grey, alpha]).astype(np.uint8)


FORMS = {
    "bool": MASK,
    "uint8": GREY,
    "uint16": MASK.astype(np.uint16) * 65535,
    "float32": MASK.astype(np.float32),
    "float64": MASK * 0.7,
    "zeros and ones, int64": MASK.astype(int),
    "zeros and ones, uint8": MASK.astype(np.uint8),
    "list": MASK.tolist(),
    "one channel": GREY[..., np.newaxis],
    "grey and alpha": np.dstack([GREY, np.full_like(GREY, 255)]),
    "RGB": np.dstack([GREY, GREY, GREY]),
    "RGBA": rgba(GREY, np.full_like(GREY, 255)),
    "float RGB": np.dstack([MASK * 1.0] * 3),
    "big-endian": (MASK * 65535).astype(">u2"),
    "not contiguous": np.repeat(GREY, 2, axis=1)[:, ::2],
    "mode L": Image.fromarray(GREY),
    "mode 1": Image.fromarray(GREY).convert("1"),
    "mode P": Image.fromarray(GREY).convert("P"),
    "mode LA": Image.fromarray(GREY).convert("LA"),
    "mode RGBA": Image.fromarray(GREY).convert("RGBA"),
    "mode CMYK": Image.fromarray(GREY).convert("RGB").convert("CMYK"),
    "mode F": Image.fromarray(MASK.astype(np.float32)),
    "mode I": Image.fromarray(MASK.astype(np.int32) * 65535),
    "mode I;16": Image.fromarray(MASK.astype(np.uint16) * 65535),
    "mode L, zeros and ones": Image.fromarray(MASK.astype(np.uint8)),
}


@pytest.mark.parametrize("form", FORMS)
def test_the_same_mask_in_any_form(form):
    assert np.array_equal(read_mask(FORMS[form]), MASK)
    assert np.array_equal(read_mask(FORMS[form], invert=True), ~MASK)


@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("a.png", {}),
        ("a.bmp", {}),
        ("a.gif", {}),
        ("a.tif", {}),
        ("a.webp", {"lossless": True}),
        ("a.pgm", {}),
        ("A.PNG", {}),
    ],
)
def test_files_of_many_formats(tmp_path, name, options):
    Image.fromarray(GREY).save(tmp_path / name, **options)
    assert np.array_equal(read_mask(tmp_path / name), MASK)
    assert np.array_equal(read_mask(str(tmp_path / name)), MASK)


def test_sixteen_bit_files(tmp_path):
    for name in ("a.png", "a.tif"):
        Image.fromarray(MASK.astype(np.uint16) * 40000).save(tmp_path / name)
        assert np.array_equal(read_mask(tmp_path / name), MASK)
        with pytest.raises(EmptyMaskError, match=r"the brightest is 0\.6104"):
            read_mask(tmp_path / name, threshold=0.7)


def test_points_of_a_file_are_drawn_with_y_up(tmp_path):
    Image.fromarray(GREY).save(tmp_path / "a.png")
    points = sample_mask(tmp_path / "a.png", 4, jitter=False, seed=0)
    assert sorted(points.tolist()) == [[0, 0], [1, 2], [2, 1], [2, 2]]


def test_sampling_hands_its_choices_on():
    again = [sample_mask(GREY, 50, seed=5) for _ in range(2)]
    assert np.array_equal(*again)
    assert len(np.unique(sample_mask(GREY, 50, jitter=False, replace=True), axis=0)) == 4
    dark = sample_mask(GREY, 8, jitter=False, invert=True)
    assert [0, 2] in dark.tolist()
    with pytest.raises(ParameterError, match="n=5 exceeds the 4 chosen pixels"):
        sample_mask(GREY, 5, jitter=False)
    with pytest.raises(ParameterError, match="n must be an integer"):
        sample_mask(GREY, 0)
    with pytest.raises(ParameterError, match="seed must be"):
        sample_mask(GREY, 1, seed="x")


@given(st.integers(0, 255), st.floats(0, 1))
def test_grey_is_as_bright_in_one_channel_as_in_three(value, threshold):
    levels = np.array([[0, value, 255]], dtype=np.uint8)
    expected = np.array([[0.0, value / 255, 1.0]]) > threshold
    for image in (levels, np.dstack([levels] * 3), levels.astype(np.uint16) * 257):
        if expected.any():
            assert np.array_equal(read_mask(image, threshold=threshold), expected)


def test_colours_are_weighted_by_the_eye():
    colours = np.array([[[255, 0, 0], [0, 255, 0], [0, 0, 255]]], dtype=np.uint8)
    assert read_mask(colours, threshold=0.25).tolist() == [[True, True, False]]
    assert read_mask(colours, threshold=0.5).tolist() == [[False, True, False]]
    assert read_mask(colours, threshold=0.11).all()


@pytest.mark.parametrize("invert", [False, True])
def test_transparent_pixels_are_never_chosen(tmp_path, invert):
    grey = np.full((1, 4), 0 if invert else 255)
    image = rgba(grey, np.array([[0, 127, 128, 255]]))
    Image.fromarray(image).save(tmp_path / "a.png")
    for form in (image, Image.fromarray(image), tmp_path / "a.png", image / 255.0):
        assert read_mask(form, invert=invert).tolist() == [[False, False, True, True]]


def test_a_transparent_palette_entry_is_not_chosen(tmp_path):
    image = Image.fromarray(GREY).convert("P")
    image.save(tmp_path / "a.png", transparency=int(np.asarray(image)[0, 1]))
    with pytest.raises(EmptyMaskError):
        read_mask(tmp_path / "a.png")
    assert np.array_equal(read_mask(tmp_path / "a.png", invert=True), ~MASK)


def test_nan_is_never_chosen():
    image = np.array([[np.nan, 0.0, 1.0]])
    assert read_mask(image).tolist() == [[False, False, True]]
    assert read_mask(image, invert=True).tolist() == [[False, True, False]]


def test_floats_are_compared_as_they_are():
    heights = np.array([[-5.0, 100.0, 2000.0]])
    assert read_mask(heights, threshold=99.5).tolist() == [[False, True, True]]
    assert read_mask(heights, threshold=-6).all()


def test_an_image_turned_by_its_exif_tag_is_read_as_it_is_shown(tmp_path):
    exif = Image.Exif()
    exif[0x0112] = 6  # to be turned clockwise by a quarter
    Image.fromarray(GREY).save(tmp_path / "a.png", exif=exif)
    assert np.array_equal(read_mask(tmp_path / "a.png"), np.rot90(MASK, -1))
    with Image.open(tmp_path / "a.png") as image:
        assert np.array_equal(read_mask(image), np.rot90(MASK, -1))


def test_large_images_are_read_in_blocks():
    image = np.random.default_rng(0).integers(0, 256, (1500, 1501, 3), dtype=np.uint8)
    brightness = image @ np.array([299, 587, 114]) / 255_000
    assert np.array_equal(read_mask(image, threshold=0.4), brightness > 0.4)


# Empty masks


@pytest.mark.parametrize(
    ("image", "options", "message"),
    [
        (
            GREY // 3,
            {},
            r"no pixel of the image is brighter than threshold=0\.5: the brightest is 0\.3333; "
            r"lower the threshold to between 0 and 0\.3333, or pass invert=True",
        ),
        (
            255 - GREY // 3,
            {"invert": True},
            r"no pixel of the image is as dark as threshold=0\.5: the darkest is 0\.6667; "
            r"raise the threshold to between 0\.6667 and 1, or leave out invert=True",
        ),
        (np.zeros_like(GREY), {}, "same brightness 0 everywhere, which is not above"),
        (np.zeros_like(MASK), {}, "same brightness 0 everywhere"),
        (np.ones_like(MASK), {"invert": True}, "same brightness 1 everywhere, which is above"),
        (rgba(GREY, 0 * GREY), {}, "shows nothing: every pixel is transparent or NaN"),
        (np.full((2, 2), np.nan), {}, "shows nothing: every pixel is transparent or NaN"),
    ],
)
def test_empty_masks_tell_what_there_is(image, options, message):
    with pytest.raises(EmptyMaskError, match=message):
        sample_mask(image, 5, **options)


# What is no image


@pytest.mark.parametrize(
    ("image", "message"),
    [
        (np.ones(5), r"shape \(h, w\), or \(h, w, channels\) .* not \(5,\)"),
        (np.ones((2, 2, 5)), "1 to 4 channels"),
        (np.ones((2, 2, 2, 2)), "1 to 4 channels"),
        (np.ones((0, 5)), r"shape \(0, 5\) has no pixels"),
        (np.ones((2, 2), dtype=complex), "holds numbers or bools, not complex128"),
        ([["a", "b"]], "holds numbers or bools"),
        ([[1, 2], [3]], "image is not an array of pixels"),
        (np.full((2, 2), 200), r"int64 have no full scale.*image\.astype\('uint8'\)"),
        (np.full((2, 2), -1, dtype=np.int8), "int8 have no full scale"),
        (Image.fromarray(np.full((2, 2), 10**6, np.int32)), "32-bit values, from 0 to 1000000"),
    ],
)
def test_arrays_that_are_no_image(image, message):
    with pytest.raises(ParameterError, match=message):
        read_mask(image)


@pytest.mark.parametrize("threshold", [np.nan, np.inf, "half", None])
def test_thresholds_that_are_no_number(threshold):
    with pytest.raises(ParameterError, match="threshold must be a finite number"):
        read_mask(GREY, threshold=threshold)


def test_a_threshold_in_grey_levels_is_explained():
    with pytest.raises(ParameterError, match=r"from 0 to 1, not 128; 128 of 255 is 0\.502"):
        read_mask(GREY, threshold=128)
    with pytest.raises(ParameterError, match=r"from 0 to 1, not -0\.1$"):
        read_mask(GREY, threshold=-0.1)


# Files that cannot be read


def png_header(width: int, height: int) -> bytes:
    """Return a PNG that claims a size and holds no pixels."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        check = zlib.crc32(kind + data)
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", check)

    size = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", size) + chunk(b"IDAT", b"") + chunk(b"IEND", b"")
    )


def test_files_that_are_no_images(tmp_path):
    path = tmp_path / "a.png"
    with pytest.raises(FileReadError, match=r"a\.png does not exist; check the name"):
        read_mask(path)
    path.write_bytes(b"")
    with pytest.raises(FileReadError, match=r"a\.png is empty"):
        read_mask(path)
    path.write_text("just text, and enough of it to be looked at")
    with pytest.raises(FileReadError, match=r"a\.png is not an image of a format that Pillow"):
        read_mask(path)
    with pytest.raises(FileReadError, match="is a folder; name a file in it"):
        read_mask(tmp_path)


def test_an_image_without_pillow(tmp_path, monkeypatch):
    (tmp_path / "a.png").write_bytes(png_header(2, 2))
    monkeypatch.setitem(sys.modules, "PIL", None)
    message = r'reading images needs Pillow.*pip install "alphamesh\[io\]"'
    with pytest.raises(MissingLibraryError, match=message):
        read_mask(tmp_path / "a.png")
    assert np.array_equal(read_mask(GREY), MASK)


def test_a_truncated_image(tmp_path):
    noise = np.random.default_rng(0).integers(0, 256, (64, 64), dtype=np.uint8)
    for name in ("a.png", "a.jpg", "a.tif", "a.bmp"):
        Image.fromarray(noise).save(tmp_path / name)
        whole = (tmp_path / name).read_bytes()
        (tmp_path / name).write_bytes(whole[: len(whole) // 2])
        with pytest.raises(FileReadError, match=rf"{name} is damaged or cut off \(.*copy it"):
            read_mask(tmp_path / name)
        with (
            Image.open(tmp_path / name) as image,
            pytest.raises(FileReadError, match="the image is damaged or cut off"),
        ):
            read_mask(image)


def test_an_image_that_claims_a_monstrous_size(tmp_path):
    path = tmp_path / "a.png"
    for side in (10_000, 60_000):  # where Pillow warns, and where it refuses
        path.write_bytes(png_header(side, side))
        with pytest.raises(FileReadError, match="is too large to be opened safely"):
            read_mask(path)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.integers(0, 2**32),
    st.sampled_from(["PNG", "GIF", "BMP", "TIFF", "JPEG", "WEBP", "PPM"]),
)
def test_damaged_images_give_a_mask_or_one_of_our_errors(tmp_path, seed, form):
    buffer = io.BytesIO()
    Image.fromarray(GREY.repeat(9, axis=0).repeat(9, axis=1)).save(buffer, form)
    damaged = bytearray(buffer.getvalue())
    rng = np.random.default_rng(seed)
    for _ in range(int(rng.integers(1, 6))):
        damaged[int(rng.integers(len(damaged)))] = int(rng.integers(256))
    (tmp_path / "a.img").write_bytes(damaged)
    try:
        mask = read_mask(tmp_path / "a.img")
    except (FileReadError, EmptyMaskError, ParameterError) as error:
        assert "a.img" in str(error) or "image" in str(error)
    else:
        assert mask.any()
