"""The file of a page: one, whole, and asking for nothing."""

from __future__ import annotations

import json
import re
import zlib

import numpy as np
import pytest

import alphamesh as am
from alphamesh.errors import FileWriteError, ParameterError
from alphamesh.view import page_text
from view_facts import packed


def test_the_page_is_one_file_that_asks_for_nothing(eight, tmp_path):
    eight.view(tmp_path / "page.html")
    text = (tmp_path / "page.html").read_text("utf-8")
    assert text.startswith("<!doctype html>")
    assert text.count("</html>") == text.count("</main>") == 1
    assert "default-src 'none'" in text
    addresses = set(re.findall(r"[a-z]+://[^\s\"'`]+", text))
    assert addresses <= {"http://www.w3.org/2000/svg"}
    assert not re.findall(r"<(?:script|link|img|iframe)[^>]*(?:src|href)=\"(?!data:,)", text)
    assert [file.name for file in tmp_path.iterdir()] == ["page.html"]


def test_the_page_starts_where_it_is_told(eight):
    def meta(**options):
        raw = zlib.decompress(packed(eight, **options))
        return json.loads(raw[4 : 4 + int.from_bytes(raw[:4], "little")])["meta"]

    choice = eight.choose_radius()
    assert meta()["radius"] == meta()["choice"]["radius"] == choice.radius
    assert (meta()["choice"]["low"], meta()["choice"]["high"]) == choice.interval
    assert meta(radius=7)["radius"] == 7
    assert meta(radius=np.inf)["radius"] == eight.critical_radii()[-1]
    assert meta(title="Two <rings>")["title"] == "Two <rings>"


def test_a_title_cannot_break_the_page(eight):
    text = page_text(eight.persistence(), None, title="</script><b>&")
    assert "<title>&lt;/script&gt;&lt;b&gt;&amp;</title>" in text
    assert text.count("</script>") == 2


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"radius": -1}, "0 or more"),
        ({"radius": "wide"}, "must be a number"),
        ({"title": 3}, "title must be text"),
    ],
)
def test_what_makes_no_sense_is_refused_before_a_file_is_there(
    eight, tmp_path, options, message
):
    with pytest.raises(ParameterError, match=message):
        eight.view(tmp_path / "page.html", **options)
    assert list(tmp_path.iterdir()) == []


def test_a_page_that_cannot_be_written_says_why(eight, tmp_path):
    with pytest.raises(FileWriteError, match="does not exist"):
        eight.view(tmp_path / "nowhere" / "page.html")


def test_a_hundred_thousand_points_weigh_less_than_15_mb(tmp_path):
    points = np.random.default_rng(1).random((100_000, 2))
    am.AlphaComplex(points).view(tmp_path / "page.html")
    assert (tmp_path / "page.html").stat().st_size < 15e6
