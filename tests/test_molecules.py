"""Molecules: which atoms are read, their radii, their surfaces."""

from __future__ import annotations

import copy
import gzip
import importlib.util
import pickle
import sys
from pathlib import Path

import numpy as np
import pytest

import alphamesh as am
from alphamesh.errors import (
    FileReadError,
    MissingLibraryError,
    ParameterError,
    UnknownElementError,
)
from alphamesh.io.molecules import read_molecule
from alphamesh.io.points import read_points, read_table
from alphamesh.molecule import VAN_DER_WAALS_RADII, Molecule

pytest.importorskip("gemmi")

ATOM = "{kind:<6}{serial:>5} {name:<4}{alt:1}{residue:>3} {chain}{number:>4}{code:1}   "
PLACE = "{x:8.3f}{y:8.3f}{z:8.3f}{occupancy:6.2f}  0.00          {element:>2}"


def line(name, residue, number, place, element="", alt="", occupancy=1.0, kind="ATOM", code=""):
    text = (ATOM + PLACE).format(
        kind=kind,
        serial=1,
        name=name,
        alt=alt or " ",
        residue=residue,
        chain="A",
        number=number,
        code=code or " ",
        x=place[0],
        y=place[1],
        z=place[2],
        occupancy=occupancy,
        element=element or name.strip()[0],
    )
    return text + "\n"


SMALL = [
    line(" N  ", "GLY", 1, (0, 0, 0)),
    line(" CA ", "GLY", 1, (1.5, 0, 0)),
    line(" HA2", "GLY", 1, (1.5, 1, 0)),
    line(" C  ", "GLY", 1, (2.2, -1.3, 0)),
    line(" N  ", "SER", 2, (3.5, -1.3, 0)),
    line(" CA ", "SER", 2, (4.3, -2.5, 0)),
    line(" CB ", "SER", 2, (5.5, -2.5, 1), alt="A", occupancy=0.4),
    line(" CB ", "SER", 2, (5.5, -2.5, -1), alt="B", occupancy=0.6),
    line(" OG ", "SER", 2, (6.5, -2.5, 1), alt="A", occupancy=0.4),
    line(" OG ", "SER", 2, (6.5, -2.5, -1), alt="B", occupancy=0.6),
    line(" C  ", "SER", 2, (4.8, -3.5, 0)),
    line("MG  ", " MG", 101, (9, 9, 9), "MG", kind="HETATM"),
    line(" O  ", "HOH", 201, (15, 9, 9), kind="HETATM"),
]


@pytest.fixture
def written(tmp_path):
    def write(lines, name="a.pdb"):
        path = tmp_path / name
        data = "".join([*lines, "END\n"]).encode()
        path.write_bytes(gzip.compress(data) if name.endswith(".gz") else data)
        return path

    return write


@pytest.fixture(scope="module")
def villin():
    found = importlib.util.find_spec("openmm")
    if found is None:
        pytest.skip("openmm is not installed, which ships a protein")
    return Path(found.origin).parent / "app" / "data" / "test.pdb"


# ------------------------------------------------------------------ which atoms


def test_what_is_read(written):
    molecule = read_molecule(written(SMALL))
    assert molecule.names.tolist() == ["N", "CA", "HA2", "C", "N", "CA", "CB", "OG", "C", "MG"]
    assert molecule.elements.tolist() == ["N", "C", "H", "C", "N", "C", "C", "O", "C", "Mg"]
    assert molecule.residues.tolist() == ["GLY"] * 4 + ["SER"] * 5 + ["MG"]
    assert molecule.residue_ids.tolist() == [1] * 4 + [2] * 5 + [101]
    assert set(molecule.chains.tolist()) == {"A"}
    assert molecule.points[6].tolist() == [5.5, -2.5, -1]  # B, the more occupied
    assert molecule.radii[[0, 1, 2, 9]].tolist() == [1.55, 1.7, 1.1, 1.73]
    assert len(molecule) == 10
    assert repr(molecule) == "<Molecule: 10 atoms in 1 chain>"
    assert not any(getattr(molecule, name).flags.writeable for name in vars(molecule))


@pytest.mark.parametrize(
    ("options", "count"),
    [
        ({}, 10),
        ({"hydrogens": False}, 9),
        ({"waters": True}, 11),
        ({"hetero": False}, 9),
        ({"hetero": False, "hydrogens": False, "waters": True}, 9),
    ],
)
def test_what_is_left_out(written, options, count):
    assert len(read_molecule(written(SMALL), **options)) == count


