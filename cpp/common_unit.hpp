// What numbers are multiples of.
#pragma once

#include <cstddef>
#include <limits>

#include "parallel.hpp"

namespace alphamesh {

constexpr int kMantissa = 52;
constexpr int kNoUnit = std::numeric_limits<int>::max();  // all numbers are zero

// The least exponent of a unit that all numbers are multiples of; the search stops once
// it is `enough` or less.
int common_unit(const double* v, std::size_t n, int enough, Job& job);

}  // namespace alphamesh
