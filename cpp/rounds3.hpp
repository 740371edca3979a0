// The order of insertion.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "memory.hpp"

namespace alphamesh {

// Rounds of growing size, drawn at random, each along the curve (Amenta, Choi & Rote 2003);
// round k is [start[k], start[k + 1]).
struct Rounds {
  std::vector<std::size_t> start;
  Buffer<std::int32_t> point;
};

Rounds plan_rounds(std::size_t n);

}  // namespace alphamesh
