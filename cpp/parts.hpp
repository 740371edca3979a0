// Connected parts of the cells of a triangulation, in any dimension.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"

namespace alphamesh {

// Numbers the connected parts of the cells that are `inside` (cells,), and of the others;
// cells are connected by facets, whose one or two cells stand in `facet_cells` (facets, 2),
// -1 for none. A facet that is a `wall` (facets,) connects nothing outside; null for no
// walls. Returns (cells,): parts of the inside are 0, 1, ... in the order of their first
// cells, the one around everything is -1, and enclosed ones are -2, -3, ...
Buffer<std::int32_t> parts(std::size_t cells, const std::int32_t* facet_cells, std::size_t facets,
                           const bool* inside, const bool* wall, Job& job);

}  // namespace alphamesh
