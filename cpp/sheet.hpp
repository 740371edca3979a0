// Clouds in space that lie in a plane, the sheet, or on a line.
//
// Two coordinates, chosen so that they tell all points apart, say which side of a line a
// point is on: dropping the third is an affine map of the sheet, and nothing is rounded.
// Lengths, circles and angles are those of space, with all three.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "output2.hpp"
#include "predicates3.hpp"
#include "spatial_sort.hpp"
#include "values2.hpp"
#include "values3.hpp"

namespace alphamesh {

struct SheetPoint {
  double x, y;   // the coordinates kept, in their order
  double z;      // the one dropped
  int axis = 2;  // which that is

  operator Point2() const { return {x, y}; }
  // In the order of space: sums of three are rounded as those of the cloud around are, of
  // which the sheet may be a part.
  operator Point3() const {
    if (axis == 2) return {x, y, z};
    return axis == 1 ? Point3{x, z, y} : Point3{z, x, y};
  }
};

// The same as in the order of all three, see sheet_of().
inline bool operator<(SheetPoint a, SheetPoint b) { return Point2(a) < Point2(b); }

struct Sheet {
  using Point = SheetPoint;
  using Ties = Lattice;
};

inline int orient(SheetPoint a, SheetPoint b, SheetPoint c, const Lattice& lattice) {
  return orient(Point2(a), Point2(b), Point2(c), lattice);
}

int in_circle_exact(SheetPoint a, SheetPoint b, SheetPoint c, SheetPoint d, const Lattice& lattice);

// Whether d is inside the circle, in space, through a, b, c, which are counter-clockwise in
// the coordinates kept. On the sheet, |p - d|^2 is a positive definite quadratic form in
// those, so that the determinant is the one of the plane with another lift.
inline bool in_circle(SheetPoint a, SheetPoint b, SheetPoint c, SheetPoint d,
                      const Lattice& lattice) {
  const Vector3<double> u{a.x - d.x, a.y - d.y, a.z - d.z};
  const Vector3<double> v{b.x - d.x, b.y - d.y, b.z - d.z};
  const Vector3<double> w{c.x - d.x, c.y - d.y, c.z - d.z};
  const double vw = v.x * w.y, wv = w.x * v.y, wu = w.x * u.y, uw = u.x * w.y;
  const double uv = u.x * v.y, vu = v.x * u.y;
  const double ul = dot(u, u), vl = dot(v, v), wl = dot(w, w);
  const double det = ul * (vw - wv) + vl * (wu - uw) + wl * (uv - vu);
  const double sum = (std::fabs(vw) + std::fabs(wv)) * ul + (std::fabs(wu) + std::fabs(uw)) * vl +
                     (std::fabs(uv) + std::fabs(vu)) * wl;
  const double bound = (12.0 + 128.0 * kEps) * kEps * sum;  // one rounding more than in_circle()
  int s = 0;
  if (det > bound || det < -bound || sum < lattice.exact4) {
    s = sign_of(det);
  } else {
    s = in_circle_exact(a, b, c, d, lattice);
  }
  return (s != 0 ? s : in_circle_perturbed(a, b, c, d, lattice)) > 0;
}

// As TriangleBlock and EdgeBlock, with the metric of space. A cloud in the plane of two axes
// gets the same values as in two dimensions, to the last bit.
class SheetTriangles {
 public:
  std::size_t count = 0;
  double radius[TriangleBlock::kSize];
  std::int32_t obtuse[TriangleBlock::kSize];

  void push(SheetPoint a, SheetPoint b, SheetPoint c);
  void measure(const Lattice& lattice, int exponent);

 private:
  FlatBlock block_;
  std::int32_t first_[TriangleBlock::kSize];
};

struct SheetEdges {
  double half_length[EdgeBlock::kSize];

  void set(std::size_t i, SheetPoint a, SheetPoint b) {
    half_length[i] = 0.5 * norm(Point3(a) - Point3(b));
  }
  void measure(std::size_t) {}
};

// The distinct points of a cloud that spans at most a plane, in an order of their own;
// `row` as in `order`. `span` comes from spanning_points().
SpatialOrder<Sheet> sheet_of(const SpatialOrder3& order, const std::vector<std::int32_t>& span,
                             Job& job);

}  // namespace alphamesh
