// Connected parts of the cells of a periodic box, and in how many directions each runs on.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"

namespace alphamesh {

// Cells as a PeriodicFiltration lists them: the first vertex of each has offset zero.
struct BoxCells {
  const std::int8_t* second;  // (count, 3): the offset of the second vertex
  const std::int32_t* face;   // (count, columns): the facet opposite to each vertex
  std::size_t count, columns;
  const std::int32_t* cofaces;  // (facets, 2), -1 for none
  std::size_t facets;
};

struct WoundParts {
  Buffer<std::int32_t> part;  // of each cell, in the order of their first cells; or -1
  Buffer<std::int8_t> rank;   // of each part
};

// The parts of the cells that are not `inside`, joined by facets that are no `wall`. Those that
// reach an open border are left out, as are cells inside. Seen in all of space, a part is
// carried onto itself by the lattice vectors of some sublattice: its rank is 0 for what is
// bounded, else the number of independent directions in which it goes on without end.
WoundParts wound_parts(const BoxCells& cells, const bool* inside, const bool* wall, Job& job);

}  // namespace alphamesh
