// From raw coordinates to distinct points along a space-filling curve.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "memory.hpp"
#include "parallel.hpp"
#include "predicates2.hpp"
#include "predicates3.hpp"

namespace alphamesh {

// A coordinate that is not finite, or a range of exponents too wide for exact products.
struct BadCoordinates : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

// What differs between the plane and space. No product of the predicates leaves the range
// of doubles, nor loses a bit at its lower end, if coordinates stay below 2^kTop and are
// multiples of 2^kBottom. Weights are squares: with them, products are longer, the limits
// closer, and hold for coordinates and for roots of weights. Codes of a cell have kDim kBits
// bits, 32 at most.
struct Plane {
  using Point = Point2;
  using Ties = Lattice;
  static constexpr int kDim = 2, kTop = 250, kBottom = -240, kBits = 16;
  static constexpr int kWeightedTop = 165, kWeightedBottom = -160;
  static std::uint32_t code(const std::uint32_t* cell, int bits);  // Morton: serves as cuts
  static Point point(const double* v) { return {v[0], v[1]}; }
};

struct Space {
  using Point = Point3;
  using Ties = Lattice3;
  static constexpr int kDim = 3, kTop = 165, kBottom = -160, kBits = 10;
  static constexpr int kWeightedTop = 165, kWeightedBottom = -160;
  static std::uint32_t code(const std::uint32_t* cell, int bits);  // Hilbert
  static Point point(const double* v) { return {v[0], v[1], v[2]}; }
};

// Mesh ids are 32-bit numbers, eight to a triangle, four to a tetrahedron.
constexpr std::size_t kMaxPoints2 = std::size_t{1} << 27;
constexpr std::size_t kMaxPoints3 = std::size_t{1} << 26;

// Distinct points in the order of the curve. Nothing here depends on the order of the
// input but `row` and `representative`.
template <class S>
struct SpatialOrder {
  std::size_t size = 0;                 // number of distinct points
  Buffer<typename S::Point> points;     // scaled by 2^exponent
  Buffer<double> weight;                // scaled by 4^exponent; empty if there are none
  Buffer<std::int32_t> row;             // input row of each point: the heaviest, then lowest one
  Buffer<std::uint64_t> key;            // two codes, coarse and fine; ascending
  Buffer<std::int32_t> representative;  // per input row; empty if all are distinct
  int exponent = 0;
  typename S::Ties lattice;
};

using SpatialOrder2 = SpatialOrder<Plane>;
using SpatialOrder3 = SpatialOrder<Space>;

// `v` holds n rows of S::kDim coordinates, `weight` a number for each row, if anything. The
// lattice is one of the weights, too: they are multiples of its squared unit.
template <class S>
SpatialOrder<S> spatial_order(const double* v, std::size_t n, Job& job,
                              const double* weight = nullptr);

// Exponent of the power of two that brings a few points into range; nearly always 0.
template <class S>
int range_exponent(const double* v, std::size_t n, Job& job);

inline SpatialOrder2 spatial_order2(const double* v, std::size_t n, Job& job,
                                    const double* weight = nullptr) {
  return spatial_order<Plane>(v, n, job, weight);
}
inline SpatialOrder3 spatial_order3(const double* v, std::size_t n, Job& job,
                                    const double* weight = nullptr) {
  return spatial_order<Space>(v, n, job, weight);
}

}  // namespace alphamesh
