#include "sheet.hpp"

#include <algorithm>
#include <utility>

#include "big.hpp"

namespace alphamesh {

int in_circle_exact(SheetPoint a, SheetPoint b, SheetPoint c, SheetPoint d,
                    const Lattice& lattice) {
  const SheetPoint p[3] = {a, b, c};
  Vector3<Dd> e[3];
  Dd lift[3];
  for (int i = 0; i < 3; ++i) {
    e[i] = {two_diff(p[i].x, d.x), two_diff(p[i].y, d.y), two_diff(p[i].z, d.z)};
    lift[i] = dot(e[i], e[i]);
  }
  Dd det{0.0, 0.0};
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) {
    const Vector3<Dd>&u = e[(i + 1) % 3], &v = e[(i + 2) % 3];
    const Dd l = u.x * v.y, r = v.x * u.y;
    det = det + lift[i] * (l - r);
    sum += lift[i].h * (std::fabs(l.h) + std::fabs(r.h));
  }
  const double bound = 0x1p-98 * sum;  // some 50 u^2, u = 2^-53
  if (std::fabs(det.h) > bound) return sign_of(det.h);
  const double u2 = lattice.unit * lattice.unit;
  if (std::fabs(det.h) + bound < u2 * u2) return 0;
  Big exact;
  for (int i = 0; i < 3; ++i) {
    const Vector3<Big> o{Big(e[i].x), Big(e[i].y), Big(e[i].z)};
    const Vector3<Dd>&u = e[(i + 1) % 3], &v = e[(i + 2) % 3];
    exact = exact + dot(o, o) * (Big(u.x) * Big(v.y) - Big(v.x) * Big(u.y));
  }
  return exact.sign();
}

void SheetTriangles::push(SheetPoint a, SheetPoint b, SheetPoint c) {
  const SheetPoint p[5] = {a, b, c, a, b};
  int first = b < a ? 1 : 0;
  first = c < p[first] ? 2 : first;
  block_.push(p[first], p[first + 1], p[first + 2]);
  first_[count++] = first;
}

void SheetTriangles::measure(const Lattice& lattice, int exponent) {
  block_.measure(Lattice3(lattice.unit), exponent);
  for (std::size_t i = 0; i < count; ++i) {
    radius[i] = block_.radius[i];
    // Opposite to vertex k is edge k + 1.
    const std::int32_t k = block_.obtuse[i];
    obtuse[i] = k == 3 ? TriangleBlock::kNoEdge : (first_[i] + k + 1) % 3;
  }
  block_.count = 0;
}

namespace {

struct Axes {
  int kept[2], dropped;
};

double coordinate(const Point3& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

// Of x y, x z, y z the first that tells the points of the cloud apart. In this order, points
// that agree in the first coordinate kept and differ in the second stand as they do in the
// lexicographic order of all three: x z is only taken where y is a function of x.
Axes choose_axes(const Point3* p, const std::vector<std::int32_t>& span) {
  constexpr Axes kChoice[3] = {{{0, 1}, 2}, {{0, 2}, 1}, {{1, 2}, 0}};
  for (const Axes& axes : kChoice) {
    auto kept = [&](std::size_t i) {
      const Point3& q = p[span[i]];
      return Point2{coordinate(q, axes.kept[0]), coordinate(q, axes.kept[1])};
    };
    if (span.size() == 3 && orient(kept(0), kept(1), kept(2), Lattice()) != 0) return axes;
    if (span.size() == 2 && !(kept(0) == kept(1))) return axes;
  }
  return kChoice[0];  // a single point
}

}  // namespace

SpatialOrder<Sheet> sheet_of(const SpatialOrder3& order, const std::vector<std::int32_t>& span,
                             Job& job) {
  const std::size_t n = order.size;
  const Axes axes = choose_axes(order.points.data(), span);
  Buffer<double> kept(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    kept[2 * i] = coordinate(order.points[i], axes.kept[0]);
    kept[2 * i + 1] = coordinate(order.points[i], axes.kept[1]);
  }
  SpatialOrder2 plane = spatial_order2(kept.data(), n, job);  // in range, so not scaled again
  SpatialOrder<Sheet> sheet;
  sheet.size = n;
  sheet.points = Buffer<SheetPoint>(n);
  sheet.weight = Buffer<double>(order.weight.size());
  sheet.row = std::move(plane.row);
  sheet.key = std::move(plane.key);
  sheet.exponent = order.exponent;
  sheet.lattice = Lattice(order.lattice.unit);
  for (std::size_t i = 0; i < n; ++i) {
    const auto from = static_cast<std::size_t>(sheet.row[i]);
    const Point2 p = plane.points[i];
    sheet.points[i] = {p.x, p.y, coordinate(order.points[from], axes.dropped), axes.dropped};
    sheet.row[i] = order.row[from];
    if (sheet.weight.size() != 0) sheet.weight[i] = order.weight[from];
  }
  return sheet;
}

}  // namespace alphamesh
