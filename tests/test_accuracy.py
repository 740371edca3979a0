"""The accuracy benchmark judges rightly; what it finds is not asserted."""

from __future__ import annotations

import importlib
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("scipy")
ROOT = Path(__file__).resolve().parent.parent


@pytest.fixture(scope="module", autouse=True)
def root_on_path():
    """Make the folder `benchmarks` importable, wherever pytest was started."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(ROOT))
        yield


def module(name):
    return importlib.import_module(f"benchmarks.{name}")


def picture(*rows):
    return np.array([[letter == "#" for letter in row] for row in rows])


def test_betti_numbers_of_masks():
    betti_of = module("masks").betti_of
    assert betti_of(picture("###", "#.#", "###")) == (1, 1)
    assert betti_of(picture("#.#", "#.#", "#.#")) == (2, 0)
    assert betti_of(picture("##.", "##.", "..#")) is None  # corners touch
    assert betti_of(picture("#####", "#...#", "#.#.#", "#...#", "#####")) == (2, 1)


def test_room_is_how_far_a_mask_can_be_thickened_and_thinned():
    mask = np.zeros((60, 60), dtype=bool)
    mask[10:50, 10:50] = True
    mask[20:33, 20:33] = False  # a hole with 13 pixels across, 10 and 17 from the border
    thicker, thinner = module("masks").room(mask, (1, 1), 30)
    assert thicker == 6 and thinner == 4
    assert module("masks").room(mask, (1, 1), 3) == (3, 3)


def test_families_are_known_and_repeat_themselves():
    masks = module("masks")
    assert len(masks.FAMILIES) == len(masks.DEVELOPMENT) + len(masks.REPORT)
    for family in ("rings", "words"):
        one, betti = masks.draw_mask(family, 3, size=128)
        other, _ = masks.draw_mask(family, 3, size=128)
        assert np.array_equal(one, other) and masks.betti_of(one) == betti


def test_components_of_outliers_do_not_count():
    clouds = module("mask_clouds")
    shape = [[0, 0], [1, 0], [0, 1], [50, 0], [51, 0]]
    points = np.array([*shape, [100, 100], [101, 100], [2.5, 0]], dtype=float)
    cloud = clouds.MaskCloud.of(points, outliers=3)
    assert cloud.at(0.0) == (5, 0)
    assert cloud.at(0.6) == (2, 0)
    assert cloud.at(0.76) == (2, 0)  # an outlier joins a component
    assert cloud.at(1000.0) == (1, 0)
    assert clouds.MaskCloud.of(points).at(0.6) == (4, 0)
    assert cloud.succeeds((2, 0)) and not cloud.succeeds((2, 1))


@pytest.mark.parametrize("kind", ["uniform", "density", "noise", "outliers"])
def test_clouds_are_as_their_kind_says(kind):
    clouds = module("mask_clouds")
    mask = np.zeros((100, 100), dtype=bool)
    mask[20:80, 20:80] = True
    points = clouds.sample_cloud(mask, 2000, kind, np.random.default_rng(1))
    assert points.shape == (2000, 2)
    outside = np.count_nonzero((points < 20) | (points > 80)) > 0
    assert outside == (kind in {"noise", "outliers"})
    # The gradient of the density, whatever its direction.
    lean = np.hypot(*(points.mean(axis=0) - 50))
    assert (lean > 3) == (kind == "density")


def test_the_report_counts(tmp_path):
    accuracy = module("accuracy")
    right = frozenset({"topology"})
    outcomes = [
        accuracy.Outcome("rings", "uniform", 1000, True, True, True, right),
        accuracy.Outcome("rings", "uniform", 1000, True, False, False, frozenset()),
        accuracy.Outcome("rings", "uniform", 1000, False, False, True, right),
        accuracy.Outcome("rings", "noise", 300, True, True, True, right),
    ]
    text = accuracy.report(outcomes, "develop")
    assert "| uniform | 1,000 | 3 | 66.7 | **50.0** | 0.0 |" in text
    assert "| 33.3 | 100.0 |" in text
    assert "called 66.7 % of its answers clear, and 100.0 % of these" in text


def test_the_tool_measures_and_writes(tmp_path, capsys):
    accuracy = module("accuracy")
    outcomes = list(accuracy.measure(["rings"], [1], [300]))
    assert [o.kind for o in outcomes] == ["uniform", "density", "noise", "outliers"]
    assert all(o.right <= {"topology", *accuracy.RIVALS} for o in outcomes)
    assert all(o.possible for o in outcomes if set(accuracy.RIVALS) & o.right)
    page = tmp_path / "radius.md"
    page.write_text("<!-- benchmark:begin -->\n<!-- benchmark:end -->\n", encoding="utf-8")
    module("tables").replace_between_markers(page, accuracy.report(outcomes, "develop"))
    assert "| uniform |" in page.read_text(encoding="utf-8")
