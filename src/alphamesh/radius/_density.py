"""How densely the points lie: what the noise of sampling is measured by.

In a random sample of the plane with ``k / pi`` points per unit of area, a disc of radius r
holds ``k * r**2`` points on average; in space, a ball holds ``k * r**3``, if there are
``k * 3 / (4 pi)`` points per unit of volume. Call that the *content* of r. Gabriel edges are
those whose smallest circle or ball is empty, so the contents of their radii are spread like
``exp(-content)``, whatever the density: their mean tells k. Few of these edges cross
holes and gaps, and the long ones are left out.

The filtration lists its edges along a curve that fills the plane or space, so a block of
consecutive edges lies in one place. Blocks are joined in pairs, pairs of pairs and so on,
up to the whole cloud; on the way back, each block departs from the pair that it belongs
to only as far as the differences at that level exceed the error of sampling.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from alphamesh.filtration import Filtration

if TYPE_CHECKING:
    from alphamesh._arrays import BoolArray, FloatArray, IntArray
    from alphamesh.filtration import AnyFiltration

__all__ = ["Density", "local_density"]

# Edges of a block.
_BLOCK = 32
# Contents beyond this, by the density of the whole, are holes and gaps.
_LONGEST = 6.0
# Variance of the logarithm of k, times the number of edges: it would be 1 if edges did
# not depend on their neighbours (measured on uniform samples of the plane; 2.6 in space).
_VARIANCE = 2.3
# No block is taken to be sparser than the whole by more than this factor: one radius
# cannot serve both.
_SPARSEST = 8.0
_MEDIAN = float(np.log(2.0))
# Powers beyond this are cut off; keeps infinities out of the sums.
_MOST = 1e12


@dataclass(frozen=True, slots=True)
class Density:
    """The density about each edge.

    Attributes
    ----------
    dimension : int
        3 for points that fill space, 2 for those in a plane or on a surface.
    unit : float
        The median radius of the Gabriel edges.
    before : (E,) int32
        How many Gabriel edges stand before each edge.
    logs, variances : (b,) float64
        For each block of Gabriel edges: the logarithm of k, with `unit` as the unit of
        length, and its variance.
    """

    dimension: int
    unit: float
    before: IntArray
    logs: FloatArray
    variances: FloatArray

    def rate(self, edges: IntArray) -> FloatArray:
        """Return k about some edges: the content of the radius `unit` there."""
        return np.exp(self.logs.take(self._blocks(edges)))

    def variance(self, edges: IntArray) -> FloatArray:
        """Return the variance of the logarithm of the rate about some edges."""
        return self.variances.take(self._blocks(edges))

    def _blocks(self, edges: IntArray) -> IntArray:
        return self.before.take(edges) // _BLOCK

    def content(self, radii: FloatArray, edges: IntArray) -> FloatArray:
        """Return the contents of radii, each by the density about an edge."""
        return np.asarray(self.rate(edges) * _power(radii, self.unit, self.dimension))

    def radius(self, power: float) -> float:
        """Return the radius whose `dimension`-th power, in units, is `power`."""
        return self.unit * float(power ** (1.0 / self.dimension))

    def all_rates(self) -> FloatArray:
        """Return the rates of all blocks: equal shares of the cloud."""
        return np.exp(self.logs)


def local_density(filtration: AnyFiltration, dimension: int) -> Density:
    """Return the density about each edge; the cloud must not be on one line.

    Parameters
    ----------
    filtration : Filtration or Filtration3D
    dimension : int
        See :class:`Density`.
    """
    radii = filtration.radii[1]
    gabriel = radii < _filled_from(filtration)
    if not gabriel.any():  # each smallest circle passes through a third point
        gabriel = np.ones(len(radii), dtype=bool)
    own = radii.compress(gabriel)
    unit = float(np.median(own)) or float(own.max()) or 1.0
    contents = _MEDIAN * _power(own, unit, dimension)
    short = contents < _LONGEST
    contents[~short] = 0.0
    before = np.maximum(np.cumsum(gabriel, dtype=np.int32) - 1, 0).astype(np.int32)
    logs, variances = _shrunk(_block_sums(contents), _block_sums(short))
    return Density(dimension, unit, before, logs + np.log(_MEDIAN), variances)


def _filled_from(filtration: AnyFiltration) -> FloatArray:
    """Return the radius at which each edge gets its first triangle."""
    if isinstance(filtration, Filtration):
        return filtration.edge_intervals.regular_from
    return filtration.filled_from


def _power(radii: FloatArray, unit: float, dimension: int) -> FloatArray:
    """Return a power of radii in units; what is absurdly large is cut off."""
    with np.errstate(over="ignore", under="ignore"):
        return np.minimum((radii / unit) ** dimension, _MOST)


def _block_sums(values: FloatArray | BoolArray) -> FloatArray:
    starts = np.arange(0, len(values), _BLOCK)
    return np.asarray(np.add.reduceat(values.astype(np.float64), starts))


def _shrunk(total: FloatArray, count: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the logarithm of each block's rate over that of the median, and its variance.

    Parameters
    ----------
    total, count : (b,) float64
        Sum and number of the contents that are not too long.
    """
    totals, counts = [total], [count]
    while len(totals[-1]) > 1:
        totals.append(_paired(totals[-1]))
        counts.append(_paired(counts[-1]))
    log = np.log(_rate(totals[-1] / counts[-1]))
    variance = np.full(1, _VARIANCE / counts[-1][0])
    for sums, sizes in zip(totals[-2::-1], counts[-2::-1], strict=True):
        parent, size = np.repeat(log, 2)[: len(sums)], np.maximum(sizes, 1.0)
        rate = np.maximum(_rate(sums / size), 1.0 / _SPARSEST)
        departure = np.where(sizes > 0, np.log(rate) - parent, 0.0)
        error = _VARIANCE / size
        spread = max(float(np.average(departure**2 - error, weights=sizes)), 0.0)
        weight = spread / (spread + error)
        log = parent + weight * departure
        variance = weight * error + (1.0 - weight) * np.repeat(variance, 2)[: len(sums)]
    return log, variance


def _paired(values: FloatArray) -> FloatArray:
    """Return the sums of the first and second value, the third and fourth, and so on."""
    even = np.append(values, 0.0) if len(values) % 2 else values
    return np.asarray(even[::2] + even[1::2])


# Mean content, over _LONGEST, if contents are spread like exp(-rate * content) up to there.
_RATES = np.geomspace(1e-3, 60.0, 4000)
_MEANS = 1 / (_RATES * _LONGEST) - 1 / np.expm1(_RATES * _LONGEST)


def _rate(mean: FloatArray) -> FloatArray:
    """Return the rate of contents by their mean, as their tail is cut off."""
    return np.asarray(np.interp(-mean / _LONGEST, -_MEANS, _RATES))
