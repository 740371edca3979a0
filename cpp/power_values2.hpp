// Filtration values of weighted triangles and edges, a block at a time; as values2.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "power2.hpp"
#include "power_values3.hpp"
#include "values2.hpp"

namespace alphamesh {

// Power values suffer where the squared radius and the weight nearly cancel. Values whose
// error may exceed 2^-46 of the power value, so 2^-47 of the radius, are computed again in
// double-double, and exactly where that is not enough.
//
// On a sheet in space, values and what is attached are those that power_values3.hpp gives to the
// same simplices, to the last bit: a part of a cloud may lie in a plane while the whole does not.
template <class P>
class PowerTriangles {
 public:
  static constexpr std::size_t kSize = TriangleBlock::kSize;

  std::size_t count = 0;
  double radius[kSize];          // signed roots, in the units of the input
  std::int32_t attached[kSize];  // bit i: the edge from vertex i to i + 1, as the apex is in
                                 // its power circle or, but for sheets, on it

  // Vertices counter-clockwise.
  void push(const Weighted<P>& a, const Weighted<P>& b, const Weighted<P>& c);
  void measure(const Lattice& lattice, int exponent);

 private:
  static constexpr int kDim = std::is_same_v<P, Point2> ? 2 : 3;
  struct Nothing {};

  static bool is_attached(int side) { return kDim == 2 ? side <= 0 : side < 0; }
  void evaluate(const Lattice& lattice);
  Weighted<P> corner(std::size_t i, int k) const;

  double x_[3][kDim][kSize], w_[3][kSize];
  std::int32_t first_[kSize];
  double mask_[kSize], bad_value_[kSize], bad_side_[kSize];
  std::conditional_t<kDim == 3, PowerTriangles3, Nothing> in_space_;
};

template <class P>
class PowerEdges {
 public:
  double radius[EdgeBlock::kSize];  // signed roots, not those of the input's units

  void set(std::size_t i, const Weighted<P>& a, const Weighted<P>& b);
  void measure(std::size_t count, const Lattice& lattice);

 private:
  Weighted<P> a_[EdgeBlock::kSize], b_[EdgeBlock::kSize];
  double length_sq_[EdgeBlock::kSize], aw_[EdgeBlock::kSize], bw_[EdgeBlock::kSize];
  double bad_[EdgeBlock::kSize];
};

}  // namespace alphamesh
