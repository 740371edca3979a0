"""What a notebook shows of a complex or a shape: a small picture, and the facts."""

from __future__ import annotations

import html
from collections.abc import Mapping
from typing import TYPE_CHECKING

from alphamesh.periodic import PeriodicFiltration, PeriodicShape
from alphamesh.shape3d import AlphaShape3D
from alphamesh.view.picture import svg_picture

if TYPE_CHECKING:
    from alphamesh.radius import RadiusChoice
    from alphamesh.shape import AlphaShape
    from alphamesh.view.placing import BoxOrFree

__all__ = ["complex_card", "shape_card"]

_BOX = "display:flex;gap:20px;align-items:flex-start;flex-wrap:wrap"
_CELL = "text-align:left;padding:1px 14px 1px 0"
_CLASSES = {2: ("components", "holes"), 3: ("components", "tunnels", "voids")}
_IN_BOX = {2: ("components", "loops"), 3: ("components", "loops", "voids")}
_NAMES = ("vertices", "edges", "triangles", "tetrahedra")


def shape_card(shape: AlphaShape | AlphaShape3D) -> str:
    """Return a shape as HTML."""
    counts = shape.counts
    cells = "tetrahedra" if isinstance(shape, AlphaShape3D) else "triangles"
    facts = {"radius": f"{shape.radius:.6g}", cells: f"{counts[cells]:,}"}
    if isinstance(shape, AlphaShape3D):
        facts |= {
            "boundary triangles": f"{len(shape.boundary_triangles):,}",
            "volume": f"{shape.volume:.6g}",
            "surface area": f"{shape.surface_area:.6g}",
        }
    else:
        facts |= {
            "boundary edges": f"{counts['regular_edges']:,}",
            "area": f"{shape.area:.6g}",
            "perimeter": f"{shape.perimeter:.6g}",
        }
    facts["singular edges"] = f"{counts['singular_edges']:,}"
    facts["isolated points"] = f"{counts['isolated_vertices']:,}"
    return _card("AlphaShape", facts, svg_picture(shape))


def complex_card(
    filtration: BoxOrFree,
    choice: RadiusChoice | None,
    shape: AlphaShape | AlphaShape3D | PeriodicShape | None,
) -> str:
    """Return a complex as HTML, with its shape at the radius of `choice`, if any.

    Of a periodic box there is no picture, but what the facts tell.
    """
    boxed = isinstance(filtration, PeriodicFiltration)
    heading = "PeriodicComplex" if boxed else "AlphaComplex"
    facts = {
        name: f"{len(simplices):,}"
        for name, simplices in zip(_NAMES, filtration.simplices, strict=False)
    }
    hidden = len(filtration.hidden)
    duplicates = len(filtration.points) - len(filtration.simplices[0]) - hidden
    if duplicates:
        facts["duplicates"] = f"{duplicates:,}"
    if hidden:
        facts["hidden points"] = f"{hidden:,}"
    if isinstance(filtration, PeriodicFiltration):
        sides = ("open" if side is None else f"{side:.6g}" for side in filtration.periods)
        facts["periodic box"] = " x ".join(sides)
    if choice is None or shape is None:
        return _card(heading, facts, "")
    facts["chosen radius"] = f"{choice.radius:.6g}, rule {choice.rule}"
    if choice.betti is not None:
        words = (_IN_BOX if boxed else _CLASSES)[filtration.points.shape[1]]
        facts |= {word: f"{n:,}" for word, n in zip(words, choice.betti, strict=False)}
    return _card(heading, facts, "" if isinstance(shape, PeriodicShape) else svg_picture(shape))


def _card(heading: str, facts: Mapping[str, str], picture: str) -> str:
    rows = "".join(
        f'<tr><th style="{_CELL};font-weight:400">{html.escape(name)}</th>'
        f'<td style="{_CELL}">{html.escape(value)}</td></tr>'
        for name, value in facts.items()
    )
    table = f'<table style="border-collapse:collapse">{rows}</table>'
    return f'<div style="{_BOX}">{picture}<div><strong>{heading}</strong>{table}</div></div>'
