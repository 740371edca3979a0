"""Films: one frame for each radius, something new in each, valid files, no leftovers."""

from __future__ import annotations

import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("matplotlib")
pytest.importorskip("PIL")

from PIL import Image

import alphamesh as am
from alphamesh.errors import (
    DimensionError,
    FileWriteError,
    MissingLibraryError,
    ParameterError,
)
from alphamesh.film import FILM_FORMATS, film_radii
from alphamesh.film.gif import GifWriter, Palette
from alphamesh.film.radii import last_radius
from alphamesh.film.still import small_png
from alphamesh.film.writers import need_writer
from alphamesh.plot import GrowthView, GrowthViewBox, GrowthViewBox3D, plot_complex


@pytest.fixture(scope="module")
def alpha():
    return am.AlphaComplex(am.demo_cloud("eight", 120, seed=1))


@pytest.fixture(scope="module")
def pairs(alpha):
    return alpha.persistence()


def frames_of(path) -> list[np.ndarray]:
    with Image.open(path) as film:
        frames = []
        for number in range(film.n_frames):
            film.seek(number)
            frames.append(np.asarray(film.convert("RGB")).astype(int))
    return frames


def size_at(alpha, radius) -> int:
    return sum(int((values <= radius).sum()) for values in alpha.radii)


# Radii


@pytest.mark.parametrize("rule", ["even", "quantiles", "log", None])
@pytest.mark.parametrize("frames", [2, 17, 100])
def test_something_happens_in_every_frame(alpha, pairs, rule, frames):
    radii = film_radii(pairs, rule, frames)
    assert len(radii) == frames
    assert radii[0] == 0
    sizes = [size_at(alpha, radius) for radius in radii]
    assert (np.diff(sizes) > 0).all()
    assert np.isin(radii, alpha.critical_radii()).all()


def test_quantiles_add_as_many_simplices_each_time_and_log_grows_by_a_factor(alpha, pairs):
    sizes = [size_at(alpha, radius) for radius in film_radii(pairs, "quantiles", 20)]
    steps = np.diff(sizes[1:])
    assert steps.max() < 3 * np.median(steps)
    radii = film_radii(pairs, "log", 20)[1:]
    ratios = radii[6:] / radii[5:-1]
    assert ratios.max() < 1.5 * ratios.min()


def test_the_film_ends_when_holes_are_filled_and_gaps_closed(alpha, pairs):
    last = film_radii(pairs, "even", 30)[-1]
    assert last <= last_radius(pairs) < alpha.critical_radii()[-1]
    assert pairs.betti_numbers(last).tolist() == [1, 0]


def test_small_clouds_show_discs_that_grow_between_events():
    cx = am.AlphaComplex([[0, 0], [2, 0], [0, 3]])
    radii = film_radii(cx.persistence(), frames=30)
    assert len(radii) == 30
    assert (np.diff(radii) > 0).all()
    assert {1.0, 1.5} <= set(radii.tolist())
    for points in (np.empty((0, 2)), np.zeros((1, 2)), np.zeros((3, 2))):
        radii = film_radii(am.AlphaComplex(points).persistence(), frames=5)
        assert len(radii) == 5
        assert np.isfinite(radii).all()


def test_given_radii_are_taken_as_they_are(pairs):
    np.testing.assert_array_equal(film_radii(pairs, [3, 1, 2.5]), [3, 1, 2.5])


@pytest.mark.parametrize(
    ("radii", "frames", "said"),
    [
        ("sqrt", 10, "'even', 'quantiles', 'log'"),
        ([], 10, "list of numbers"),
        ([[1.0]], 10, "list of numbers"),
        (5.0, 10, "list of numbers"),
        ([1, -1], 10, "0 or more"),
        ([1, np.nan], 10, "0 or more"),
        ([1, np.inf], 10, "finite"),
        (None, 1, "at least 2"),
        (None, 2.5, "at least 2"),
    ],
)
def test_radii_that_make_no_film_are_refused(pairs, radii, frames, said):
    with pytest.raises(ParameterError, match=said):
        film_radii(pairs, radii, frames)


# Files


@pytest.mark.parametrize("suffix", [".gif", ".webp"])
def test_film_has_a_frame_for_each_radius(alpha, pairs, tmp_path, suffix):
    shares = []
    film = alpha.animate(
        tmp_path / f"grow{suffix}",
        frames=6,
        width=300,
        fps=5,
        hold=2,
        progress=shares.append,
    )
    frames = frames_of(film.path)
    assert len(frames) == 6 == len(film.radii)
    assert {frame.shape for frame in frames} == {(film.size[1], film.size[0], 3)}
    assert film.size[0] == 300
    for before, after in pairwise(frames):
        assert np.abs(before - after).max() > 60
    np.testing.assert_array_equal(film.betti, pairs.betti_numbers(film.radii))
    np.testing.assert_allclose(shares, np.arange(1, 7) / 6)
    assert [path.name for path in tmp_path.iterdir()] == [f"grow{suffix}"]


