"""The benchmark tool works and reports what it measured; no time is ever asserted."""

from __future__ import annotations

import importlib
import json
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parent.parent
BEFORE = "# A title\n\n<!-- benchmark:begin -->\n"
AFTER = "<!-- benchmark:end -->\n\nThe end.\n"
MARKED = f"{BEFORE}to be replaced\n{AFTER}"


@pytest.fixture(scope="module", autouse=True)
def root_on_path() -> Iterator[None]:
    """Make the folder `benchmarks` importable, wherever pytest was started."""
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(ROOT))
        yield


def module(name: str) -> ModuleType:
    return importlib.import_module(f"benchmarks.{name}")


def timing(job: str, cloud: str, size: int, median: float) -> Any:
    return module("results").Timing(job, cloud, size, 5, median, median / 2)


def made_up(**fields: Any) -> Any:
    """Return results with numbers that nobody measured."""
    described = {
        "date": "2000-01-01",
        "cpu": "Abacus",
        "cores": 2,
        "system": "Linux x86_64",
        "python": "3.11.0",
        "numpy": "2.0.0",
        "versions": {"alphamesh": "0.0.0"},
        "load": 0.0,
    }
    return module("results").Results(described, **fields)


def keeping_all_promises() -> Any:
    results = module("results")
    times = {"alphamesh": 1.0, "alphamesh-1": 2.0, "shull": 9.0, "shull-parallel": 4.0}
    timings = [
        timing(job, cloud, size, median)
        for job, median in times.items()
        for cloud in ("uniform", "grid", "pixels")
        for size in (1_000, 1_000_000)
    ]
    timings.append(timing("gudhi", "uniform", 1_000_000, 50.0))
    growth = [
        timing(job, "uniform", size, size * per_point)
        for job in ("alphamesh", "alphamesh-1")
        for size, per_point in ((100_000, 1.0), (1_000_000, 1.6), (10_000_000, 1.5))
    ]
    fresh = [
        results.FreshRun(job, cloud, 1_000_000, 300_000_000, 1.0)
        for job in ("alphamesh", "alphamesh-1")
        for cloud in ("uniform", "grid", "pixels")
    ]
    return made_up(timings=timings, growth=growth, fresh=fresh)


# -- the whole tool ------------------------------------------------------------------------


def test_tiny_run_measures_ours_and_writes_everything(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    if not Path("/proc/self/status").exists():
        pytest.importorskip("psutil")
    docs, readme = tmp_path / "docs", tmp_path / "README.md"
    docs.mkdir()
    readme.write_text(MARKED, encoding="utf-8")
    (docs / "benchmarks.md").write_text(MARKED, encoding="utf-8")
    saved = tmp_path / "results.json"
    arguments = [
        "--tiny",
        "--growth",
        "--quiet",
        "--clouds",
        "uniform,grid",
        "--peers",
        "scipy",
    ]
    arguments += ["--json", str(saved), "--write-docs", str(docs), "--update", str(readme)]

    assert module("__main__").main(arguments) == 0

    raw = json.loads(saved.read_text(encoding="utf-8"))
    cells = {(t["job"], t["cloud"], t["size"]) for t in raw["timings"]}
    ours = ("alphamesh", "alphamesh-1", "alphamesh-delaunay")
    clouds = ("uniform", "grid")
    assert cells >= {(j, c, n) for j in ours for c in clouds for n in (200, 1_000)}
    assert all(0 < t["minimum"] <= t["median"] for t in raw["timings"] + raw["growth"])
    assert all(t["calls"] >= 2 for t in raw["timings"])
    assert {(t["job"], t["size"]) for t in raw["growth"]} == {
        (job, size) for job in ours for size in (200, 1_000)
    }
    assert {run["job"] for run in raw["fresh"]} >= set(ours)
    assert all(run["peak"] >= 0 and run["seconds"] > 0 for run in raw["fresh"])
    assert raw["import_seconds"]["import alphamesh"] > 0
    assert raw["skipped"] == []
    assert raw["machine"]["cores"] >= 1

    assert (docs / "benchmarks.svg").read_text(encoding="utf-8").rstrip().endswith("</svg>")
    for file in (readme, docs / "benchmarks.md"):
        text = file.read_text(encoding="utf-8")
        assert text.startswith(BEFORE)
        assert text.endswith(f"\n{AFTER}")
        assert "**`alphamesh.filtration(P)`**" in text
        assert "to be replaced" not in text

    # The saved results render to the same text without measuring again.
    again = tmp_path / "again.md"
    module("__main__").main(["--load", str(saved), "--output", str(again)])
    assert again.read_text(encoding="utf-8").strip() in (docs / "benchmarks.md").read_text(
        encoding="utf-8"
    )


def test_machine_is_described_without_paths() -> None:
    described = module("machine").describe(["alphamesh", "scipy"])
    assert set(described) == set(made_up().machine)
    text = json.dumps(described)
    assert str(Path.home()) not in text
    assert str(ROOT) not in text


def test_unknown_names_and_sizes_are_refused(capsys: pytest.CaptureFixture[str]) -> None:
    for arguments, message in (
        (["--clouds", "torus"], "torus is none of uniform"),
        (["--jobs", "qhull"], "qhull is none of alphamesh"),
        (["--sizes", "1k,many"], "is no number of points"),
    ):
        with pytest.raises(SystemExit) as error:
            module("__main__").main(arguments)
        assert error.value.code == 2
        assert message in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "sizes"),
    [("1k", [1_000]), ("10M,2k", [2_000, 10_000_000]), ("1_500", [1_500]), ("1e4", [10_000])],
)
def test_sizes_are_read(text: str, sizes: list[int]) -> None:
    assert module("__main__")._sizes(text) == sizes


