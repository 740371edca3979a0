// From the slots of a triangulation to rows in an order that depends on the cloud alone.
#pragma once

#include "delaunay3.hpp"
#include "memory.hpp"
#include "parallel.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {

// The tetrahedra without ghosts in an order that depends on the cloud alone: by their
// first vertex along the curve, then by the others. Vertices stand in lexicographic order
// of their points; neighbor[i] as in Tetrahedron, -1 beyond the hull.
Buffer<Tetrahedron> compact3(const SpatialOrder3& order, Mesh3&& mesh, Job& job);

}  // namespace alphamesh
