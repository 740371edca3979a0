// Filtration values of tetrahedra and triangles in space, and who is attached to whom, a
// block at a time; see values2.hpp.
//
// Vertices come in an order that depends on the points alone, as the lexicographic one, so
// that a value is the same to the last bit wherever the simplex is met. Radii are in the
// units of the input: `exponent` is what its coordinates were scaled by.
#pragma once

#include <cstddef>
#include <cstdint>

#include "predicates3.hpp"

namespace alphamesh {

class TetrahedronBlock {
 public:
  static constexpr std::size_t kSize = 64;

  std::size_t count = 0;
  double radius[kSize];
  // Bit k: vertex k lies in or on the smallest sphere through the others.
  std::uint8_t attached[kSize];
  // For the facet opposite to vertex k, two bits at 2k: its vertex with an obtuse angle, or
  // k if there is none.
  std::uint8_t obtuse[kSize];

  void push(Point3 a, Point3 b, Point3 c, Point3 d);
  void measure(const Lattice3& lattice, int exponent);

 private:
  void evaluate(const Lattice3& lattice);
  void settle_sides(std::size_t i, const Lattice3& lattice);
  void settle_angles(std::size_t i, const Lattice3& lattice);
  void corners(std::size_t i, Point3* p) const;

  double x_[4][kSize], y_[4][kSize], z_[4][kSize];
  // 1 where a value is not good enough; sums of flags as numbers.
  double bad_radius_[kSize], bad_side_[kSize], bad_angle_[kSize];
  double attached_[kSize], obtuse_[kSize];
};

class FlatBlock {
 public:
  static constexpr std::size_t kSize = 64;

  std::size_t count = 0;
  double radius[kSize];
  std::int32_t obtuse[kSize];  // the vertex with an obtuse angle, or 3

  void push(Point3 a, Point3 b, Point3 c);
  // On a sheet along two axes, all is the same as in the plane, to the last bit.
  void measure(const Lattice3& lattice, int exponent);

 private:
  void evaluate();
  void measure_carefully(std::size_t i, const Lattice3& lattice, int exponent);

  double x_[3][kSize], y_[3][kSize], z_[3][kSize];
  double angle_[3][kSize], doubtful_[kSize];
};

inline void TetrahedronBlock::push(Point3 a, Point3 b, Point3 c, Point3 d) {
  const Point3 p[4] = {a, b, c, d};
  for (int k = 0; k < 4; ++k) {
    x_[k][count] = p[k].x;
    y_[k][count] = p[k].y;
    z_[k][count] = p[k].z;
  }
  ++count;
}

inline void FlatBlock::push(Point3 a, Point3 b, Point3 c) {
  const Point3 p[3] = {a, b, c};
  for (int k = 0; k < 3; ++k) {
    x_[k][count] = p[k].x;
    y_[k][count] = p[k].y;
    z_[k][count] = p[k].z;
  }
  ++count;
}

}  // namespace alphamesh
