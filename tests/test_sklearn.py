"""The transformer in scikit-learn's hands."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

import alphamesh as am
from alphamesh.errors import CloudError, ParameterError

sklearn = pytest.importorskip("sklearn")

from sklearn.base import clone  # noqa: E402
from sklearn.linear_model import LogisticRegression  # noqa: E402
from sklearn.model_selection import GridSearchCV  # noqa: E402
from sklearn.pipeline import make_pipeline  # noqa: E402
from sklearn.preprocessing import FunctionTransformer  # noqa: E402

from alphamesh.sklearn import PersistenceTransformer  # noqa: E402

RNG = np.random.default_rng(8)
CLOUDS = [RNG.random((n, 2)) for n in (30, 7, 50, 1, 0)]


def expected(cloud, dimension, **options):
    return am.AlphaComplex(cloud).persistence().diagram(dimension, **options)


@pytest.mark.parametrize("n_jobs", [None, 1, 2])
@pytest.mark.parametrize("squared", [False, True])
def test_diagrams_are_those_of_persistence(n_jobs, squared):
    made = PersistenceTransformer(n_jobs=n_jobs, squared=squared).fit_transform(CLOUDS)
    assert len(made) == len(CLOUDS)
    for cloud, diagrams in zip(CLOUDS, made, strict=True):
        assert len(diagrams) == 2
        for k, diagram in enumerate(diagrams):
            assert np.array_equal(diagram, expected(cloud, k, squared=squared))


def test_one_dimension_gives_one_array_each():
    loops = PersistenceTransformer(1).transform(CLOUDS)
    assert all(np.array_equal(a, expected(c, 1)) for a, c in zip(loops, CLOUDS, strict=True))
    (first, *_) = PersistenceTransformer([1]).transform(CLOUDS)
    assert isinstance(first, list) and np.array_equal(first[0], loops[0])


def test_what_never_dies_can_be_left_out():
    (kept, *_) = PersistenceTransformer(0).transform(CLOUDS)
    (finite, *_) = PersistenceTransformer(0, essential=False).transform(CLOUDS)
    assert len(kept) == 30 and len(finite) == 29
    assert np.array_equal(finite, kept[np.isfinite(kept[:, 1])])


def test_giotto_format_is_one_array_filled_up_on_the_diagonal():
    made = PersistenceTransformer((0, 1), format="giotto").fit_transform(CLOUDS)
    counts = [[len(expected(c, k)) for c in CLOUDS] for k in (0, 1)]
    assert made.shape == (len(CLOUDS), max(counts[0]) + max(counts[1]), 3)
    for i, cloud in enumerate(CLOUDS):
        for k in (0, 1):
            rows = made[i][made[i][:, 2] == k]
            assert len(rows) == max(counts[k])
            true, filled = rows[: counts[k][i], :2], rows[counts[k][i] :, :2]
            assert np.array_equal(true, expected(cloud, k))
            assert (filled[:, 0] == filled[:, 1]).all()
    assert PersistenceTransformer(format="giotto").transform([]).shape == (0, 0, 3)


def test_it_can_be_cloned_and_searched():
    made = PersistenceTransformer((1,), squared=True, format="giotto", n_jobs=2)
    again = clone(made)
    assert again is not made and again.get_params() == made.get_params()
    assert again.set_params(dimensions=0).dimensions == 0
    assert made.dimensions == (1,)
    assert "squared=True" in repr(made)


def longest(diagrams):
    return np.array([[(d[:, 1] - d[:, 0]).max(initial=0.0)] for d in diagrams])


def test_it_works_in_a_pipeline():
    names = ["disc", "annulus"] * 8
    clouds = [am.demo_cloud(name, 150, seed=i) for i, name in enumerate(names)]
    labels = np.arange(16) % 2
    steps = make_pipeline(
        PersistenceTransformer(1), FunctionTransformer(longest), LogisticRegression()
    )
    assert steps.fit(clouds[:10], labels[:10]).score(clouds[10:], labels[10:]) == 1.0
    search = GridSearchCV(steps, {"persistencetransformer__squared": [False, True]}, cv=2)
    assert search.fit(clouds, labels).best_score_ == 1.0


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"dimensions": 3}, "dimensions must be 0"),
        ({"dimensions": ()}, "dimensions must be 0"),
        ({"dimensions": "loops"}, "dimensions must be 0"),
        ({"dimensions": (0, True)}, "dimensions must be 0"),
        ({"dimensions": None}, "dimensions must be 0"),
        ({"format": "persim"}, "format must be one of"),
    ],
)
def test_wrong_parameters_are_told(parameters, message):
    with pytest.raises(ParameterError, match=message):
        PersistenceTransformer(**parameters).fit(CLOUDS)


def test_a_wrong_cloud_is_told():
    with pytest.raises(CloudError):
        PersistenceTransformer().transform([[[0.0, np.nan]]])


def test_without_scikit_learn_the_extra_is_named():
    code = (
        "import sys; sys.modules['sklearn'] = None\n"
        "import alphamesh.errors\n"
        "try:\n    import alphamesh.sklearn\n"
        "except alphamesh.errors.MissingLibraryError as error: print(error)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    assert 'pip install "alphamesh[sklearn]"' in done.stdout