# -- clouds and jobs -----------------------------------------------------------------------


@pytest.mark.parametrize("n", [1, 7, 1_000, 12_345])
@pytest.mark.parametrize("name", ["uniform", "clusters", "grid", "pixels", "circle"])
def test_clouds_have_n_distinct_points_and_repeat(name: str, n: int) -> None:
    clouds = module("clouds")
    points = clouds.make_cloud(name, n)
    assert points.shape == (n, 2)
    assert points.dtype == np.float64
    assert points.flags.c_contiguous
    assert points.flags.writeable
    assert len(np.unique(points, axis=0)) == n
    assert np.array_equal(points, clouds.make_cloud(name, n))


def test_pixels_have_holes() -> None:
    points = module("clouds").make_cloud("pixels", 20_000)
    middle = points.max(axis=0) / 2
    assert np.hypot(*(points - middle).T).min() > 5
    assert np.array_equal(points, np.rint(points))


def test_all_jobs_triangulate_alike() -> None:
    """What is compared is comparable: as many triangles in general position."""
    jobs = module("jobs")
    runs, left_out = jobs.available(jobs.JOBS)
    assert set(runs) | set(left_out) == set(jobs.JOBS)
    points = module("clouds").make_cloud("uniform", 300)
    counts = {}
    for name, run in runs.items():
        result = run(points)
        if name == "gudhi":
            counts[name] = sum(len(simplex) == 3 for simplex, _ in result.get_simplices())
        elif name == "diode":
            vertices = result[0] if isinstance(result, tuple) else [v for v, _ in result]
            counts[name] = (
                len(vertices[2])
                if isinstance(result, tuple)
                else sum(len(simplex) == 3 for simplex in vertices)
            )
        elif name in ("alphamesh", "alphamesh-1"):
            counts[name] = len(result.simplices[2])
        elif name == "alphamesh-delaunay":
            counts[name] = len(result.triangles)
        else:
            counts[name] = len(result.simplices)
    assert len(set(counts.values())) == 1, counts


def test_missing_peer_is_left_out_with_a_reason(monkeypatch: pytest.MonkeyPatch) -> None:
    jobs = module("jobs")
    monkeypatch.setitem(importlib.import_module("sys").modules, "gudhi", None)
    runs, left_out = jobs.available(["alphamesh", "gudhi"])
    assert list(runs) == ["alphamesh"]
    assert "gudhi cannot be imported" in left_out["gudhi"]


