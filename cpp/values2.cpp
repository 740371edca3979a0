#include "values2.hpp"

#include <algorithm>
#include <cmath>

namespace alphamesh {

double circumradius_scaled(double u, double v, double w, double det, int exponent) {
  int eu, ev, ew, ed;
  const double m = std::frexp(std::sqrt(u), &eu) * std::frexp(std::sqrt(v), &ev) *
                   std::frexp(std::sqrt(w), &ew) / std::frexp(det, &ed);
  return std::ldexp(m, eu + ev + ew - ed - 1 + exponent);
}

// R^2 = u v w / (4 det^2), u, v, w the squared sides. The order of the factors makes b and c
// alike: as seen from the other side of a plane in space, the value is the same. The differences
// and so the sides are good to an ulp or two; det has a relative error of at most 4 eps (|l| + |r|)
// / |det|. At most one angle is not acute, the one with the least scalar product, whose sign is
// sure beyond the bound of dot(), which the longest side squared bounds in turn.
void TriangleBlock::evaluate() {
  for (std::size_t i = 0; i < count; ++i) {
    const double ux = bx_[i] - ax_[i], uy = by_[i] - ay_[i];
    const double vx = cx_[i] - bx_[i], vy = cy_[i] - by_[i];
    const double wx = ax_[i] - cx_[i], wy = ay_[i] - cy_[i];
    const double u = ux * ux + uy * uy, v = vx * vx + vy * vy, w = wx * wx + wy * wy;
    const double at_a = -(ux * wx + uy * wy), at_b = -(ux * vx + uy * vy),
                 at_c = -(vx * wx + vy * wy);
    const double uv = u > v ? u : v, longest = uv > w ? uv : w;
    const double ab = at_a < at_b ? at_a : at_b, least = ab < at_c ? ab : at_c;
    const double l = uy * wx, r = ux * wy, det = l - r;
    const double radius_sq = 0.25 * ((u / det) * (w / det) * v), quarter = 0.25 * longest;
    at_a_[i] = at_a;
    at_b_[i] = at_b;
    at_c_[i] = at_c;
    // A radius is at least half of the longest side: true in exact arithmetic, so enforced.
    radius[i] = std::sqrt(radius_sq > quarter ? radius_sq : quarter);
    double sure = std::fabs(least) > 4.0 * kEps * longest ? 1.0 : 0.0;
    sure = std::fabs(det) * 16.0 >= std::fabs(l) + std::fabs(r) ? sure : 0.0;
    sure = radius_sq < kLargeSq ? sure : 0.0;
    sure = radius_sq > kSmallSq ? sure : 0.0;
    doubtful_[i] = 1.0 - sure;
  }
}

void TriangleBlock::measure(const Lattice& lattice, int exponent) {
  evaluate();
  const PowerOfTwo unscale(-exponent);
  for (std::size_t i = 0; i < count; ++i) {
    // Opposite to a is the edge from b, which is edge first + 1, and so on.
    const bool b = at_b_[i] < 0.0, c = at_c_[i] < 0.0;
    const std::int32_t edge = first_[i] + 1 + b + 2 * c, wrapped = edge - (edge > 2 ? 3 : 0);
    obtuse[i] = ((at_a_[i] < 0.0) | b | c) ? wrapped : kNoEdge;
    radius[i] = unscale * radius[i];
    if (doubtful_[i] != 0.0) measure_carefully(i, lattice, exponent);
  }
}

void TriangleBlock::measure_carefully(std::size_t i, const Lattice& lattice, int exponent) {
  const PowerOfTwo unscale(-exponent);
  const Point2 p[3] = {{ax_[i], ay_[i]}, {bx_[i], by_[i]}, {cx_[i], cy_[i]}};
  double side[3];  // squared, opposite to each vertex
  int angle[3];
  for (int k = 0; k < 3; ++k) {
    const Point2 q = p[(k + 1) % 3], r = p[(k + 2) % 3];
    side[k] = (r.x - q.x) * (r.x - q.x) + (r.y - q.y) * (r.y - q.y);
    angle[k] = dot(q, r, p[k], lattice);
  }
  const double longest = std::max(side[0], std::max(side[1], side[2]));
  obtuse[i] = kNoEdge;
  for (std::int32_t k = 0; k < 3; ++k) {
    if (angle[k] < 0) obtuse[i] = (first_[i] + k + 1) % 3;
    if (angle[k] == 0) {
      // As the value of the edge, to the last bit, unless rounding makes a leg that is
      // nearly as long the longest.
      radius[i] = unscale * (0.5 * std::sqrt(longest));
      return;
    }
  }
  const double det = cross_accurate(p[0], p[1], p[2]);
  const double radius_sq = 0.25 * ((side[2] / det) * (side[1] / det) * side[0]);
  const bool plain = radius_sq < kLargeSq && radius_sq > kSmallSq;
  const double r = plain ? unscale * std::sqrt(radius_sq)
                         : circumradius_scaled(side[2], side[1], side[0], det, -exponent);
  radius[i] = std::max(r, unscale * (0.5 * std::sqrt(longest)));
}

void EdgeBlock::measure(std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    half_length[i] = 0.5 * std::sqrt(dx[i] * dx[i] + dy[i] * dy[i]);
  }
}

}  // namespace alphamesh