def test_frames_are_those_of_the_view(alpha, pairs, tmp_path):
    radii = [0.0, 20.0, 40.0]
    film = am.animate(pairs, tmp_path / "a.gif", radii=radii, width=300)
    view = GrowthView(pairs, (19.0, 40.8), width=300)
    assert view.size == film.size
    for frame, radius in zip(frames_of(film.path), radii, strict=True):
        drawn = view.picture(radius).astype(int)
        half = slice(None), slice(0, 150)  # the Betti curves show another range
        apart = np.abs(frame[half] - drawn[half])
        assert apart[30:-80].mean() < 2


def test_gif_plays_at_the_rate_asked_for_and_holds_the_last_frame(alpha, tmp_path):
    film = alpha.animate(tmp_path / "a.gif", frames=3, width=200, fps=4, hold=3)
    with Image.open(film.path) as image:
        stays = []
        for number in range(3):
            image.seek(number)
            stays.append(image.info["duration"])
        assert image.info["loop"] == 0
    assert stays == [250, 250, 3250]


def test_the_same_film_has_the_same_bytes(alpha, tmp_path):
    first, second = (
        alpha.animate(tmp_path / name, frames=3, width=200).path.read_bytes()
        for name in ("a.gif", "b.gif")
    )
    assert first == second


def test_filtrations_are_filmed_too_but_nothing_else(alpha, tmp_path):
    film = am.animate(alpha.filtration, tmp_path / "a.gif", frames=2, width=200)
    assert len(frames_of(film.path)) == 2
    with pytest.raises(ParameterError, match="not ndarray"):
        am.animate(alpha.points, tmp_path / "b.gif")


@pytest.mark.parametrize(
    "points", [np.empty((0, 2)), np.zeros((1, 2)), np.eye(2), np.zeros((3, 2))]
)
def test_degenerate_clouds_are_filmed(points, tmp_path):
    film = am.AlphaComplex(points).animate(tmp_path / "a.gif", frames=3, width=200)
    assert 1 <= len(frames_of(film.path)) <= 3


@pytest.mark.parametrize(
    ("option", "value"), [("fps", 0), ("fps", "fast"), ("hold", -1), ("width", 10)]
)
def test_options_out_of_range_are_refused(alpha, tmp_path, option, value):
    with pytest.raises(ParameterError, match=option):
        alpha.animate(tmp_path / "a.gif", **{option: value})


def test_unknown_extensions_list_the_known_ones(alpha, tmp_path):
    with pytest.raises(FileWriteError, match=r"\.gif, \.webp, \.mp4"):
        alpha.animate(tmp_path / "a.avi")
    assert FILM_FORMATS == (".gif", ".webp", ".mp4")


def test_an_interrupted_film_leaves_nothing(alpha, tmp_path):
    def interrupt(share):
        if share > 0.5:
            raise KeyboardInterrupt

    for suffix in (".gif", ".webp"):
        with pytest.raises(KeyboardInterrupt):
            alpha.animate(tmp_path / f"a{suffix}", frames=4, width=200, progress=interrupt)
    assert not list(tmp_path.iterdir())


# MP4, by an encoder that counts what it is given


