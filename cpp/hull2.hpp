// The convex hull in the plane.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"

namespace alphamesh {

// Rows of the corners, counter-clockwise from the lexicographically least one; also of the
// points between them if `collinear`. When all points lie on a line: its two ends, or all
// points in their order. Of points with equal coordinates the lowest row. Throws
// BadCoordinates.
Buffer<std::int32_t> hull2(const double* xy, std::size_t n, bool collinear, Job& job);

}  // namespace alphamesh
