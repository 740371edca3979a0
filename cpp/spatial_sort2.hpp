// From raw coordinates to distinct points in Morton order, with the keys that later
// serve as cuts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "memory.hpp"
#include "parallel.hpp"
#include "predicates2.hpp"

namespace alphamesh {

// A coordinate that is not finite, or a range of exponents too wide for exact products.
struct BadCoordinates : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

// Mesh ids are 32-bit numbers, eight to a triangle.
constexpr std::size_t kMaxPoints2 = std::size_t{1} << 27;

// Distinct points in spatial order. Nothing here depends on the order of the input but
// `row` and `representative`.
struct SpatialOrder2 {
  std::size_t size = 0;                 // number of distinct points
  Buffer<Point2> points;                // scaled by 2^exponent
  Buffer<std::int32_t> row;             // lowest input row of each point
  Buffer<std::uint64_t> key;            // two Morton codes, coarse and fine; ascending
  Buffer<std::int32_t> representative;  // per input row; empty if all are distinct
  int exponent = 0;
  Lattice lattice;
};

// Exponent of the power of two that brings a few points into the range of exact products;
// nearly always 0.
int range_exponent2(const double* xy, std::size_t n, Job& job);

SpatialOrder2 spatial_order2(const double* xy, std::size_t n, Job& job);

}  // namespace alphamesh
