"""Molecules from files of the Protein Data Bank, read by gemmi: PDB and mmCIF."""

from __future__ import annotations

import os
from collections import defaultdict
from collections.abc import Iterator, Mapping
from pathlib import PurePath
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from alphamesh._arrays import read_only
from alphamesh.errors import MissingLibraryError, ParameterError, rows_text
from alphamesh.io._columns import Wanted, choose_columns
from alphamesh.io._sources import Source, open_source
from alphamesh.molecule import VAN_DER_WAALS_RADII, Molecule, radii_of

if TYPE_CHECKING:
    from alphamesh._arrays import FloatArray

__all__ = ["MOLECULE_FORMATS", "molecule_table", "read_atoms", "read_molecule"]

MOLECULE_FORMATS: Mapping[str, str] = {
    "pdb": "pdb",
    "ent": "pdb",
    "cif": "mmcif",
    "mmcif": "mmcif",
}
"""What :func:`read_molecule` reads: the format that each file name extension stands for."""

# An atom without an alternative.
_ONLY = "\0"

# Chain, residue and atom, as gemmi has them.
Atom: TypeAlias = tuple[Any, Any, Any]

# The columns of a table of atoms, and where a molecule has them.
_COLUMNS = {
    **dict.fromkeys("xyz", "points"),
    "weight": "radii",
    "radius": "radii",
    "element": "elements",
    "name": "names",
    "residue": "residues",
    "residue_id": "residue_ids",
    "chain": "chains",
}


def read_molecule(  # noqa: PLR0913 (one keyword per choice of atoms)
    path: str | os.PathLike[str],
    *,
    model: int = 1,
    alternate: str | None = None,
    hydrogens: bool = True,
    waters: bool = False,
    hetero: bool = True,
    radii: Mapping[str, float] | None = None,
    file_format: str | None = None,
) -> Molecule:
    """Read the atoms of a molecule from a PDB or an mmCIF file.

    Parameters
    ----------
    path : str or path-like
        The extension tells the format: ``.pdb`` and ``.ent``, or ``.cif`` and ``.mmcif``;
        any of them also packed, with ``.gz``. ``"-"`` reads standard input.
    model : int, default 1
        Which model to read, counted from 1: files of NMR have many.
    alternate : str, optional
        Of atoms in several places, take those of this label, such as ``"B"``. By default,
        of each residue the label of the greatest occupancy, of equal ones the first.
    hydrogens : bool, default True
        Keep hydrogen and deuterium. Structures from X-rays have none, as a rule.
    waters : bool, default False
        Keep molecules of water.
    hetero : bool, default True
        Keep what is in no chain of a polymer: ligands, ions, sugars. Modified residues in a
        chain stay in any case.
    radii : mapping of str to float, optional
        Radii in angstroms by element that come before those of
        :data:`alphamesh.molecule.VAN_DER_WAALS_RADII`, such as ``{"Zn": 0.74}``.
    file_format : {"pdb", "mmcif"}, optional
        Whatever the extension says.

    Returns
    -------
    Molecule

    Raises
    ------
    FileReadError
        If the file cannot be opened, is not what its name says, or has no atoms.
    UnknownElementError
        If no radius is known for some of the elements; the message names the atoms.
    ParameterError
        If there is no such model or label, or a parameter has no possible value.
    MissingLibraryError
        If gemmi is not installed (the extra ``molecules``).

    Examples
    --------
    >>> read_molecule("1vii.cif.gz", model=2)  # doctest: +SKIP
    <Molecule: 596 atoms in 1 chain>
    """
    source = open_source(path)
    atoms = _atoms(
        source,
        model=model,
        alternate=alternate,
        hydrogens=hydrogens,
        waters=waters,
        hetero=hetero,
        file_format=file_format,
    )
    return _molecule(source, atoms, radii)


def read_atoms(source: Source, wanted: Wanted) -> FloatArray:
    """Read the coordinates of the atoms, or other columns of :func:`molecule_table`.

    Parameters
    ----------
    source : Source
    wanted : Wanted
        As from :func:`wanted_columns`.

    Returns
    -------
    (n, dimension) float64 array
    """
    names, table = molecule_table(source)
    chosen = [names[k] for k in choose_columns(source, wanted, names, len(names))]
    words = [name for name in chosen if np.asarray(table[name]).dtype.kind == "U"]
    if words:
        raise source.failure(
            f"has words, not numbers, in its column {words[0]}; choose another"
        )
    return np.ascontiguousarray(np.column_stack([table[name] for name in chosen]), dtype=float)


