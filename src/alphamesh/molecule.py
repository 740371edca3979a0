"""Molecules: atoms as balls of their van der Waals radii."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from numbers import Real
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from alphamesh._arrays import Record, read_only
from alphamesh.errors import ParameterError, UnknownElementError, rows_text

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from alphamesh._arrays import BoolArray, FloatArray, IntArray

__all__ = ["VAN_DER_WAALS_RADII", "Molecule", "radii_of"]

# Mantina, Chamberlin, Valero, Cramer and Truhlar, Consistent van der Waals radii for the
# whole main group, Journal of Physical Chemistry A 113 (2009) 5806-5812, table 12: where
# there is one, that is the radius of Bondi, van der Waals volumes and radii, Journal of
# Physical Chemistry 68 (1964) 441-451; for hydrogen, that of Rowland and Taylor (1996).
_MAIN_GROUP = """
    H 1.10 He 1.40
    Li 1.81 Be 1.53 B 1.92 C 1.70 N 1.55 O 1.52 F 1.47 Ne 1.54
    Na 2.27 Mg 1.73 Al 1.84 Si 2.10 P 1.80 S 1.80 Cl 1.75 Ar 1.88
    K 2.75 Ca 2.31 Ga 1.87 Ge 2.11 As 1.85 Se 1.90 Br 1.83 Kr 2.02
    Rb 3.03 Sr 2.49 In 1.93 Sn 2.17 Sb 2.06 Te 2.06 I 1.98 Xe 2.16
    Cs 3.43 Ba 2.68 Tl 1.96 Pb 2.02 Bi 2.07 Po 1.97 At 2.02 Rn 2.20
    Fr 3.48 Ra 2.83
"""
# Metals that Bondi has.
_BONDI = """
    Ni 1.63 Cu 1.40 Zn 1.39 Pd 1.63 Ag 1.72 Cd 1.58 Pt 1.75 Au 1.66 Hg 1.55 U 1.86
"""
# All others: Alvarez, A cartography of the van der Waals territories, Dalton Transactions
# 42 (2013) 8617-8636, table 1.
_ALVAREZ = """
    Sc 2.58 Ti 2.46 V 2.42 Cr 2.45 Mn 2.45 Fe 2.44 Co 2.40
    Y 2.75 Zr 2.52 Nb 2.56 Mo 2.45 Tc 2.44 Ru 2.46 Rh 2.44
    La 2.98 Ce 2.88 Pr 2.92 Nd 2.95 Sm 2.90 Eu 2.87 Gd 2.83 Tb 2.79 Dy 2.87 Ho 2.81
    Er 2.83 Tm 2.79 Yb 2.80 Lu 2.74 Hf 2.63 Ta 2.53 W 2.57 Re 2.49 Os 2.48 Ir 2.41
    Ac 2.80 Th 2.93 Pa 2.88 Np 2.82 Pu 2.81 Am 2.83 Cm 3.05 Bk 3.40 Cf 3.05 Es 2.70
"""


def _table(*texts: str) -> dict[str, float]:
    words = " ".join(texts).split()
    return dict(zip(words[::2], map(float, words[1::2]), strict=True))


VAN_DER_WAALS_RADII: Mapping[str, float] = MappingProxyType(
    dict(sorted(_table(_MAIN_GROUP, _BONDI, _ALVAREZ, "D 1.10").items()))
)
"""The van der Waals radius of each element, in angstroms, by its symbol.