def put_ffmpeg(folder: Path, monkeypatch, body: str) -> None:
    program = folder / "bin" / "ffmpeg"
    program.parent.mkdir()
    program.write_text(f"#!{sys.executable}\nimport sys\n{body}\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(program.parent))


def test_mp4_pipes_every_frame_into_ffmpeg(alpha, tmp_path, monkeypatch):
    put_ffmpeg(
        tmp_path,
        monkeypatch,
        "given = sys.stdin.buffer.read()\n"
        "open(sys.argv[-1], 'w').write(f'{len(given)} {sys.argv[1:]}')",
    )
    film = alpha.animate(tmp_path / "a.mp4", frames=3, width=200)
    width, height = film.size
    assert width % 2 == height % 2 == 0
    count, _, arguments = film.path.read_text().partition(" ")
    assert int(count) == 3 * 3 * width * height
    assert f"'{width}x{height}'" in arguments


def test_an_encoder_that_fails_is_quoted(alpha, tmp_path, monkeypatch):
    put_ffmpeg(tmp_path, monkeypatch, "sys.exit('no such codec')")
    with pytest.raises(FileWriteError, match=r"no such codec.*gif"):
        alpha.animate(tmp_path / "a.mp4", frames=3, width=200)
    assert [path.name for path in tmp_path.iterdir()] == ["bin"]


def test_without_ffmpeg_the_error_names_what_works(alpha, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(FileWriteError, match=r"ffmpeg.*not found.*\.gif or \.webp"):
        alpha.animate(tmp_path / "a.mp4")


def test_without_pillow_the_error_names_the_extra(monkeypatch):
    monkeypatch.setitem(sys.modules, "PIL", None)
    with pytest.raises(MissingLibraryError, match=r"alphamesh\[plot\]"):
        need_writer(".gif")


# Pieces


def test_palette_keeps_frequent_colours_and_is_near_for_others():
    rng = np.random.default_rng(0)
    noise = rng.integers(0, 256, (64, 64, 3), dtype=np.uint8)
    flat = np.full((64, 64, 3), (244, 214, 164), dtype=np.uint8)
    white = np.full((64, 64, 3), 255, dtype=np.uint8)
    palette = Palette([noise, flat, white])
    assert len(palette.colors) <= 255
    for picture in (flat, white):
        np.testing.assert_array_equal(palette.colors[palette.indices(picture)], picture)
    apart = palette.colors[palette.indices(noise)].astype(int) - noise
    assert np.abs(apart).mean() < 20


def test_gif_frames_that_do_not_change_are_kept(tmp_path):
    picture = np.full((20, 30, 3), 255, dtype=np.uint8)
    second = picture.copy()
    second[5:8, 9:12] = (255, 0, 0)
    with (tmp_path / "a.gif").open("wb") as target:
        writer = GifWriter(target, (30, 20), Palette([picture, second]))
        for shown in (picture, second, second, picture):
            writer.add(shown, 100)
        writer.finish()
    frames = frames_of(tmp_path / "a.gif")
    assert len(frames) == 4
    for frame, shown in zip(frames, (picture, second, second, picture), strict=True):
        np.testing.assert_array_equal(frame, shown)


def test_small_pngs_look_like_large_ones(alpha):
    figure = plot_complex(alpha.at(30.0)).figure
    small = small_png(figure, dpi=60)
    assert small.startswith(b"\x89PNG")
    assert len(small) < len(am.plot.figure_bytes(figure, dpi=60))


def test_memory_does_not_grow_with_the_number_of_frames(tmp_path):
    code = (
        "import resource, sys, alphamesh as am\n"
        "cx = am.AlphaComplex(am.demo_cloud('eight', 60, seed=1))\n"
        "def peak(frames):\n"
        "    cx.animate(sys.argv[1], frames=frames, width=480)\n"
        "    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss\n"
        "peak(5)\n"
        "print(peak(5), peak(30))"
    )
    pytest.importorskip("resource")
    done = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path / "a.gif")],
        check=True,
        capture_output=True,
        text=True,
    )
    few, many = (int(peak) for peak in done.stdout.split())
    unit = 1 if sys.platform == "darwin" else 1024
    # Twenty-five frames of more than half a megabyte each.
    assert (many - few) * unit < 8e6


# Periodic boxes


BOXES = {
    "plane": ((1, 1), False),
    "strip": ((None, 1), True),
    "space": ((1, 1, 1), False),
    "slab": ((1, 1, None), True),
}


@pytest.mark.parametrize("name", BOXES)
def test_films_of_periodic_boxes(name, tmp_path):
    periods, weighted = BOXES[name]
    rng = np.random.default_rng(3)
    weights = rng.random(25) / 30 if weighted else None
    cx = am.AlphaComplex(rng.random((25, len(periods))), periods=periods, weights=weights)
    film = cx.animate(tmp_path / "box.gif", frames=3, width=200)
    pairs = cx.persistence()
    assert film.betti.tolist() == pairs.betti_numbers(film.radii).tolist()
    # At the end all classes that stay have come, but for that of the whole box.
    assert film.betti[-1, 1] == len(pairs.essential[1])
    pictures = frames_of(film.path)
    assert len(pictures) == 3
    assert all(np.abs(b - a).sum() > 0 for a, b in pairwise(pictures))


def test_films_are_made_of_filtrations_of_boxes(tmp_path):
    cx = am.AlphaComplex([[0.1, 0.2], [0.5, 0.9]], periods=(1, 1))
    one = am.animate(cx.filtration, tmp_path / "a.gif", radii=[0.1, 0.4], width=200)
    two = am.animate(cx.persistence(), tmp_path / "b.gif", radii=[0.1, 0.4], width=200)
    assert one.path.read_bytes() == two.path.read_bytes()
    with pytest.raises(ParameterError, match="turn"):
        cx.animate(tmp_path / "c.gif", turn=20)
    with pytest.raises(DimensionError, match="in space"):
        GrowthViewBox3D(cx.persistence(), (0.1, 1))
    with pytest.raises(DimensionError, match="periodic box"):
        GrowthViewBox(am.AlphaComplex([[0.0, 1.0]]).persistence(), (0.1, 1))


def test_cells_of_a_film_of_a_box_are_whole(tmp_path):
    cx = am.AlphaComplex(np.random.default_rng(4).random((40, 2)), periods=(1, 1))
    view = GrowthViewBox(cx.persistence(), (0.01, 1.0), width=400)
    largest = max(values.max() for values in cx.radii)
    cells = am.restricted_voronoi(view._around, largest)
    inner = ((view._around.points >= 0) & (view._around.points < 1)).all(axis=1)
    assert inner.sum() == 40
    assert cells.area[inner].sum() == pytest.approx(1)
