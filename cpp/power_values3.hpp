// Filtration values of weighted simplices in space, and who is attached to whom, a block at a
// time; see values3.hpp and power3.hpp.
//
// Radii are signed roots of power values, which are the square of a distance less a weight. Where
// the two nearly cancel, where a simplex is nearly flat, and where a sign is in doubt, the block's
// arithmetic is checked by a bound on its error and done again with more digits: the relative
// error of a radius stays below 5e-13, however small it is.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "power3.hpp"

namespace alphamesh {

class PowerTetrahedra {
 public:
  static constexpr std::size_t kSize = 64;

  std::size_t count = 0;
  double radius[kSize];
  // Bit k: the facet opposite to vertex k is attached, or has the same orthocentre.
  std::uint8_t attached[kSize];
  // Bit 4k + m: in the facet opposite to vertex k the edge opposite to vertex m is attached.
  std::uint16_t sides[kSize];

  void push(const Weighted3& a, const Weighted3& b, const Weighted3& c, const Weighted3& d);
  void measure(const Lattice3& lattice, int exponent);

 private:
  void evaluate(const Lattice3& lattice);
  void evaluate_edges(const Lattice3& lattice);
  void settle_facets(std::size_t i, const Lattice3& lattice);
  void settle_edges(std::size_t i, const Lattice3& lattice);
  void corners(std::size_t i, Weighted3* p) const;

  double x_[4][kSize], y_[4][kSize], z_[4][kSize], w_[4][kSize];
  // 1 where a value is not good enough; sums of flags as numbers.
  double bad_radius_[kSize], bad_facet_[kSize], bad_edge_[kSize];
  double attached_[kSize], sides_[kSize];
};

class PowerTriangles3 {
 public:
  static constexpr std::size_t kSize = 64;

  std::size_t count = 0;
  double radius[kSize];

  void push(const Weighted3& a, const Weighted3& b, const Weighted3& c);
  void measure(const Lattice3& lattice, int exponent);

 private:
  void evaluate();

  double x_[3][kSize], y_[3][kSize], z_[3][kSize], w_[3][kSize], doubtful_[kSize];
};

// Of an edge.
double power_radius(const Weighted3& a, const Weighted3& b, const Lattice3& lattice, int exponent);

inline void PowerTetrahedra::push(const Weighted3& a, const Weighted3& b, const Weighted3& c,
                                  const Weighted3& d) {
  const Weighted3 p[4] = {a, b, c, d};
  for (int k = 0; k < 4; ++k) {
    x_[k][count] = p[k].x;
    y_[k][count] = p[k].y;
    z_[k][count] = p[k].z;
    w_[k][count] = p[k].weight;
  }
  ++count;
}

inline void PowerTriangles3::push(const Weighted3& a, const Weighted3& b, const Weighted3& c) {
  const Weighted3 p[3] = {a, b, c};
  for (int k = 0; k < 3; ++k) {
    x_[k][count] = p[k].x;
    y_[k][count] = p[k].y;
    z_[k][count] = p[k].z;
    w_[k][count] = p[k].weight;
  }
  ++count;
}

}  // namespace alphamesh
