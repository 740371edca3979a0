"""What a rule returns: a radius, the range it stands for, and why."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

__all__ = ["RadiusChoice", "RadiusInterval"]


class RadiusInterval(NamedTuple):
    """A range of radii, ``low <= radius < high``, and the shape that it gives.

    Attributes
    ----------
    low, high : float
        In the units of the points; `high` may be infinite.
    betti : tuple of int
        Components and holes of the shape over that range; in space, components, tunnels
        and voids.
    """

    low: float
    high: float
    betti: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class RadiusChoice:
    """A radius, and why it was chosen.

    Attributes
    ----------
    radius : float
        In the units of the points.
    rule : str
        Name of the rule that chose it.
    reason : str
        A few sentences for a reader who has never heard of the rule.
    interval : tuple of float, or None
        The range ``low <= radius < high`` over which the shape has the same Betti
        numbers; `high` may be infinite. None if nobody looked: for a radius that was given,
        and in space for all rules but ``"topology"``, as persistence takes its time there.
    betti : tuple of int, or None
        ``(b0, b1)``: the components and holes of the shape, without `strays`; in space
        ``(b0, b1, b2)``, components, tunnels and voids. None if `interval` is.
    confidence : float or None
        How clear the answer is, from 0 to 1; see the rule ``"topology"``. None for rules
        that do not judge the shape.
    runners_up : tuple of RadiusInterval
        Other ranges that could be meant, the most likely first.
    clear : bool
        False if the cloud gives no clear answer; `reason` then says so.
    strays : int
        Small pieces of the complex at `radius` that look like outliers; they are not
        counted as components in `betti`.
    """

    radius: float
    rule: str
    reason: str
    interval: tuple[float, float] | None = None
    betti: tuple[int, ...] | None = None
    confidence: float | None = None
    runners_up: tuple[RadiusInterval, ...] = ()
    clear: bool = True
    strays: int = 0

    def __str__(self) -> str:
        return f"radius {self.radius:.6g} (rule {self.rule!r}): {self.reason}"