def molecule_table(source: Source) -> tuple[list[str], Mapping[str, Any]]:
    """Return a molecule as a table of points: the names of its columns, and these by name.

    The atoms are those of the first model that :func:`read_molecule` keeps; ``weight`` is
    the square of ``radius``.
    """
    return list(_COLUMNS), _Table(source, _atoms(source))


class _Table(Mapping[str, Any]):
    """Columns of a molecule, made when asked for: not every element has a radius."""

    def __init__(self, source: Source, atoms: list[Atom]) -> None:
        self._source, self._atoms = source, atoms

    def __getitem__(self, name: str) -> Any:
        if name in "xyz":
            return _points(self._source, self._atoms)["xyz".index(name)]
        molecule = _molecule(self._source, self._atoms, None)
        return molecule.weights() if name == "weight" else getattr(molecule, _COLUMNS[name])

    def __iter__(self) -> Iterator[str]:
        return iter(_COLUMNS)

    def __len__(self) -> int:
        return len(_COLUMNS)


def _atoms(  # noqa: PLR0913 (as read_molecule)
    source: Source,
    *,
    model: int = 1,
    alternate: str | None = None,
    hydrogens: bool = True,
    waters: bool = False,
    hetero: bool = True,
    file_format: str | None = None,
) -> list[Atom]:
    """Return the atoms that are wanted, at least one."""
    structure = _structure(source, file_format)
    structure.setup_entities()
    atoms = []
    for chain, residue, atom in _placed(_model(source, structure, model), alternate):
        kind = _kind(residue)
        if (kind == "water" and not waters) or (kind == "hetero" and not hetero):
            continue
        if hydrogens or not atom.is_hydrogen():
            atoms.append((chain, residue, atom))
    if not atoms:
        raise source.failure("has no atoms but those that are left out")
    return atoms


def _structure(source: Source, file_format: str | None) -> Any:
    """Return the structure in a file as gemmi has it."""
    try:
        import gemmi
    except ImportError as error:
        raise MissingLibraryError.of("gemmi", "molecules", "reading molecules") from error
    kind = _format(source, file_format)
    with source.open() as file:
        data = _plain(source, file.read(), kind)
    try:
        if kind == "pdb":
            found: Any = gemmi.read_pdb_string(data)
        else:
            found = gemmi.make_structure_from_block(gemmi.cif.read_string(data)[0])
    except (RuntimeError, ValueError, IndexError, UnicodeDecodeError) as error:
        raise source.failure(
            f"is not a complete {_NAMES[kind]} file ({error}); copy or download it again"
        ) from error
    if len(found) == 0 or not any(len(model) for model in found):
        raise source.failure(
            f"is not a {_NAMES[kind]} file of a molecule: it has no atoms; if its name tells "
            "another format than it has, pass file_format="
        )
    return found


def _plain(source: Source, data: bytes, kind: str) -> bytes:
    """Return a file with what is no text replaced, which may stand in remarks alone.

    gemmi tells of it when a name is asked for.
    """
    if data.isascii():
        return data
    if kind == "mmcif":
        return data.decode("utf-8", errors="replace").encode()
    for number, line in enumerate(data.splitlines(), 1):
        if line[:6] in (b"ATOM  ", b"HETATM") and not line.isascii():
            raise source.failure(
                f"is damaged: line {number} is of an atom, and holds what is no ASCII; copy or "
                "download it again"
            )
    # Columns are counted in bytes.
    return data.decode("ascii", errors="replace").replace("\ufffd", "?").encode()


_NAMES = {"pdb": "PDB", "mmcif": "mmCIF"}


def _format(source: Source, file_format: str | None) -> str:
    """Return ``"pdb"`` or ``"mmcif"``: as asked for, or as named, or as it begins."""
    if file_format is not None:
        if file_format not in _NAMES:
            raise ParameterError(
                f"file_format must be 'pdb' or 'mmcif', or None; got {file_format!r}"
            )
        return file_format
    suffix = PurePath(source.name.lower().removesuffix(".gz")).suffix.removeprefix(".")
    if suffix in MOLECULE_FORMATS:
        return MOLECULE_FORMATS[suffix]
    with source.open() as file:
        start = file.read(4096).lstrip()
    return "mmcif" if start.lower().startswith((b"data_", b"#")) else "pdb"


def _model(source: Source, structure: Any, number: int) -> Any:
    """Return a model, counted from 1."""
    given: Any = number
    if isinstance(given, int) and not isinstance(given, bool) and 1 <= given <= len(structure):
        return structure[given - 1]
    raise ParameterError(
        f"model must be a whole number from 1 to {len(structure)}, as many as {source.name} "
        f"has; got {number!r}"
    )


