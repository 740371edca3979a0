"""Films: the restricted Voronoi cells and the alpha complex of a growing radius."""

from alphamesh.film.film import FILM_FORMATS, Film, animate
from alphamesh.film.radii import RADII_RULES, film_radii

__all__ = ["FILM_FORMATS", "RADII_RULES", "Film", "animate", "film_radii"]
