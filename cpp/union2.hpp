// Area and perimeter of a union of discs, disc by disc and hole by hole.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"

namespace alphamesh {

// A complex in the plane, and which of its simplices the alpha complex has at one radius.
struct DiscsView {
  const double* points;   // (n, 2)
  const double* weights;  // (n), or null: squared radii are weights + power
  std::size_t n;
  double power;
  const bool* has_vertex;     // (n)
  const std::int32_t* edges;  // (E, 2), each ascending
  const bool* has_edge;
  const std::int32_t* edge_triangles;  // (E, 2), -1 for none
  std::size_t edge_count;
  const std::int32_t* triangles;       // (T, 3), each ascending
  const std::int32_t* triangle_edges;  // (T, 3): opposite to each corner
  const bool* has_triangle;
  const std::int32_t* hole;  // (T): number of the hole that a triangle lies in, -1 for none
  std::size_t triangle_count, hole_count;
};

struct UnionOfDiscs2 {
  Buffer<double> areas;            // (n): of the disc in its power cell
  Buffer<double> perimeters;       // (n): of its arcs on the boundary
  Buffer<double> hole_areas;       // (holes)
  Buffer<double> hole_perimeters;  // (holes)
  double area = 0.0;
};

UnionOfDiscs2 union2(const DiscsView& view, Job& job);

}  // namespace alphamesh