def test_alternates(written):
    path = written(SMALL)
    assert read_molecule(path, alternate="A").points[6, 2] == 1
    assert read_molecule(path, alternate="B").points[6, 2] == -1
    with pytest.raises(ParameterError, match=r"alternative 'C': there are A, B"):
        read_molecule(path, alternate="C")
    with pytest.raises(ParameterError, match="no atom has an alternative"):
        read_molecule(written(SMALL[:4]), alternate="A")


def test_alternates_of_equal_occupancy_and_of_their_own(written):
    lines = [
        line(" CB ", "SER", 2, (0, 0, 2), alt="B", occupancy=0.5),
        line(" CB ", "SER", 2, (0, 0, 1), alt="A", occupancy=0.5),
        line(" OG ", "SER", 2, (5, 0, 3), alt="C", occupancy=0.3),
        line(" OG ", "SER", 2, (5, 0, 4), alt="D", occupancy=0.4),
    ]
    assert read_molecule(written(lines)).points[:, 2].tolist() == [1, 4]


def test_residues_that_are_alternatives(written):
    lines = [
        line(" CA ", "SER", 2, (0, 0, 1), alt="A", occupancy=0.4),
        line(" OG ", "SER", 2, (0, 3, 1), alt="A", occupancy=0.4),
        line(" CA ", "THR", 2, (0, 0, 2), alt="B", occupancy=0.6),
        line(" OG1", "THR", 2, (0, 3, 2), alt="B", occupancy=0.6),
    ]
    molecule = read_molecule(written(lines))
    assert molecule.residues.tolist() == ["THR", "THR"]
    assert molecule.names.tolist() == ["CA", "OG1"]


def test_insertion_codes(written):
    lines = [
        line(" CA ", "SER", 52, (0, 0, 0)),
        line(" CA ", "GLY", 52, (4, 0, 0), code="A"),
    ]
    molecule = read_molecule(written(lines))
    assert molecule.insertion_codes.tolist() == ["", "A"]


def test_models(written):
    lines = ["MODEL        1\n", SMALL[0], "ENDMDL\n"]
    lines += ["MODEL        2\n", *SMALL[:3], "ENDMDL\n"]
    path = written(lines)
    assert [len(read_molecule(path, model=k)) for k in (1, 2)] == [1, 3]
    for model in (0, 3, True, "1"):
        with pytest.raises(ParameterError, match=r"model must be a whole number from 1 to 2"):
            read_molecule(path, model=model)


def test_mmcif_packed_and_piped(written, tmp_path, monkeypatch):
    gemmi = pytest.importorskip("gemmi")
    path = written(SMALL)
    expected = read_molecule(path)
    document = gemmi.read_structure(str(path)).make_mmcif_document()
    document.write_file(str(tmp_path / "a.cif"))
    text = (tmp_path / "a.cif").read_bytes()
    (tmp_path / "a.cif.gz").write_bytes(gzip.compress(text))
    (tmp_path / "a.data").write_bytes(text)
    found = [
        written(SMALL, "b.ent"),
        written(SMALL, "B.PDB.gz"),
        tmp_path / "a.cif",
        tmp_path / "a.cif.gz",
        tmp_path / "a.data",
    ]
    for other in found:
        molecule = read_molecule(other)
        assert molecule.names.tolist() == expected.names.tolist()
        np.testing.assert_array_equal(molecule.points, expected.points)
    assert len(read_molecule(written(SMALL, "c.cif"), file_format="pdb")) == len(expected)
    with path.open() as file:
        monkeypatch.setattr(sys, "stdin", file)
        assert len(read_molecule("-")) == len(expected)


# ------------------------------------------------------------------ what goes wrong


def test_files_that_are_no_molecules(written, tmp_path):
    (tmp_path / "a.cif").write_text("hello\n")
    with pytest.raises(FileReadError, match=r"a\.cif is not a complete mmCIF file"):
        read_molecule(tmp_path / "a.cif")
    (tmp_path / "b.cif").write_text("data_x\n_cell.length_a 5\n")
    with pytest.raises(FileReadError, match=r"b\.cif is not a mmCIF file of a molecule"):
        read_molecule(tmp_path / "b.cif")
    with pytest.raises(FileReadError, match=r"a\.pdb is not a PDB file of a molecule"):
        read_molecule(written(["HEADER\n"]))
    with pytest.raises(FileReadError, match="no atoms but those that are left out"):
        read_molecule(written(SMALL[-1:]))
    with pytest.raises(FileReadError, match="does not exist"):
        read_molecule(tmp_path / "none.pdb")
    with pytest.raises(ParameterError, match="file_format must be 'pdb' or 'mmcif'"):
        read_molecule(written(SMALL), file_format="xyz")


