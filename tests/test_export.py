"""Exports: gudhi's simplex trees, dicts of arrays, files."""

from __future__ import annotations

import sys

import numpy as np
import pytest
from hypothesis import given

import alphamesh as am
from alphamesh.errors import FileWriteError, MissingLibraryError
from complexes import complexes

gudhi = pytest.importorskip("gudhi")

NAMES = (
    *("points", "representative", "vertices", "edges", "triangles"),
    *("vertex_radii", "edge_radii", "triangle_radii"),
)


@given(complexes())
def test_a_simplex_tree_has_our_simplices_and_values(cx):
    tree = cx.to_gudhi()
    found = {tuple(simplex): value for simplex, value in tree.get_filtration()}
    expected = {
        tuple(row): value
        for rows, radii in zip(cx.simplices, cx.radii, strict=True)
        for row, value in zip(rows.tolist(), radii.tolist(), strict=True)
    }
    assert found == expected
    assert tree.make_filtration_non_decreasing() is False  # it already was


def test_squared_values_are_those_of_gudhi():
    points = np.random.default_rng(2).random((60, 2))
    ours = am.AlphaComplex(points).to_gudhi(squared=True)
    theirs = gudhi.AlphaComplex(points=points, precision="exact").create_simplex_tree()
    # Their vertices are numbered as ours.
    mine = {tuple(simplex): value for simplex, value in ours.get_filtration()}
    yours = {tuple(simplex): value for simplex, value in theirs.get_filtration()}
    assert mine.keys() == yours.keys()
    assert np.allclose([mine[k] for k in yours], list(yours.values()), rtol=1e-9, atol=1e-15)


def test_gudhi_finds_the_pairs_that_we_find():
    cx = am.AlphaComplex(am.demo_cloud("eight", 400, seed=2))
    tree = cx.to_gudhi()
    tree.compute_persistence(homology_coeff_field=2)
    for k in (0, 1):
        theirs = np.array(tree.persistence_intervals_in_dimension(k))
        theirs = theirs[np.lexsort((theirs[:, 1], theirs[:, 0]))]
        assert np.array_equal(theirs, cx.persistence().diagram(k))


def test_simplices_of_space_are_exported_too():
    cx = am.AlphaComplex(np.random.default_rng(3).random((40, 3)))
    tree = cx.to_gudhi(squared=True)
    theirs = gudhi.AlphaComplex(points=cx.points, precision="exact").create_simplex_tree()
    mine = {tuple(simplex): value for simplex, value in tree.get_filtration()}
    yours = {tuple(simplex): value for simplex, value in theirs.get_filtration()}
    assert mine.keys() == yours.keys() and tree.dimension() == 3
    assert np.allclose([mine[k] for k in yours], list(yours.values()), rtol=1e-9, atol=1e-15)
    arrays = cx.to_numpy()
    assert arrays["tetrahedra"] is cx.simplices[3]
    assert arrays["tetrahedron_radii"] is cx.radii[3]


def test_a_missing_gudhi_is_told(monkeypatch):
    monkeypatch.setitem(sys.modules, "gudhi", None)
    with pytest.raises(
        MissingLibraryError, match=r"simplex tree needs gudhi.*alphamesh\[gudhi"
    ):
        am.AlphaComplex([[0, 0], [1, 0]]).to_gudhi()


@given(complexes())
def test_a_dict_has_every_array(cx):
    arrays = cx.to_numpy()
    assert tuple(arrays) == NAMES
    assert arrays["points"] is cx.points
    for k, name in enumerate(("vertices", "edges", "triangles")):
        assert arrays[name] is cx.simplices[k]
        assert arrays[NAMES[5 + k]] is cx.radii[k]


def test_a_file_has_every_array(tmp_path):
    cx = am.AlphaComplex(am.demo_cloud("disc", 200, seed=1))
    path = tmp_path / "disc.npz"
    cx.save_npz(path)
    with np.load(path, allow_pickle=False) as read:
        assert sorted(read.files) == sorted(NAMES)
        for name, array in cx.to_numpy().items():
            assert np.array_equal(read[name], array) and read[name].dtype == array.dtype


def test_a_file_is_written_whole_or_not_at_all(tmp_path, monkeypatch):
    cx = am.AlphaComplex([[0, 0], [1, 0], [0, 1]])
    path = tmp_path / "old.npz"
    path.write_bytes(b"old")

    def fail(file, **arrays):
        file.write(b"half")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(np, "savez", fail)
    with pytest.raises(FileWriteError, match=r"old\.npz"):
        cx.save_npz(path)
    assert path.read_bytes() == b"old" and [p.name for p in tmp_path.iterdir()] == ["old.npz"]
    with pytest.raises(FileWriteError, match="does not exist"):
        cx.save_npz(tmp_path / "no" / "folder.npz")
