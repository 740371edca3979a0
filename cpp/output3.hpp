// From the triangulated 3-sphere to flat arrays in the numbers of the input's rows.
#pragma once

#include <cstddef>
#include <cstdint>

#include "delaunay3.hpp"
#include "memory.hpp"
#include "parallel.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {

// The tetrahedra without ghosts in an order that depends on the cloud alone: by their
// first vertex along the curve, then by the others. Vertices stand in lexicographic order
// of their points; neighbor[i] as in Tetrahedron, -1 beyond the hull.
Buffer<Tetrahedron> compact3(const SpatialOrder3& order, Mesh3&& mesh, Job& job);

// Rows of vertex numbers ascend. The order of the rows depends on the cloud alone.
struct Filtration3 {
  Buffer<std::int32_t> tetrahedra;           // (T, 4)
  Buffer<double> tetrahedron_radii;          // (T,)
  Buffer<std::int32_t> triangles;            // (F, 3)
  Buffer<double> triangle_radii;             // (F,)
  Buffer<std::int32_t> triangle_tetrahedra;  // (F, 2), -1 where there is none
  Buffer<std::int32_t> edges;                // (E, 2)
  Buffer<double> edge_radii;                 // (E,)
};

// The alpha filtration (Edelsbrunner & Muecke 1994), see Filtration2. `mesh` comes from
// compact3().
Filtration3 filtration3(const SpatialOrder3& order, const Buffer<Tetrahedron>& mesh, Job& job);

}  // namespace alphamesh