def test_places_that_are_missing(tmp_path, written):
    gemmi = pytest.importorskip("gemmi")
    structure = gemmi.read_structure(str(written(SMALL)))
    text = structure.make_mmcif_document().as_string().replace("2.2 -1.3 0", "? ? ?")
    (tmp_path / "a.cif").write_text(text)
    with pytest.raises(FileReadError, match=r"where some atoms are: C of GLY 1 in chain A"):
        read_molecule(tmp_path / "a.cif")


def test_unknown_elements(written):
    path = written([*SMALL, line(" X1 ", "UNK", 7, (20, 0, 0), "X", kind="HETATM")])
    with pytest.raises(
        UnknownElementError, match=r"known for X: X1 of UNK 7 in chain A \(row 10\); pass"
    ) as caught:
        read_molecule(path)
    assert caught.value.rows == (10,)
    assert read_molecule(path, radii={"X": 2.5}).radii[-1] == 2.5
    assert len(read_points(path)) == 11


def test_radii_of_ones_own(written):
    path = written(SMALL)
    assert read_molecule(path, radii={"mg": 0.72}).radii[-1] == 0.72
    with pytest.raises(ParameterError, match="the radius of C must be a finite number"):
        read_molecule(path, radii={"C": -1})
    with pytest.raises(ParameterError, match="radii must be a mapping"):
        read_molecule(path, radii=1.7)


def test_without_gemmi(written, monkeypatch):
    monkeypatch.setitem(sys.modules, "gemmi", None)
    with pytest.raises(MissingLibraryError, match=r'gemmi.*"alphamesh\[molecules\]"'):
        read_molecule(written(SMALL))


# ------------------------------------------------------------------ the record


def test_table_of_radii():
    # One of each source, and the ends of the table.
    known = {"H": 1.1, "C": 1.7, "Zn": 1.39, "Fe": 2.44, "Es": 2.7, "D": 1.1}
    assert {symbol: VAN_DER_WAALS_RADII[symbol] for symbol in known} == known
    assert len(VAN_DER_WAALS_RADII) == 99  # to einsteinium, but promethium; and deuterium
    assert all(1 < radius < 3.5 for radius in VAN_DER_WAALS_RADII.values())
    with pytest.raises(TypeError):
        VAN_DER_WAALS_RADII["C"] = 2.0


def test_weights(written):
    molecule = read_molecule(written(SMALL))
    np.testing.assert_array_equal(molecule.weights(), molecule.radii**2)
    np.testing.assert_array_equal(molecule.weights(1.4), (molecule.radii + 1.4) ** 2)
    for probe in (-1, float("nan"), float("inf"), "1.4"):
        with pytest.raises(ParameterError, match="probe must be a radius"):
            molecule.weights(probe)


def test_parts_and_copies(written):
    molecule = read_molecule(written(SMALL))
    serine = molecule.where(molecule.residues == "SER")
    assert isinstance(serine, Molecule)
    assert serine.names.tolist() == ["N", "CA", "CB", "OG", "C"]
    assert copy.deepcopy(molecule) is molecule
    assert not pickle.loads(pickle.dumps(serine)).names.flags.writeable
    for mask in ([True], np.arange(10)):
        with pytest.raises(ParameterError, match="mask must be 10 truth values"):
            molecule.where(mask)


def test_tables_of_points(written):
    path = written(SMALL)
    np.testing.assert_array_equal(read_points(path), read_molecule(path).points)
    assert read_points(path, columns="x,y").shape == (10, 2)
    columns = read_table(path).columns
    assert set(columns) == {
        *("weight", "radius", "element", "name", "residue", "residue_id", "chain")
    }
    np.testing.assert_array_equal(columns["weight"], read_molecule(path).weights())
    with pytest.raises(FileReadError, match="words, not numbers, in its column name"):
        read_points(path, columns="x,y,name")


# ------------------------------------------------------------------ a protein


def test_a_protein_in_water(villin):
    assert len(read_molecule(villin, waters=True)) == 8867
    molecule = read_molecule(villin)
    assert molecule.elements[-2:].tolist() == ["Cl", "Cl"]  # named, and nothing else told
    assert len(read_molecule(villin, hetero=False, hydrogens=False)) == 289