def _kind(residue: Any) -> str:
    """Return what a residue is part of: "water", "polymer" or "hetero"."""
    if residue.is_water():
        return "water"
    return "polymer" if residue.entity_type.name == "Polymer" else "hetero"


def _placed(model: Any, alternate: str | None) -> Iterator[Atom]:
    """Yield chain, residue and atom of each atom, one of its places."""
    groups: list[tuple[Any, list[Any]]] = []
    for chain in model:
        last = None
        for residue in chain:
            # Residues of one number are alternatives of one another.
            if last is None or residue.seqid != last:
                groups.append((chain, []))
            groups[-1][1].append(residue)
            last = residue.seqid
    if alternate is not None:
        _refuse_label(groups, alternate)
    for chain, residues in groups:
        label = alternate if alternate is not None else _usual_label(residues)
        for residue in residues:
            for atom in _in_place(residue, label, strict=alternate is not None):
                yield chain, residue, atom


def _refuse_label(groups: list[tuple[Any, list[Any]]], alternate: str) -> None:
    labels = {atom.altloc for _, group in groups for residue in group for atom in residue}
    known = sorted(labels - {_ONLY})
    if alternate not in known:
        there = f"there are {', '.join(known)}" if known else "no atom has an alternative"
        raise ParameterError(f"no atom has the alternative {alternate!r}: {there}")


def _usual_label(residues: list[Any]) -> str:
    """Return the label of the greatest occupancy, the first of equal ones."""
    occupancy: dict[str, float] = defaultdict(float)
    for residue in residues:
        for atom in residue:
            if atom.altloc != _ONLY:
                occupancy[atom.altloc] += atom.occ
    return min(occupancy, key=lambda label: (-occupancy[label], label), default=_ONLY)


def _in_place(residue: Any, label: str, *, strict: bool) -> Iterator[Any]:
    """Yield the atoms of a residue with `label`, and those without alternatives.

    Where some atoms of the residue have that label, others have their own greatest; unless
    `strict`.
    """
    labelled = any(atom.altloc == label for atom in residue)
    places: dict[str, list[Any]] = defaultdict(list)
    for atom in residue:
        places[atom.name].append(atom)
    for atoms in places.values():
        for atom in atoms:
            if atom.altloc in (_ONLY, label):
                yield atom
        if labelled and not strict and not any(a.altloc in (_ONLY, label) for a in atoms):
            yield min(atoms, key=lambda atom: (-atom.occ, atom.altloc))


def _element(residue: Any, atom: Any) -> str:
    """Return the symbol of an element; ions are named by it, in files that do not tell."""
    if len(residue) == 1 and residue.name.upper() == atom.name.upper():
        symbol = str(atom.name).capitalize()
        if symbol in VAN_DER_WAALS_RADII:
            return symbol
    return str(atom.element.name)


def _labels(atoms: list[Atom]) -> list[str]:
    """Return how messages call the atoms."""
    return [
        f"{atom.name} of {residue.name} {residue.seqid} in chain {chain.name}"
        for chain, residue, atom in atoms
    ]


def _points(source: Source, atoms: list[Atom]) -> FloatArray:
    """Return where the atoms are, ``(3, n)``."""
    points = np.array([atom.pos.tolist() for _, _, atom in atoms], dtype=np.float64)
    bad = np.flatnonzero(~np.isfinite(points).all(axis=1))
    if len(bad):
        raise source.failure(
            f"does not say where some atoms are: {_labels(atoms)[bad[0]]} "
            f"({rows_text(bad[:5], total=len(bad))}); leave them out of the file"
        )
    return points.T


def _molecule(source: Source, atoms: list[Atom], radii: Mapping[str, float] | None) -> Molecule:
    elements = np.array([_element(residue, atom) for _, residue, atom in atoms])
    numbers = [residue.seqid.num for _, residue, _ in atoms]
    bad = [row for row, number in enumerate(numbers) if number is None]
    if bad:
        raise source.failure(
            f"does not number all residues: {_labels(atoms)[bad[0]]} "
            f"({rows_text(np.array(bad[:5]), total=len(bad))}) has none; number them"
        )
    return Molecule(
        read_only(np.ascontiguousarray(_points(source, atoms).T)),
        read_only(elements),
        radii_of(elements, _labels(atoms), radii),
        read_only(np.array([atom.name for _, _, atom in atoms])),
        read_only(np.array([residue.name for _, residue, _ in atoms])),
        read_only(np.array(numbers, dtype=np.int32)),
        read_only(np.array([residue.seqid.icode.strip() for _, residue, _ in atoms])),
        read_only(np.array([chain.name.strip() for chain, _, _ in atoms])),
    )
