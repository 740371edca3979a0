// Volume and surface area of a union of balls, ball by ball and void by void.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"

namespace alphamesh {

// A complex in space, and which of its simplices the alpha complex has at one radius.
struct BallsView {
  const double* points;   // (n, 3)
  const double* weights;  // (n), or null: squared radii are weights + power
  std::size_t n;
  double power;
  const bool* has_vertex;     // (n)
  const std::int32_t* edges;  // (E, 2), each ascending
  const bool* has_edge;
  std::size_t edge_count;
  const std::int32_t* triangles;            // (F, 3), each ascending
  const std::int32_t* triangle_edges;       // (F, 3): opposite to each corner
  const std::int32_t* triangle_tetrahedra;  // (F, 2), -1 for none
  const bool* has_triangle;
  std::size_t triangle_count;
  const std::int32_t* tetrahedra;             // (T, 4), each ascending
  const std::int32_t* tetrahedron_triangles;  // (T, 4): opposite to each corner
  const bool* has_tetrahedron;
  const std::int32_t* hollow;  // (T): number of the void that it lies in, -1 for none
  std::size_t tetrahedron_count, void_count;
};

struct UnionOfBalls3 {
  Buffer<double> volumes;        // (n): of the ball in its power cell
  Buffer<double> surface_areas;  // (n): of its part of the boundary
  Buffer<double> void_volumes;   // (voids)
  Buffer<double> void_areas;     // (voids)
  double volume = 0.0;
};

UnionOfBalls3 union3(const BallsView& view, Job& job);

}  // namespace alphamesh