Of the main group those of Bondi (1964) as completed by Mantina and others (2009); of ten
metals (Ni, Cu, Zn, Pd, Ag, Cd, Pt, Au, Hg, U) Bondi's; of all others Alvarez's (2013). D is
deuterium.
"""


@dataclass(frozen=True, eq=False, repr=False)
class Molecule(Record):
    """Atoms and their van der Waals radii; from :func:`alphamesh.read_molecule`.

    Attributes
    ----------
    points : (n, 3) float64
        Where the atoms are, in angstroms.
    elements : (n,) str
        Symbols, such as ``"C"`` and ``"Fe"``.
    radii : (n,) float64
        In angstroms, see :data:`VAN_DER_WAALS_RADII`.
    names : (n,) str
        Of atoms in their residue, such as ``"CA"``.
    residues : (n,) str
        Names of the residues, such as ``"LEU"``.
    residue_ids : (n,) int32
        Their numbers in the file.
    insertion_codes : (n,) str
        What follows the number in the file: empty as a rule.
    chains : (n,) str
        Names of the chains.

    All arrays are read-only, in the order of the file.

    Examples
    --------
    >>> import alphamesh as am
    >>> molecule = am.read_molecule("1vii.pdb")  # doctest: +SKIP
    >>> cx = am.AlphaComplex(molecule.points, weights=molecule.weights(1.4))  # doctest: +SKIP
    >>> cx.union(0).surface_area  # accessible to a probe of 1.4 angstroms  # doctest: +SKIP
    """

    points: FloatArray
    elements: NDArray[np.str_]
    radii: FloatArray
    names: NDArray[np.str_]
    residues: NDArray[np.str_]
    residue_ids: IntArray
    insertion_codes: NDArray[np.str_]
    chains: NDArray[np.str_]

    def __len__(self) -> int:
        return len(self.points)

    def weights(self, probe: float = 0.0) -> FloatArray:
        """Return the squared radii of the atoms, each larger by that of a probe.

        Parameters
        ----------
        probe : float, default 0
            In angstroms, 0 or more: 1.4 for a molecule of water. The surface of the union
            of such balls, that of ``AlphaComplex(points, weights=weights)`` at radius 0,
            is where the centre of the probe can go: the solvent-accessible surface [1]_.

        Returns
        -------
        (n,) float64
            In squared angstroms.

        Raises
        ------
        ParameterError
            If `probe` is not a finite number of at least 0.

        References
        ----------
        .. [1] B. Lee and F. M. Richards, The interpretation of protein structures:
           estimation of static accessibility, Journal of Molecular Biology 55 (1971)
           379-400.
        """
        if not isinstance(probe, Real) or not 0 <= float(probe) < math.inf:
            raise ParameterError(
                f"probe must be a radius in angstroms, finite and 0 or more; got {probe!r}"
            )
        return read_only(np.square(self.radii + float(probe)))

    def where(self, mask: Any) -> Molecule:
        """Return the atoms where `mask` is true.

        Parameters
        ----------
        mask : array-like of shape (n,), bool

        Raises
        ------
        ParameterError
            If there is not one truth value for each atom.
        """
        chosen: BoolArray = np.asarray(mask)
        if chosen.dtype != np.bool_ or chosen.shape != (len(self),):
            raise ParameterError(
                f"mask must be {len(self)} truth values, one for each atom; got an array of "
                f"shape {chosen.shape} and type {chosen.dtype}"
            )
        arrays = (getattr(self, name)[chosen] for name in self.__dataclass_fields__)
        return Molecule(*map(read_only, arrays))

    def __repr__(self) -> str:
        chains = len(np.unique(self.chains))
        return f"<Molecule: {len(self):,} atoms in {chains:,} chain{'s' * (chains != 1)}>"


def radii_of(
    elements: NDArray[np.str_], labels: list[str], own: Mapping[str, float] | None = None
) -> FloatArray:
    """Return the van der Waals radius of each atom.

    Parameters
    ----------
    elements : (n,) str
    labels : list of n str
        How messages call the atoms.
    own : mapping of str to float, optional
        Radii in angstroms that come before those of the table.

    Returns
    -------
    (n,) float64

    Raises
    ------
    UnknownElementError
        If no radius is known for some of the elements.
    ParameterError
        If a radius of `own` is not a finite number of at least 0.
    """
    table = {**VAN_DER_WAALS_RADII, **_checked(own)}
    symbols, which = np.unique(elements, return_inverse=True)
    known = np.array([table.get(str(symbol), np.nan) for symbol in symbols])
    radii: FloatArray = known.take(which) if len(symbols) else np.empty(0)
    missing = np.flatnonzero(np.isnan(radii))
    if len(missing):
        unknown = [str(symbol) for symbol in symbols[np.isnan(known)]]
        some = "; ".join(labels[row] for row in missing[:3].tolist())
        more = "; ..." if len(missing) > 3 else ""
        raise UnknownElementError(
            f"no van der Waals radius is known for {', '.join(unknown)}: {some}{more} "
            f"({rows_text(missing[:5], total=len(missing))}); pass radii={{{unknown[0]!r}: 2}} "
            "with a radius in angstroms, or correct the elements in the file",
            rows=missing[:5],
        )
    return read_only(radii)


def _checked(own: Mapping[str, float] | None) -> dict[str, float]:
    """Return radii by symbols as they are in the table, or say what is wrong with them."""
    given: Any = {} if own is None else own
    if not isinstance(given, Mapping):
        raise ParameterError(
            f"radii must be a mapping of symbols to angstroms, such as {{'Fe': 2.0}}; "
            f"got {given!r}"
        )
    for symbol, radius in given.items():
        if not isinstance(radius, Real) or not 0 <= float(radius) < math.inf:
            raise ParameterError(
                f"the radius of {symbol} must be a finite number of angstroms, 0 or more; "
                f"got {radius!r}"
            )
    return {str(symbol).capitalize(): float(radius) for symbol, radius in given.items()}
