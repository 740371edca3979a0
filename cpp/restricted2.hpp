// Restricted Voronoi cells in the plane: every Voronoi cell cut by the disc around its point.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"
#include "rings2.hpp"

namespace alphamesh {

// The borders of the cells, counter-clockwise, piece after piece; the end of a piece is
// the start of the next to the last bit. A segment lies between two cells, an arc on the
// circle around the point of its cell. A cell that nothing cuts is one arc of a full turn.
struct RestrictedCells2 {
  Buffer<std::int64_t> offset;    // (n + 1): pieces of each row; none for merged duplicates
  Buffer<Point2> start, end;      // (k)
  Buffer<std::int32_t> neighbor;  // (k): the row across a segment, -1 for an arc
  Buffer<double> angles;          // (k, 2): start and end of an arc, end > start; NaN for a segment
  Buffer<double> straight_area;   // (n): without the sectors, half arc_length times radius
  Buffer<double> segment_length;  // (n)
  Buffer<double> arc_length;      // (n)
};

// Which segments, ends and arcs there are follows from the alpha complex, which is exact
// (nerve theorem; Edelsbrunner 1995): two cells share a segment if and only if it has their
// edge, three share a corner if and only if it has their triangle. Only positions and
// measures are rounded. `active` tells which rows stand for themselves. With weights, the cells
// are those of the power diagram, and the disc of row v has the squared radius w_v + a for
// the power parameter a of `radius`, its signed root.
RestrictedCells2 restricted2(const ComplexView2& view, const bool* has_triangle,
                             const bool* has_edge, const bool* active, double radius, Job& job);

}  // namespace alphamesh
