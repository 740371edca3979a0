// Is a periodic triangulation the Delaunay triangulation of its points? Exactly.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"
#include "periodic_values.hpp"

namespace alphamesh {

// Cells of D + 1 vertices as in a Layer, and the one or two cells of each facet.
struct PeriodicCells {
  const std::int32_t* row;
  const std::int8_t* offset;
  const std::int32_t* face;
  std::size_t count;
  const std::int32_t* cofaces;
  std::size_t facets;
};

constexpr std::int8_t kSound = 0, kFlat = 1, kFolded = 2, kNotDelaunay = 3;

// Per facet: kFlat if one of its cells is, kFolded if both lie on the same side of it,
// kNotDelaunay if the far vertex of one is in conflict with the other.
template <int D>
Buffer<std::int8_t> check_facets(const PeriodicBox& box, const PeriodicCells& cells, Job& job);

}  // namespace alphamesh