# -- timing --------------------------------------------------------------------------------


def test_contestants_take_turns_in_rotated_order() -> None:
    timing_module = module("timing")
    calls: list[str] = []
    # Expected to be slow: no warm-up, one call a turn.
    slow = dict.fromkeys("ABC", 10.0)
    contestants = {name: (lambda name=name: calls.append(name)) for name in "ABC"}
    rounds = timing_module.Rounds(least=4, seconds=0.0)
    turns = timing_module.interleave(contestants, rounds, slow)
    assert "".join(calls) == "ABCBCACABABC"
    assert {key: len(samples) for key, samples in turns.samples.items()} == dict.fromkeys(
        "ABC", 4
    )


def test_contestant_leaves_when_its_budget_is_spent() -> None:
    timing_module = module("timing")
    calls: list[int] = []
    rounds = timing_module.Rounds(least=5, seconds=0.0, budget=0.0)
    turns = timing_module.interleave({"A": lambda: calls.append(1)}, rounds, {"A": 10.0})
    assert calls == []
    assert turns.samples == {"A": []}


def test_failing_contestant_leaves_and_is_reported() -> None:
    timing_module = module("timing")

    def fail() -> None:
        raise ValueError("too flat")

    rounds = timing_module.Rounds(least=2, seconds=0.0)
    turns = timing_module.interleave({"A": fail, "B": list}, rounds)
    assert str(turns.failures["A"]) == "too flat"
    assert turns.samples["A"] == []
    assert len(turns.samples["B"]) >= 2


@pytest.mark.parametrize(
    ("history", "size", "expected"),
    [
        ({}, 1_000, 0.0),
        ({1_000: 2.0}, 10_000, 200.0),  # quadratic until two sizes are known
        ({1_000: 1.0, 10_000: 10.0}, 100_000, 100.0),
        ({1_000: 1.0, 10_000: 100.0}, 100_000, 10_000.0),
        ({1_000: 1.0, 10_000: 1.0}, 100_000, 10.0),  # never less than linear
        ({1_000: 1.0, 10_000: 10.0, 100_000: 7.0}, 100_000, 100.0),  # smaller sizes only
    ],
)
def test_forecast(history: dict[int, float], size: int, expected: float) -> None:
    assert module("timing").forecast(history, size) == pytest.approx(expected)


def test_job_beyond_the_budget_is_skipped_with_its_forecast() -> None:
    plan, results = module("plan"), made_up()
    waits: list[int] = []

    def quadratic(points: np.ndarray) -> None:
        waits.append(len(points))
        importlib.import_module("time").sleep((len(points) / 1e4) ** 2 * 0.02)

    cells = [plan.Cell("uniform", 100_000, ("scipy",))]
    rounds = module("timing").Rounds(least=1, seconds=0.0, budget=0.1)
    plan.measure_times(cells, {"scipy": quadratic}, rounds, results, lambda _: None)
    assert max(waits) == 10_000
    assert results.timings == []
    assert "more than the budget" in results.skipped[0].reason


# -- reports -------------------------------------------------------------------------------


def test_readme_table_shows_medians_and_minima() -> None:
    timings = [timing("alphamesh", "grid", 1_000, 0.0004), timing("shull", "grid", 1_000, 1.25)]
    text = module("tables").readme_table(made_up(timings=timings, left_out={"gudhi": "absent"}))
    assert "| 1,000 points, ms: median (min) | filtration | grid |" in text
    assert "| **`alphamesh.filtration(P)`** | yes | 0.400 (0.200) |" in text
    assert "| `shull.Delaunay(P)` | no | 1,250 (625) |" in text
    assert "Abacus" in text
    assert "Left out: gudhi." in text


def test_ratios_are_against_the_better_shull() -> None:
    times = {"alphamesh": 1.0, "alphamesh-1": 3.0, "shull": 4.0, "shull-parallel": 2.0}
    timings = [timing(job, "grid", 10, median) for job, median in times.items()]
    text = module("tables").full_report(made_up(timings=timings))
    assert "| 10 | grid | 0.50 | 1.50 | - | - |" in text


