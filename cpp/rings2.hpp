// A triangulation read back from its flat arrays: edges of triangles, orientation, and
// the triangles around each vertex in order.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"
#include "predicates2.hpp"

namespace alphamesh {

// What output2.hpp made, as it comes back from the caller. Rows are points of the cloud.
struct ComplexView2 {
  const double* points;
  std::size_t n;
  const std::int32_t* triangles;  // (T, 3), ascending
  std::size_t triangle_count;
  const std::int32_t* edges;  // (E, 2), ascending
  std::size_t edge_count;
  const std::int32_t* edge_triangles;  // (E, 2)
  const double* weights = nullptr;     // (n), null for balls of equal size

  double weight(std::int32_t row) const { return weights == nullptr ? 0.0 : weights[row]; }
  Point2 point(std::int32_t row) const { return {points[2 * row], points[2 * row + 1]}; }
  std::int32_t across(std::int32_t edge, std::int32_t triangle) const {
    const std::int32_t* t = edge_triangles + 2 * edge;
    return t[0] == triangle ? t[1] : t[0];
  }
  std::int32_t other_end(std::int32_t edge, std::int32_t row) const {
    const std::int32_t* e = edges + 2 * edge;
    return e[0] == row ? e[1] : e[0];
  }
};

// Counter-clockwise around each vertex: its edges, and after edge i the triangle between
// it and the next edge. Rings of inner vertices are closed and have as many triangles as
// edges; on the hull the triangle after the last edge is -1, and so it is everywhere when
// all points lie on a line.
struct Rings2 {
  Buffer<std::int64_t> offset;    // (n + 1)
  Buffer<std::int32_t> edge;      // (2E)
  Buffer<std::int32_t> triangle;  // (2E)
  Buffer<std::int32_t> order;     // (n): all rows, in an order that keeps neighbors together
};

// (T, 3): the edge opposite to each vertex of a row.
Buffer<std::int32_t> triangle_edges2(const ComplexView2& view, Job& job);

Rings2 rings2(const ComplexView2& view, const Buffer<std::int32_t>& triangle_edges, Job& job);

// Circumcentres (T, 2), good to a few ulp of radius and coordinates even on slivers; with
// weights orthocentres, to a few ulp of what they would be with the roots of these for sides.
Buffer<Point2> circumcentres2(const ComplexView2& view, Job& job);

}  // namespace alphamesh
