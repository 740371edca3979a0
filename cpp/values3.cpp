#include "values3.hpp"

#include <algorithm>
#include <cmath>

namespace alphamesh {
namespace {

using Vector = Vector3<double>;

constexpr double kLarge = 0x1p450, kSmall = 0x1p-450;
// Below these shares of their greatest possible value, a volume (6 x, against the product
// of three sides), a circumcentre and a squared normal are computed again in
// double-double: relative errors stay below 2e-13.
constexpr double kFlat = 1.0 / 128.0;
constexpr double kThin = 1.0 / 1024.0;

double square(const Vector& v) { return dot(v, v); }

// |v| 2^exponent / w without overflow on the way.
double quotient(const Vector& v, double w, int exponent) {
  const double most = std::max(std::fabs(v.x), std::max(std::fabs(v.y), std::fabs(v.z)));
  if (most == 0.0) return 0.0;
  int ev, ew;
  std::frexp(most, &ev);
  const double mw = std::frexp(w, &ew);
  const Vector s{std::ldexp(v.x, -ev), std::ldexp(v.y, -ev), std::ldexp(v.z, -ev)};
  return std::ldexp(norm(s) / std::fabs(mw), ev - ew + exponent);
}

}  // namespace

double Measure3::circumradius_carefully(const Point3* p) const {
  double w;
  const Vector n = circumcentre_accurate(p[0], p[1], p[2], p[3], &w);
  return quotient(n, w, exponent_ - 1);
}

Measure3::Solid Measure3::tetrahedron(const Point3* p) const {
  const Vector a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0];
  const Vector bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const double a2 = square(a), b2 = square(b), c2 = square(c), w = dot(a, bc);
  const Vector n{a2 * bc.x + b2 * ca.x + c2 * ab.x, a2 * bc.y + b2 * ca.y + c2 * ab.y,
                 a2 * bc.z + b2 * ca.z + c2 * ab.z};
  const double la = std::sqrt(a2), lb = std::sqrt(b2), lc = std::sqrt(c2);
  const double product = la * lb * lc, most = std::max(la, std::max(lb, lc));

  const double inverse = 0.5 / w;
  const Vector centre{n.x * inverse, n.y * inverse, n.z * inverse};
  double radius = norm(centre);
  const bool sure =
      std::fabs(w) > kFlat * product && radius > kFlat * most && radius < kLarge && radius > kSmall;
  radius = sure ? unscale_ * radius : circumradius_carefully(p);
  // At least half of every side, as in exact arithmetic.
  const double longest = std::max(std::max(square(p[2] - p[1]), square(p[3] - p[1])),
                                  std::max(square(p[3] - p[2]), std::max(a2, std::max(b2, c2))));
  radius = std::max(radius, unscale_ * (0.5 * std::sqrt(longest)));

  // Barycentric coordinates of the circumcentre, times 2 w^2. Their terms add up to at
  // most 11 sqrt(3) |a||b||c| max^3; some 30 roundings.
  const double s1 = dot(n, bc), s2 = dot(n, ca), s3 = dot(n, ab);
  const double side[4] = {2.0 * w * w - (s1 + s2 + s3), s1, s2, s3};
  const double bound = 640.0 * kEps * product * (most * most * most);
  unsigned attached = 0;
  for (int k = 0; k < 4; ++k) {
    bool in = side[k] < 0.0;
    if (std::fabs(side[k]) <= bound) in = circumcentre_side_exact(p, k, lattice_) <= 0;
    attached |= static_cast<unsigned>(in) << k;
  }
  return {radius, attached};
}

Measure3::Flat Measure3::triangle(const Point3* p) const {
  const Vector b = p[1] - p[0], c = p[2] - p[0], d = p[2] - p[1];
  const double b2 = square(b), c2 = square(c), d2 = square(d);
  // At most one angle is not acute.
  const double angle[3] = {dot(b, c), -dot(b, d), dot(c, d)};
  const double longest = std::max(b2, std::max(c2, d2)), unsure = 8.0 * kEps * longest;
  int obtuse = 3;
  for (int k = 0; k < 3; ++k) {
    int side = angle[k] < 0.0 ? -1 : 1;
    if (std::fabs(angle[k]) <= unsure) {
      side = dot3(p[(k + 1) % 3], p[(k + 2) % 3], p[k], lattice_);
      if (side == 0) return {edge(p[(k + 1) % 3], p[(k + 2) % 3]), 3};
    }
    if (side < 0) obtuse = k;
  }
  Vector n = cross(b, c);
  double n2 = square(n);
  if (!(n2 > kThin * (b2 * c2))) {
    n = normal_accurate(p[0], p[1], p[2]);
    n2 = square(n);
  }
  const double radius_sq = 0.25 * ((b2 / n2) * c2 * d2);
  double radius = 0.0;
  if (radius_sq < kLarge * kLarge && radius_sq > kSmall * kSmall && n2 > 0x1p-900) {
    radius = unscale_ * std::sqrt(radius_sq);
  } else {
    int es, el;
    const double sides = std::frexp(std::sqrt(b2) * std::sqrt(c2), &es);
    const double length = std::frexp(quotient(n, 1.0, 0), &el);
    radius = std::ldexp(sides * std::sqrt(d2) / length, es - el - 1 + exponent_);
  }
  return {std::max(radius, unscale_ * (0.5 * std::sqrt(longest))), obtuse};
}

}  // namespace alphamesh
