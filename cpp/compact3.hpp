// From the slots of a triangulation to rows in an order that depends on the cloud alone.
#pragma once

#include <cstddef>
#include <cstdint>

#include "delaunay3.hpp"
#include "memory.hpp"
#include "parallel.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {

// The tetrahedra without ghosts: by their first vertex along the curve, then by the others.
// Vertices stand in lexicographic order of their points, so that the three of a common
// facet stand in the same order on both sides. neighbor[4t + i] as in Tetrahedron, -1
// beyond the hull.
struct Compact3 {
  std::size_t count = 0;
  Buffer<std::int32_t> vertex, neighbor;  // (count, 4)
};

Compact3 compact3(const SpatialOrder3& order, Mesh3&& mesh, Job& job);

// The same tetrahedra as rows of the input's numbers, ascending, each neighbour opposite to
// its vertex still, as numbers of tetrahedra without the facet.
Compact3 rows3(const SpatialOrder3& order, Mesh3&& mesh, Job& job);

}  // namespace alphamesh
