"""The outline of points from a table, with its holes, as closed rings of row numbers.

Usage: python outline_of_points.py [TABLE] [RADIUS]

TABLE is any file of points that alphamesh reads (CSV, NPY, Parquet, ...). Without it, points
of a demo shape are written to points.csv first.
"""

import sys

import numpy as np

import alphamesh as am


def rings(boundary_edges):
    """Chain directed edges (from, to) into closed rings.

    Where rings touch in a point, any of its outgoing edges will do.
    """
    outgoing = {}
    for start, end in boundary_edges.tolist():
        outgoing.setdefault(start, []).append(end)
    while outgoing:
        ring = [next(iter(outgoing))]
        while ring[-1] in outgoing:
            ends = outgoing[ring[-1]]
            ring.append(ends.pop())
            if not ends:
                del outgoing[ring[-2]]
        yield ring


def signed_area(corners):
    x, y = corners.T
    return (x[:-1] @ y[1:] - x[1:] @ y[:-1]) / 2


def main(table=None, radius=None):
    if table is None:
        table = "points.csv"
        cloud = am.demo_cloud("annulus", 1500, seed=2)
        np.savetxt(table, cloud, delimiter=",", header="x,y", comments="")
    points = am.read_points(table)
    shape = am.AlphaComplex(points).at(None if radius is None else float(radius))

    total = 0.0
    for ring in sorted(rings(shape.boundary_edges), key=len, reverse=True):
        area = signed_area(points[ring])
        total += area
        print(f"{'outline' if area > 0 else 'hole':8} of {len(ring) - 1:4} points: {area:+.3f}")
    print(f"area of the shape: {shape.area:.3f}; sum of the rings: {total:.3f}")


if __name__ == "__main__":
    main(*sys.argv[1:])
