// Filtration values of triangles and edges, a block at a time.
//
// The arithmetic of a block is one loop without branches over separate arrays, which
// compilers turn into vector instructions; the few triangles for which it is not good
// enough are done again, carefully.
#pragma once

#include <cstddef>
#include <cstdint>

#include "predicates2.hpp"

namespace alphamesh {

struct TriangleBlock {
  static constexpr std::size_t kSize = 64;
  static constexpr std::int32_t kNoEdge = 3;

  std::size_t count = 0;
  double radius[kSize];
  std::int32_t obtuse[kSize];  // the edge (0, 1, 2: from vertex i to i + 1) opposite to an obtuse
                               // angle, or 3

  // Vertices counter-clockwise.
  void push(Point2 a, Point2 b, Point2 c);
  // Radii in the units of the input: `exponent` is what its coordinates were scaled by.
  void measure(const Lattice& lattice, int exponent);

 private:
  void evaluate();
  void measure_carefully(std::size_t i, const Lattice& lattice, int exponent);

  // Vertices from the lexicographically least one on, so that the result does not depend
  // on where the triangle began, to the last bit; `first` tells which one it was.
  double ax_[kSize], ay_[kSize], bx_[kSize], by_[kSize], cx_[kSize], cy_[kSize];
  std::int32_t first_[kSize];
  // Scalar products at the three angles, and 1 where the values are not good enough.
  double at_a_[kSize], at_b_[kSize], at_c_[kSize], doubtful_[kSize];
};

struct EdgeBlock {
  static constexpr std::size_t kSize = 3 * TriangleBlock::kSize + 3;

  double dx[kSize], dy[kSize];
  double half_length[kSize];

  void set(std::size_t i, Point2 a, Point2 b) {
    dx[i] = a.x - b.x;
    dy[i] = a.y - b.y;
  }
  void measure(std::size_t count);
};

// Circumradius of the triangle with squared sides u, v, w and twice the area `det`, times
// 2^exponent, where the plain formula leaves the range of doubles.
double circumradius_scaled(double u, double v, double w, double det, int exponent);
// The range of squared radii where it does not.
constexpr double kLargeSq = 0x1p1000, kSmallSq = 0x1p-900;

inline bool lexicographic(Point2 a, Point2 b) {  // a < b, without a branch
  return (a.x < b.x) | ((a.x == b.x) & (a.y < b.y));
}

inline void TriangleBlock::push(Point2 a, Point2 b, Point2 c) {
  const Point2 p[5] = {a, b, c, a, b};
  std::int32_t first = lexicographic(b, a);
  first = lexicographic(c, p[first]) ? 2 : first;
  const Point2* q = p + first;
  ax_[count] = q[0].x;
  ay_[count] = q[0].y;
  bx_[count] = q[1].x;
  by_[count] = q[1].y;
  cx_[count] = q[2].x;
  cy_[count] = q[2].y;
  first_[count++] = first;
}

}  // namespace alphamesh
