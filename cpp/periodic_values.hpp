// Filtration values of the simplices of a periodic complex.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "memory.hpp"
#include "parallel.hpp"
#include "quotient.hpp"

namespace alphamesh {

// Where the vertices of a Layer are: row r with offset o lies at anchor[r] + (o + shift[r])
// periods, exactly. All numbers are below 2^100 and multiples of 2^-170, weights below 2^200
// and multiples of 2^-340.
struct PeriodicBox {
  const double* anchor;      // (rows, 3)
  const std::int8_t* shift;  // (rows, 3)
  const double* weight;      // (rows,), or null
  double period[3];          // zero where the box is open
  int exponent;              // what all was scaled by
};

// Radii of each layer, signed roots of power values where there are weights. See
// Filtration2 for what they mean; none decreases from face to coface.
std::vector<Buffer<double>> periodic_radii(const PeriodicBox& box, const std::vector<Layer>& layers,
                                           Job& job);

}  // namespace alphamesh
