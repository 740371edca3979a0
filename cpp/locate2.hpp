// Point location: which triangle holds a point.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"

namespace alphamesh {

// A Delaunay triangulation as output2.hpp made it, back from the caller.
struct TriangulationView2 {
  const double* points;
  std::size_t n;
  const std::int32_t* triangles;  // (T, 3), ascending
  const std::int32_t* neighbors;  // (T, 3), -1 on the hull
  std::size_t triangle_count;
};

// For each query the lowest of the triangles, closed ones, that hold it; -1 if none does.
// Throws BadCoordinates, also where points and queries are too far apart in scale.
Buffer<std::int32_t> locate2(const TriangulationView2& view, const double* queries, std::size_t m,
                             Job& job);

}  // namespace alphamesh
