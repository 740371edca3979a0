"""Unions of discs and of balls measured in other ways: by slices, by sampling."""

from __future__ import annotations

import math

import numpy as np
from mpmath import mp

from alphamesh.filtration import filtration
from alphamesh.unions import UnionOfDiscs, union_of_balls

TURN = 2 * math.pi


def union(points, radius, **options):
    return union_of_balls(filtration(np.asarray(points, dtype=float)), radius, **options)


def measures(found):
    """Content, boundary, and both of each disc or ball."""
    if isinstance(found, UnionOfDiscs):
        return found.area, found.perimeter, found.disc_areas, found.disc_perimeters
    return found.volume, found.surface_area, found.ball_volumes, found.ball_surface_areas


def holes(found):
    if isinstance(found, UnionOfDiscs):
        return found.holes.areas, found.holes.perimeters
    return found.voids.volumes, found.voids.surface_areas


def area_of_discs(centres, radii):
    """Area of a union of discs, by Green's theorem along the arcs that no other covers."""
    area = 0.0
    for i, (x, y) in enumerate(centres):
        r, events, depth = radii[i], [], 0
        for j, (u, v) in enumerate(centres):
            distance = math.hypot(u - x, v - y)
            if i == j or distance >= r + radii[j] or distance + radii[j] <= r:
                continue
            if distance + r <= radii[j]:
                break  # inside of another
            half = math.acos((distance**2 + r**2 - radii[j] ** 2) / (2 * distance * r))
            begin = (math.atan2(v - y, u - x) - half) % TURN
            end = (begin + 2 * half) % TURN
            depth += end < begin
            events += [(begin, 1), (end, -1)]
        else:
            last = 0.0
            for angle, step in [*sorted(events), (TURN, 0)]:
                if depth == 0:
                    area += r * r * (angle - last) / 2
                    area += r * x * (math.sin(angle) - math.sin(last)) / 2
                    area -= r * y * (math.cos(angle) - math.cos(last)) / 2
                last, depth = angle, depth + step
    return area


def volume_of_balls(centres, radii, heights):
    """Volume of balls whose centres lie in one plane, slice by slice; kinks at `heights`."""

    def slice_(z):
        z = float(z)
        return area_of_discs(centres, [math.sqrt(max(0.0, (r - z) * (r + z))) for r in radii])

    return 2 * float(mp.quad(slice_, sorted({0.0, *heights, *radii}), maxdegree=8))


def sampled(points, weights, power, count, seed):
    """Estimate the content of a union and of each part, and a standard error of both."""
    rng = np.random.default_rng(seed)
    radii = np.sqrt(np.maximum(weights + power, 0))
    low, high = (points - radii[:, None]).min(axis=0), (points + radii[:, None]).max(axis=0)
    hits = np.zeros(len(points))
    for _ in range(count // 10_000):
        queries = rng.uniform(low, high, size=(10_000, points.shape[1]))
        distance_sq = ((queries[:, None] - points) ** 2).sum(axis=2) - weights
        owner = distance_sq.argmin(axis=1)
        inside = distance_sq[np.arange(len(queries)), owner] <= power
        hits += np.bincount(owner[inside], minlength=len(points))
    box = np.prod(high - low)
    share = hits.sum() / count
    return box * share, box * hits / count, box * math.sqrt(share * (1 - share) / count)