def test_update_needs_markers_and_leaves_other_files_alone(tmp_path: Path) -> None:
    file = tmp_path / "README.md"
    file.write_text("no markers\n", encoding="utf-8")
    with pytest.raises(SystemExit, match="has no lines <!-- benchmark:begin -->"):
        module("tables").replace_between_markers(file, "new")
    assert file.read_text(encoding="utf-8") == "no markers\n"
    with pytest.raises(SystemExit, match="does not exist"):
        module("tables").replace_between_markers(tmp_path / "absent.md", "new")


def test_documentation_has_the_markers() -> None:
    text = (ROOT / "docs" / "benchmarks.md").read_text(encoding="utf-8")
    assert text.count("<!-- benchmark:begin -->") == text.count("<!-- benchmark:end -->") == 1


def test_results_survive_json(tmp_path: Path) -> None:
    results, file = keeping_all_promises(), tmp_path / "results.json"
    module("results").write_results(results, file)
    assert module("results").read_results(file) == results


# -- verdict -------------------------------------------------------------------------------


def test_verdict_passes_at_the_limits() -> None:
    text, passed = module("verdict").verdict_text(keeping_all_promises())
    assert passed, text
    assert "FAIL" not in text


@pytest.mark.parametrize(
    ("field", "job", "size"),
    [
        ("timings", "alphamesh", 1_000),
        ("timings", "alphamesh-1", 1_000_000),
        ("fresh", "alphamesh", 1_000_000),
        ("growth", "alphamesh", 10_000_000),
    ],
)
def test_verdict_fails_when_one_number_is_missing(field: str, job: str, size: int) -> None:
    results = keeping_all_promises()
    kept = [r for r in getattr(results, field) if (r.job, r.size) != (job, size)]
    assert len(kept) < len(getattr(results, field))
    setattr(results, field, kept)
    text, passed = module("verdict").verdict_text(results)
    assert not passed
    assert "not measured" in text


def test_verdict_fails_when_one_number_is_too_large() -> None:
    results = keeping_all_promises()
    results.timings = [
        timing("alphamesh", "grid", 1_000_000, 1.5)
        if (t.job, t.cloud, t.size) == ("alphamesh", "grid", 1_000_000)
        else t
        for t in results.timings
    ]
    text, passed = module("verdict").verdict_text(results)
    assert not passed
    failed = [line for line in text.splitlines() if line.startswith("FAIL")]
    assert len(failed) == 1
    assert "1,000,000 points, grid: ours / best of shull: 0.375" in failed[0]


def test_verdict_of_made_up_results_sets_the_exit_code(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    main, file = module("__main__").main, tmp_path / "results.json"
    module("results").write_results(keeping_all_promises(), file)
    assert main(["--load", str(file), "--verdict", "--quiet"]) == 0
    module("results").write_results(made_up(), file)
    assert main(["--load", str(file), "--verdict", "--quiet"]) == 1
    assert "not measured" in capsys.readouterr().out


# -- persistence ---------------------------------------------------------------------------


def test_tiny_run_of_persistence_measures_the_plane_and_space(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert module("persistence").main(["--tiny"]) == 0
    out = capsys.readouterr().out
    for where in ("in the plane", "in space"):
        assert f"points {where}: filtration and pairs (ms, median)" in out
        assert f"\n{where} (microseconds per point, median)" in out
    # With gudhi, diagrams are compared, too; times of small clouds promise nothing.
    verdicts = [line for line in out.splitlines() if line.startswith(("pass", "FAIL"))]
    assert len(verdicts) == (0 if "gudhi is not installed" in out else 2)
    assert all("difference of deaths" in line for line in verdicts)


def test_a_difference_from_gudhi_is_no_pass(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("gudhi")
    persistence = module("persistence")
    monkeypatch.setattr(persistence, "_difference", lambda *_: 0.1)
    assert persistence.main(["--tiny", "--columns", "2"]) == 1
