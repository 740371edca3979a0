"""The page of the demo gallery: plain HTML beside the files that it shows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any

from alphamesh.cli.summary import counted, number

if TYPE_CHECKING:
    from alphamesh.radius import RadiusChoice
    from alphamesh.shapes import DemoShape

__all__ = ["Exhibit", "gallery_page"]


@dataclass(frozen=True, slots=True)
class Exhibit:
    """A demo shape, what was found of it, and the names of its files."""

    shape: DemoShape
    choice: RadiusChoice
    counts: Mapping[str, int]
    euler_characteristic: int
    with_film: bool

    @property
    def mask(self) -> str:
        """File of the mask image."""
        return f"{self.shape.name}-mask.png"

    @property
    def cloud(self) -> str:
        """File of the points."""
        return f"{self.shape.name}-cloud.csv"

    @property
    def mesh(self) -> str:
        """File of the mesh."""
        return f"{self.shape.name}-mesh.ply"

    @property
    def picture(self) -> str:
        """File of the first picture: cloud, triangulation and complex."""
        return f"{self.shape.name}-overview.png"

    @property
    def outlines(self) -> str:
        """File of the picture of hull, triangulation and frame."""
        return f"{self.shape.name}-outlines.png"

    @property
    def radii(self) -> str:
        """File of the picture of cells and complex at three radii."""
        return f"{self.shape.name}-radii.png"

    @property
    def film(self) -> str:
        """File of the film."""
        return f"{self.shape.name}-film.gif"

    @property
    def files(self) -> list[str]:
        """All files of the shape."""
        pictures = [self.picture, self.outlines, self.radii]
        return [self.mask, self.cloud, self.mesh, *pictures, *([self.film] * self.with_film)]

    def facts(self) -> dict[str, Any]:
        """Return the summary for scripts."""
        components, holes = self.shape.betti
        return {
            "name": self.shape.name,
            "components": components,
            "holes": holes,
            "radius": self.choice.radius,
            "rule": self.choice.rule,
            **self.counts,
            "euler_characteristic": self.euler_characteristic,
            "files": self.files,
        }


_STYLE = """
  :root { color-scheme: light dark; }
  body { font: 16px/1.5 system-ui, sans-serif; max-width: 75rem; margin: 2rem auto;
         padding: 0 1rem; }
  section { border-top: 1px solid #8884; padding: 1.5rem 0; }
  h2 { margin: 0; }
  p { margin: .25rem 0 1rem; max-width: 46rem; }
  .row { display: flex; gap: 1rem; align-items: center; flex-wrap: wrap; }
  .mask { width: 9rem; image-rendering: pixelated; border: 1px solid #8884; }
  .overview { flex: 1 1 40rem; min-width: 0; max-width: 100%; background: white; }
  .wide { display: block; width: 100%; max-width: 64rem; margin: 1rem 0; background: white; }
  summary { cursor: pointer; }
  .files a { margin-right: 1rem; }
"""

_INTRODUCTION = """From each mask on the left, points were drawn at random. Their Delaunay
triangulation fills every hole; the alpha complex keeps only the triangles and edges that
balls of one radius around the points hold together. Why that radius was chosen stands with
each shape. Below: the hull and what a frame of points leaves of the triangulation; the
Voronoi cells within discs of three radii, with the complex that joins the cells that touch;
and a film of the growing radius."""


def gallery_page(exhibits: Sequence[Exhibit]) -> str:
    """Return the page that shows the exhibits."""
    sections = "\n".join(_section(exhibit) for exhibit in exhibits)
    return f"""<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>alphamesh: demo shapes</title>
<style>{_STYLE}</style>
<h1>Demo shapes</h1>
<p>{_INTRODUCTION}</p>
{sections}
</html>
"""


def _section(exhibit: Exhibit) -> str:
    name = escape(exhibit.shape.name)
    components, holes = exhibit.shape.betti
    counts = exhibit.counts
    description = escape(exhibit.shape.description)
    text = (
        f"{description[0].upper()}{description[1:]}: {counted(components, 'component')}, "
        f"{counted(holes, 'hole')}. "
        f"At radius {number(exhibit.choice.radius)}, "
        f"{counted(counts['triangles'], 'triangle')} and "
        f"{counted(counts['singular_edges'], 'singular edge')}. {escape(exhibit.choice.reason)}"
    )
    links = "".join(f'<a href="{file}">{file}</a>' for file in exhibit.files)
    further = [
        ("Hull, triangulation and frame", exhibit.outlines),
        ("Cells and complex at three radii", exhibit.radii),
        *([("Film of the growing radius", exhibit.film)] * exhibit.with_film),
    ]
    shown = "\n".join(
        f'<details open><summary>{title}</summary>\n<img class="wide" loading="lazy" '
        f'src="{file}" alt="{title} of {name}"></details>'
        for title, file in further
    )
    return f"""<section id="{name}">
<h2>{name}</h2>
<p>{text}</p>
<div class="row">
<img class="mask" src="{exhibit.mask}" alt="mask of {name}">
<img class="overview" src="{exhibit.picture}"
 alt="cloud, Delaunay triangulation and alpha complex of {name}">
</div>
{shown}
<p class="files">{links}</p>
</section>"""
