// Points with weights in a plane, and which of them a power circle takes in, exactly.
//
// As predicates2.hpp, with lifted points |p|^2 - w in place of |p|^2. Coordinates and roots
// of weights must lie in the range that Plane::kWeightedTop and kWeightedBottom describe,
// where products of six neither overflow nor underflow.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>

#include "exact.hpp"
#include "memory.hpp"
#include "parallel.hpp"
#include "sheet.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {

// P is Point2, or SheetPoint for a plane in space.
template <class P>
struct Weighted : P {
  double w;
};

struct WeightedPlane {
  using Point = Weighted<Point2>;
  using Ties = Lattice;
};

struct WeightedSheet {
  using Point = Weighted<SheetPoint>;
  using Ties = Lattice;
};

SpatialOrder<WeightedPlane> weighted_type(const SpatialOrder<Plane>&);
SpatialOrder<WeightedSheet> weighted_type(const SpatialOrder<Sheet>&);

// The same order with each weight beside its point, and without keys.
template <class S>
auto weighted(SpatialOrder<S> order, Job& job) {
  decltype(weighted_type(order)) out;
  out.size = order.size;
  out.points = Buffer<Weighted<typename S::Point>>(order.size);
  const Parts parts(order.size, job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      out.points[i] = {order.points[i], order.weight[i]};
    }
  });
  out.row = std::move(order.row);
  out.representative = std::move(order.representative);
  out.exponent = order.exponent;
  out.lattice = order.lattice;
  return out;
}

template <class R>
struct Vector2 {
  R x, y;
};

template <class R>
inline R dot(const Vector2<R>& a, const Vector2<R>& b) {
  return a.x * b.x + a.y * b.y;
}

// From b to a, rounded and exactly. The first two coordinates tell sides; all tell lengths.
inline Vector2<double> offset(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }
inline Vector3<double> offset(SheetPoint a, SheetPoint b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vector2<Dd> exact_offset(Point2 a, Point2 b) {
  return {two_diff(a.x, b.x), two_diff(a.y, b.y)};
}
inline Vector3<Dd> exact_offset(SheetPoint a, SheetPoint b) {
  return {two_diff(a.x, b.x), two_diff(a.y, b.y), two_diff(a.z, b.z)};
}

// The sign of in_power_circle_or_zero(), without a filter.
template <class P>
int in_power_circle_exact(const Weighted<P>& a, const Weighted<P>& b, const Weighted<P>& c,
                          const Weighted<P>& d, const Lattice& lattice);

// Whether d is inside when the four lifted points lie in one plane: the lexicographically
// largest is lifted most of all, then the second, and so on (Devillers & Teillaud 2011). Other
// than on a circle, three of them may be on a line.
template <class P>
bool in_power_circle_perturbed(const Weighted<P>& a, const Weighted<P>& b, const Weighted<P>& c,
                               const Weighted<P>& d, const Lattice& lattice);

// +1 if the lifted d is below the plane of the lifted a, b, c (counter-clockwise), -1 above.
// Rounding amounts to 13 units of the last place of the terms.
template <class P>
inline int in_power_circle_or_zero(const Weighted<P>& a, const Weighted<P>& b, const Weighted<P>& c,
                                   const Weighted<P>& d, const Lattice& lattice) {
  const auto u = offset(a, d), v = offset(b, d), t = offset(c, d);
  const double vt = v.x * t.y, tv = t.x * v.y, tu = t.x * u.y, ut = u.x * t.y;
  const double uv = u.x * v.y, vu = v.x * u.y;
  const double u2 = dot(u, u), v2 = dot(v, v), t2 = dot(t, t);
  const double uw = a.w - d.w, vw = b.w - d.w, tw = c.w - d.w;
  const double det = (u2 - uw) * (vt - tv) + (v2 - vw) * (tu - ut) + (t2 - tw) * (uv - vu);
  const double sum = (std::fabs(vt) + std::fabs(tv)) * (u2 + std::fabs(uw)) +
                     (std::fabs(tu) + std::fabs(ut)) * (v2 + std::fabs(vw)) +
                     (std::fabs(uv) + std::fabs(vu)) * (t2 + std::fabs(tw));
  const double bound = 16.0 * kEps * sum;
  if (det > bound) return 1;
  if (det < -bound) return -1;
  if (2.0 * sum < lattice.exact4) return sign_of(det);
  return in_power_circle_exact(a, b, c, d, lattice);
}

template <class P>
inline bool in_power_circle(const Weighted<P>& a, const Weighted<P>& b, const Weighted<P>& c,
                            const Weighted<P>& d, const Lattice& lattice) {
  const int s = in_power_circle_or_zero(a, b, c, d, lattice);
  return s != 0 ? s > 0 : in_power_circle_perturbed(a, b, c, d, lattice);
}

// Whether b, between a and c on a line and in lexicographic order, is hidden by them.
template <class P>
bool hidden_between(const Weighted<P>& a, const Weighted<P>& b, const Weighted<P>& c);

// The sign of |a - b|^2 + w_a - w_b: negative if a lies in the power cell of b, not in its own.
template <class P>
int in_own_cell_exact(const Weighted<P>& a, const Weighted<P>& b);

template <class P>
inline int in_own_cell(const Weighted<P>& a, const Weighted<P>& b, const Lattice& lattice) {
  const auto e = offset(a, b);
  const double square = dot(e, e), weight = a.w - b.w, s = square + weight;
  const double sum = square + std::fabs(weight), bound = 8.0 * kEps * sum;
  if (s > bound) return 1;
  if (s < -bound) return -1;
  if (2.0 * sum < lattice.exact2) return sign_of(s);
  return in_own_cell_exact(a, b);
}

}  // namespace alphamesh
