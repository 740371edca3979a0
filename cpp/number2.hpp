// From the slots of an insertion to a triangulation without gaps.
#pragma once

#include <cstddef>

#include "delaunay2.hpp"
#include "memory.hpp"
#include "parallel.hpp"

namespace alphamesh {

// Triangles and ghosts come by their lowest vertices, then by the others; a triangle begins
// with its lowest vertex. `m` holds `slots` triangles of points 0 ... n - 1, see Slots2.
Mesh2 numbered2(Buffer<std::int32_t>&& m, std::size_t slots, std::size_t n, Job& job);

}  // namespace alphamesh
