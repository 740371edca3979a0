// Sets of triangles: the rings that bound them.
#pragma once

#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"
#include "rings2.hpp"

namespace alphamesh {

// Closed walks with their region on the left: an outer ring runs counter-clockwise, a hole
// clockwise. Rings are sorted by region, outer rings first, and start at their
// lexicographically least vertex.
struct Outlines2 {
  Buffer<std::int64_t> offset;  // (m + 1): where the corners of ring i begin
  Buffer<std::int32_t> row;     // (k,) corners; the first is not repeated
  Buffer<std::int32_t> edge;    // (k,) from each corner to the next one of the ring
  Buffer<std::int32_t> region;  // (m,)
  Buffer<bool> hole;            // (m,)
};

// Traces the border of each region. `region` (T,) numbers the triangles; those below zero
// belong to none. If the triangles of a region are connected by edges, then no ring passes
// a vertex twice, and one ring is the outer one. Points must be within the direct range.
Outlines2 outlines2(const ComplexView2& view, const std::int32_t* region, Job& job);

}  // namespace alphamesh
