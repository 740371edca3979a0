"""``alphamesh animate``."""

from __future__ import annotations

from PIL import Image

from cli_tools import facts, ok, refused


def test_animate_writes_films(points):
    out = facts(
        "animate",
        "points.csv",
        "-o",
        "a.gif",
        "-o",
        "a.webp",
        "--frames",
        "3",
        "--width",
        "200",
    )
    assert out["frames"] == 3 == len(out["radii"])
    for name in ("a.gif", "a.webp"):
        with Image.open(name) as film:
            assert film.n_frames == 3
            assert film.size[0] == 200


def test_animate_takes_radii(points):
    said = ok("animate", "points.csv", "-o", "a.gif", "--radii", "5,10,20,40", "--width", "200")
    assert "5 to 40" in said
    with Image.open("a.gif") as film:
        assert film.n_frames == 4
    assert "even, quantiles, log" in refused(
        2, "animate", "points.csv", "-o", "a.gif", "--radii", "cubic"
    )
    assert "no finite radius" in refused(
        2, "animate", "points.csv", "-o", "a.gif", "--radii", "1,-2"
    )


def test_animate_tells_before_the_work_what_cannot_be_written(points, monkeypatch, folder):
    monkeypatch.setenv("PATH", str(folder))
    assert "ffmpeg" in refused(1, "animate", "no-such.csv", "-o", "a.mp4")
    assert ".gif, .webp, .mp4" in refused(2, "animate", "points.csv", "-o", "a.avi")
