// Simplices of a periodic triangulation, each once: what is left when translations by whole
// periods are taken out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "memory.hpp"
#include "parallel.hpp"

namespace alphamesh {

// Copies of points: copy i stands for row[i], moved by offset[3 i ...] periods, in -100 ... 100.
// The first `base` of them are those in one box.
struct Copies {
  const std::int32_t* row;
  const std::int8_t* offset;
  std::size_t base;
  std::size_t rows;
};

// Simplices of one dimension K, vertices ascending by row, then by offset; the first has
// offset zero. They come in that order, too.
struct Layer {
  std::size_t count = 0;
  Buffer<std::int32_t> row;    // (count, K + 1)
  Buffer<std::int8_t> offset;  // (count, K + 1, 3), in -1 ... 1
  Buffer<std::int32_t>
      face;  // (count, K + 1): the face opposite to each vertex, in the layer below
};

// The layers from vertices to cells. `cells` are `count` tuples of D + 1 copies, all that
// have a vertex in the box at least; in no cell do two vertices lie more than a period apart.
template <int D>
std::vector<Layer> quotient(const Copies& copies, const std::int32_t* cells, std::size_t count,
                            Job& job);

// The one or two cells of each facet, (facets, 2), -1 for none; never one twice, as no
// translation moves a facet of a simplex to another one of the same.
Buffer<std::int32_t> cofaces(const Layer& cells, std::size_t columns, std::size_t facets);

}  // namespace alphamesh
