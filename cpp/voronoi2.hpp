// Vertices of the Voronoi diagram in the plane.
#pragma once

#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"
#include "rings2.hpp"

namespace alphamesh {

// One vertex for each triangle: its circumcentre; with weights its orthocentre, a vertex of the
// power diagram. The triangles of cocircular points have
// theirs in one place, to the last bit, and a common group: the lowest of their numbers.
struct VoronoiVertices2 {
  Buffer<Point2> position;     // (T)
  Buffer<std::int32_t> group;  // (T)
};

VoronoiVertices2 voronoi_vertices2(const ComplexView2& view, Job& job);

}  // namespace alphamesh
