"""Numbers in words for the reasons of rules."""

from __future__ import annotations

__all__ = ["CELLS", "apart", "components_and_holes", "counted", "flat_text", "shape_words"]

#: What the largest simplices of a cloud of each dimension are called: one, several.
CELLS = {
    1: ("an edge", "edges"),
    2: ("a triangle", "triangles"),
    3: ("a tetrahedron", "tetrahedra"),
}
_FLATS = {1: "on one line", 2: "in one plane"}


def flat_text(points: str, dimension: int, columns: int) -> str:
    """Return what is said first of points that do not fill the plane or space."""
    if dimension == columns:
        return ""
    return f"{points} lie {_FLATS[dimension]}, so there are no {CELLS[columns][1]}. "


def apart(low: float, high: float) -> tuple[str, str]:
    """Return two numbers, rounded no more than keeps them apart."""
    for digits in range(4, 17):
        texts = f"{low:.{digits}g}", f"{high:.{digits}g}"
        if texts[0] != texts[1]:
            return texts
    return repr(low), repr(high)


def counted(number: int, singular: str, plural: str | None = None) -> str:
    """Return ``"1 hole"``, ``"2 holes"`` or ``"no holes"``."""
    name = singular if number == 1 else plural or f"{singular}s"
    return f"{number:,} {name}" if number else f"no {name}"


def components_and_holes(b0: int, b1: int) -> str:
    """Return ``"1 component and 2 holes"``."""
    return f"{counted(b0, 'component')} and {counted(b1, 'hole')}"


def shape_words(betti: tuple[int, ...]) -> str:
    """Return components and holes; in space, ``"1 component, 2 tunnels and 1 void"``."""
    if len(betti) == 2:
        return components_and_holes(*betti)
    components, tunnels, voids = betti
    first = f"{counted(components, 'component')}, {counted(tunnels, 'tunnel')}"
    return f"{first} and {counted(voids, 'void')}"
