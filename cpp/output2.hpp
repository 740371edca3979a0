// From the triangulated sphere to flat arrays in the numbers of the input's rows.
#pragma once

#include <cstddef>
#include <cstdint>

#include "delaunay2.hpp"
#include "memory.hpp"
#include "parallel.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {

// Rows of vertex numbers ascend. The order of the rows depends on the cloud alone.
struct Triangulation2 {
  Buffer<std::int32_t> triangles;  // (T, 3)
  Buffer<std::int32_t> neighbors;  // (T, 3), opposite to each vertex; -1 beyond the hull
  Buffer<std::int32_t> edges;      // (n - 1, 2), the path, if there is no triangle
};

struct Filtration2 {
  Buffer<std::int32_t> triangles;       // (T, 3)
  Buffer<double> triangle_radii;        // (T,)
  Buffer<std::int32_t> edges;           // (E, 2)
  Buffer<double> edge_radii;            // (E,)
  Buffer<std::int32_t> edge_triangles;  // (E, 2), -1 where there is none
};

Triangulation2 triangulation2(const SpatialOrder2& order, Mesh2& mesh, Job& job);

// The alpha filtration (Edelsbrunner, Kirkpatrick & Seidel 1983; Edelsbrunner & Muecke
// 1994): a triangle enters with its circumradius, an edge with half its length if no
// apex lies inside the circle on it (Gabriel), else with its first triangle. S as in
// delaunay2() or, for power values in their place, in regular2().
template <class S>
Filtration2 filtration2(const SpatialOrder<S>& order, Mesh2& mesh, Job& job);

}  // namespace alphamesh
