#include "values3.hpp"

#include <algorithm>
#include <cmath>

#include "values2.hpp"

namespace alphamesh {
namespace {

using Vector = Vector3<double>;

constexpr double kLarge = 0x1p450, kSmall = 0x1p-450;
// Below this share of their greatest possible value, a volume (6 x, against the product of
// three sides) and a circumcentre are computed again in double-double: relative errors stay
// below 2e-13.
constexpr double kFlat = 1.0 / 128.0;

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

// As TriangleBlock, in space: on a sheet along two axes, all is the same to the last bit.
Measure3::Flat Measure3::triangle(const Point3* p) const {
  const Vector u = p[1] - p[0], v = p[2] - p[1], w = p[0] - p[2];
  const double side[3] = {square(v), square(w), square(u)};  // opposite to each vertex
  const double angle[3] = {-dot(u, w), -dot(u, v), -dot(v, w)};
  const double longest = std::max(side[0], std::max(side[1], side[2]));
  const double least = std::min(angle[0], std::min(angle[1], angle[2]));
  const double yz = u.y * w.z, zy = u.z * w.y, zx = u.z * w.x, xz = u.x * w.z;
  const double xy = u.x * w.y, yx = u.y * w.x;
  const Vector n{yz - zy, zx - xz, xy - yx};
  const double terms =
      std::fabs(yz) + std::fabs(zy) + std::fabs(zx) + std::fabs(xz) + std::fabs(xy) + std::fabs(yx);
  const double det = norm(n), radius_sq = 0.25 * ((side[2] / det) * (side[0] / det) * side[1]);
  const bool sure = std::fabs(least) > 4.0 * kEps * longest && det * 16.0 >= terms &&
                    radius_sq < kLargeSq && radius_sq > kSmallSq;
  if (!sure) return triangle_carefully(p, side);
  const int obtuse = angle[0] < 0.0 ? 0 : angle[1] < 0.0 ? 1 : angle[2] < 0.0 ? 2 : 3;
  return {unscale_ * std::sqrt(std::max(radius_sq, 0.25 * longest)), obtuse};
}

Measure3::Flat Measure3::triangle_carefully(const Point3* p, const double* side) const {
  int obtuse = 3;
  for (int k = 0; k < 3; ++k) {
    const int angle = dot3(p[(k + 1) % 3], p[(k + 2) % 3], p[k], lattice_);
    if (angle == 0) return {unscale_ * (0.5 * std::sqrt(side[k])), 3};
    if (angle < 0) obtuse = k;
  }
  const double det = norm(normal_accurate(p[0], p[1], p[2]));
  const double radius_sq = 0.25 * ((side[2] / det) * (side[0] / det) * side[1]);
  const double longest = std::max(side[0], std::max(side[1], side[2]));
  const bool plain = radius_sq < kLargeSq && radius_sq > kSmallSq;
  const double radius = plain ? unscale_ * std::sqrt(radius_sq)
                              : circumradius_scaled(side[2], side[0], side[1], det, exponent_);
  return {std::max(radius, unscale_ * (0.5 * std::sqrt(longest))), obtuse};
}

}  // namespace alphamesh