def rolled_over(points, radii, count):
    """Area of each ball that is in no other, by points on it (Shrake & Rupley 1973)."""
    turn = np.pi * (3 - np.sqrt(5)) * np.arange(count)
    height = 1 - (2 * np.arange(count) + 1) / count
    around = np.sqrt(1 - height**2)
    sphere = np.column_stack((around * np.cos(turn), around * np.sin(turn), height))
    areas = np.empty(len(points))
    for row, (centre, radius) in enumerate(zip(points, radii, strict=True)):
        near = np.linalg.norm(points - centre, axis=1) < radius + radii
        near[row] = False
        dots = centre + radius * sphere
        apart = ((dots[:, None] - points[near]) ** 2).sum(axis=2) >= radii[near] ** 2
        areas[row] = 4 * np.pi * radius**2 * apart.all(axis=1).mean()
    return areas


@pytest.mark.parametrize("probe", [0.0, 1.4])
def test_surface_equals_that_by_dots(villin, probe):
    molecule = read_molecule(villin, hetero=False)
    found = am.AlphaComplex(molecule.points, weights=molecule.weights(probe)).union(0)
    radii = molecule.radii + probe
    dots = rolled_over(molecule.points, radii, 1000)
    assert found.surface_area == pytest.approx(dots.sum(), rel=2e-3)
    whole = 4 * np.pi * radii**2
    assert found.ball_surface_areas / whole == pytest.approx(dots / whole, abs=0.02)
    assert found.ball_volumes.sum() == pytest.approx(found.volume, rel=1e-12)
    if probe:
        # What the program mdtraj 1.11 finds with 20,000 dots on each atom: 3052.92.
        assert found.surface_area == pytest.approx(3052.92, abs=0.5)


def test_voids_of_a_cage(written):
    corners = np.array(np.meshgrid(*[[0.0, 3.0]] * 3)).reshape(3, -1).T
    faces = np.array([[1.5, 1.5, -1], [1.5, 1.5, 4], [1.5, -1, 1.5]])
    faces = np.concatenate((faces, [[1.5, 4, 1.5], [-1, 1.5, 1.5], [4, 1.5, 1.5]]))
    lines = [line(" C1 ", "LIG", 1, place, "C") for place in np.concatenate((corners, faces))]
    molecule = read_molecule(written(lines))
    found = am.AlphaComplex(molecule.points, weights=molecule.weights()).union(0)
    assert len(found.voids.volumes) == 1
    assert found.void_balls(0).tolist() == list(range(14))
    rng = np.random.default_rng(0)
    queries = rng.uniform(-0.5, 3.5, (40_000, 3))
    away = np.linalg.norm(queries[:, None] - molecule.points, axis=2).min(axis=1)
    share = (away > 1.7).mean()
    error = 64 * np.sqrt(share * (1 - share) / len(queries))
    assert found.voids.volumes[0] == pytest.approx(64 * share, abs=4 * error)
    probed = am.AlphaComplex(molecule.points, weights=molecule.weights(1.4)).union(0)
    assert len(probed.voids.volumes) == 0


def test_damage_found_by_random_changes(written, tmp_path):
    """Names that are no text, residues without a number."""
    path = written(SMALL)
    whole = path.read_bytes()
    path.write_bytes(whole.replace(b" CA  GLY", b" C\xc1  GLY"))
    with pytest.raises(FileReadError, match="line 2 is of an atom, and holds what is no ASCII"):
        read_molecule(path)
    path.write_bytes(b"REMARK   1 G\xd6TEBORG\nREMARK   2 \xc3\x96\n" + whole)
    assert len(read_molecule(path)) == len(read_molecule(written(SMALL, "b.pdb")))
    path.write_bytes(whole.replace(b"GLY A   1", b"GLY A    "))
    with pytest.raises(FileReadError, match=r"N of GLY .* \(rows 0, 1, 2, 3\) has none"):
        read_molecule(path)
    heads = ("type_symbol", "label_atom_id", "Cartn_x", "Cartn_y", "Cartn_z")
    text = "data_x\nloop_\n" + "".join(f"_atom_site.{head}\n" for head in heads)
    (tmp_path / "a.cif").write_bytes(text.encode() + b"C C\xe9 0 0 0\n")
    with pytest.raises(FileReadError, match="not a complete mmCIF file"):
        read_molecule(tmp_path / "a.cif")
