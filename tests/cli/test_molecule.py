"""``alphamesh molecule``."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import numpy as np
import pytest

import alphamesh as am
from cli_tools import facts, ok, refused

pytest.importorskip("gemmi")


@pytest.fixture
def villin(folder):
    found = importlib.util.find_spec("openmm")
    if found is None:
        pytest.skip("openmm is not installed, which ships a protein")
    data = (Path(found.origin).parent / "app" / "data" / "test.pdb").read_bytes()
    Path("villin.pdb").write_bytes(data)
    return data


def test_measures_and_the_table_of_atoms(villin):
    out = facts("molecule", "villin.pdb", "--probe", "1.4", "-o", "a.csv", "-o", "a.npz")
    molecule = am.read_molecule("villin.pdb")
    weights = molecule.weights(1.4)
    found = am.AlphaComplex(molecule.points, weights=weights).union(0)
    assert out["atoms"] == 584
    assert out["elements"] == {"C": 189, "Cl": 2, "H": 293, "N": 49, "O": 50, "S": 1}
    assert (out["volume"], out["surface_area"]) == (found.volume, found.surface_area)
    assert out["buried_atoms"] == np.count_nonzero(found.ball_surface_areas == 0)
    table = np.genfromtxt("a.csv", delimiter=",", names=True, dtype=None, encoding=None)
    np.testing.assert_array_equal(table["volume"], found.ball_volumes)
    np.testing.assert_array_equal(table["surface_area"], found.ball_surface_areas)
    assert table["element"].tolist() == molecule.elements.tolist()
    with np.load("a.npz") as arrays:
        np.testing.assert_array_equal(arrays["radius"], molecule.radii)


def test_what_people_read(villin):
    text = ok("molecule", "villin.pdb", "--no-hetero", "--no-hydrogens", "-q")
    assert "289: 189 C, 49 N, 50 O, 1 S" in text
    assert "Å³" in text
    assert "none" in text
    told = ok("molecule", "-", "-q", "--radius", "h=1.2", stdin=villin)
    assert "584: 189 C" in told
    assert ok("molecule", "villin.pdb", "-q", "-o", "-").startswith("row,chain,residue,")
    ok("molecule", "villin.pdb", "-q", "--plot", "a.png")
    assert Path("a.png").read_bytes().startswith(b"\x89PNG")


def test_voids_are_told(villin):
    found = facts("molecule", "villin.pdb")["voids"]
    assert [sorted(void) for void in found] == [["surface_area", "volume"]] * len(found)
    assert len(found) == 1
    assert "1, of 3.59506e-05 Å³" in ok("molecule", "villin.pdb", "-q")


def test_what_is_refused(villin):
    Path("x.pdb").write_text(
        "HETATM    1  X1  UNK A   7      20.000   0.000   0.000  1.00  0.00           X\n"
    )
    assert "no van der Waals radius is known for X" in refused(1, "molecule", "x.pdb")
    assert "(row 0); pass --radius X=" in refused(1, "molecule", "x.pdb")
    assert facts("molecule", "x.pdb", "--radius", "X=2")["atoms"] == 1
    assert "is not an element and a radius" in refused(
        2, "molecule", "x.pdb", "--radius", "Fe=a"
    )
    assert "model must be a whole number from 1 to 1" in refused(
        2, "molecule", "x.pdb", "--model", "2"
    )
    assert "does not exist" in refused(1, "molecule", "none.pdb")


def test_atoms_as_points(villin):
    out = facts("mesh", "villin.pdb", "--weights", "weight", "-o", "a.ply")
    assert out["points"] == 584
    assert Path("a.ply").stat().st_size > 1000
