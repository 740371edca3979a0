// Points on their way to tiles: down a tree of cuts, to both sides where they are near one.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"

namespace alphamesh {

// Node i sends a point to below[i] if its coordinate along axes[i] is less than low[i], and
// to above[i] if it is not less than high[i] <= low[i]. A negative number -1 - t stands for
// tile t; without nodes, all is tile 0.
struct Cuts {
  const std::int64_t *axes, *below, *above;
  const double *low, *high;
  std::size_t nodes;
};

struct Spread {
  Buffer<std::int64_t> offsets;  // (tiles + 1,)
  Buffer<std::int32_t> rows;     // those of a tile ascend
  Buffer<double> points;         // (rows, dim)
};

Spread spread(const double* v, std::size_t n, std::size_t dim, const Cuts& cuts, Job& job);

// A checksum of some bytes, that of what comes before going in: a change within eight
// bytes at a multiple of eight is surely seen, another one but for a chance of 2^-64.
std::uint64_t checksum(const std::uint8_t* bytes, std::size_t n, std::uint64_t before);

}  // namespace alphamesh
