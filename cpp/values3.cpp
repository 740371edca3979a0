#include "values3.hpp"

#include <algorithm>
#include <cmath>

#include "values2.hpp"

namespace alphamesh {
namespace {

using Vector = Vector3<double>;

// Squared radii between these bounds are neither rounded to subnormals nor infinite.
constexpr double kLarge = 0x1p900, kSmall = 0x1p-900;
// Below this share of their greatest possible value, a volume (6 x, against the product of
// three sides) and a circumcentre are computed again in double-double: relative errors stay
// below 2e-13.
constexpr double kFlat = 1.0 / 128.0;

double square(const Vector& v) { return dot(v, v); }

double larger(double a, double b) { return a > b ? a : b; }  // as one instruction
double smaller(double a, double b) { return a < b ? a : b; }

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

// The facet opposite to vertex k: 4^k times the position of its obtuse vertex, less k.
// u, v, w are the squared sides opposite to its vertices a < b < c. An angle whose cosine is
// zero is found to within 14 roundings of the longest; below `exact` nothing is rounded.
struct Facet {
  double code, bad;
};

Facet facet(int k, int a, int b, int c, double u, double v, double w, double exact) {
  const double at_a = v + w - u, at_b = w + u - v, at_c = u + v - w;
  const double least = smaller(at_a, smaller(at_b, at_c)), longest = larger(u, larger(v, w));
  const double bound = 2.0 * longest < exact ? 0.0 : 16.0 * kEps * longest;
  const double unit = static_cast<double>(1 << (2 * k));
  return {(at_a < -bound ? unit * (a - k) : 0.0) + (at_b < -bound ? unit * (b - k) : 0.0) +
              (at_c < -bound ? unit * (c - k) : 0.0),
          std::fabs(least) > bound ? 0.0 : (bound > 0.0 ? 1.0 : 0.0)};
}

}  // namespace

void TetrahedronBlock::evaluate(const Lattice3& lattice) {
  const double exact2 = lattice.exact2, exact6 = lattice.exact6;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = x_[0][i], y = y_[0][i], z = z_[0][i];
    const Vector a{x_[1][i] - x, y_[1][i] - y, z_[1][i] - z};
    const Vector b{x_[2][i] - x, y_[2][i] - y, z_[2][i] - z};
    const Vector c{x_[3][i] - x, y_[3][i] - y, z_[3][i] - z};
    const Vector d{x_[2][i] - x_[1][i], y_[2][i] - y_[1][i], z_[2][i] - z_[1][i]};
    const Vector e{x_[3][i] - x_[1][i], y_[3][i] - y_[1][i], z_[3][i] - z_[1][i]};
    const Vector f{x_[3][i] - x_[2][i], y_[3][i] - y_[2][i], z_[3][i] - z_[2][i]};
    const double a2 = square(a), b2 = square(b), c2 = square(c);
    const double d2 = square(d), e2 = square(e), f2 = square(f);
    const Vector bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    const double w = dot(a, bc), inverse = 0.5 / w;
    const Vector n{a2 * bc.x + b2 * ca.x + c2 * ab.x, a2 * bc.y + b2 * ca.y + c2 * ab.y,
                   a2 * bc.z + b2 * ca.z + c2 * ab.z};
    const Vector centre{n.x * inverse, n.y * inverse, n.z * inverse};
    const double radius_sq = square(centre), product_sq = a2 * b2 * c2;
    const double most = larger(a2, larger(b2, c2));
    const double quarter = 0.25 * larger(most, larger(d2, larger(e2, f2)));
    // At least half of every side, as in exact arithmetic.
    radius[i] = std::sqrt(larger(radius_sq, quarter));
    double good = w * w > kFlat * kFlat * product_sq ? 1.0 : 0.0;
    good = radius_sq > kFlat * kFlat * most ? good : 0.0;
    good = radius_sq < kLarge ? good : 0.0;
    good = radius_sq > kSmall ? good : 0.0;
    bad_radius_[i] = 1.0 - good;

    // Barycentric coordinates of the circumcentre, times 2 w^2. Their terms add up to at
    // most 11 sqrt(3) |a||b||c| max^3; some 30 roundings.
    const double s1 = dot(n, bc), s2 = dot(n, ca), s3 = dot(n, ab);
    const double s0 = 2.0 * w * w - (s1 + s2 + s3);
    const double terms = 20.0 * std::sqrt(product_sq) * (most * std::sqrt(most));
    const double bound = terms < exact6 ? -1.0 : 32.0 * kEps * terms;
    const double least =
        smaller(smaller(std::fabs(s0), std::fabs(s1)), smaller(std::fabs(s2), std::fabs(s3)));
    bad_side_[i] = least > bound ? 0.0 : 1.0;
    attached_[i] = (s0 > 0.0 ? 0.0 : 1.0) + (s1 > 0.0 ? 0.0 : 2.0) + (s2 > 0.0 ? 0.0 : 4.0) +
                   (s3 > 0.0 ? 0.0 : 8.0);

    const Facet f0 = facet(0, 1, 2, 3, f2, e2, d2, exact2),
                f1 = facet(1, 0, 2, 3, f2, c2, b2, exact2);
    const Facet g2 = facet(2, 0, 1, 3, e2, c2, a2, exact2),
                g3 = facet(3, 0, 1, 2, d2, b2, a2, exact2);
    obtuse_[i] = 228.0 + ((f0.code + f1.code) + (g2.code + g3.code));  // none: 3210 in base 4
    bad_angle_[i] = (f0.bad + f1.bad) + (g2.bad + g3.bad);
  }
}

void TetrahedronBlock::measure(const Lattice3& lattice, int exponent) {
  evaluate(lattice);
  const PowerOfTwo unscale(-exponent);
  for (std::size_t i = 0; i < count; ++i) {
    radius[i] = unscale * radius[i];
    attached[i] = static_cast<std::uint8_t>(static_cast<int>(attached_[i]));
    obtuse[i] = static_cast<std::uint8_t>(static_cast<int>(obtuse_[i]));
    if (bad_radius_[i] + bad_side_[i] + bad_angle_[i] == 0.0) continue;
    if (bad_side_[i] != 0.0) settle_sides(i, lattice);
    if (bad_angle_[i] != 0.0) settle_angles(i, lattice);
    if (bad_radius_[i] == 0.0) continue;
    Point3 p[4];
    corners(i, p);
    double w, longest = 0.0;
    for (int k = 0; k < 4; ++k) {
      for (int m = 0; m < k; ++m) longest = std::max(longest, square(p[k] - p[m]));
    }
    const Vector n = circumcentre_accurate(p[0], p[1], p[2], p[3], &w);
    radius[i] = std::max(quotient(n, w, -exponent - 1), unscale * (0.5 * std::sqrt(longest)));
  }
}

void TetrahedronBlock::corners(std::size_t i, Point3* p) const {
  for (int k = 0; k < 4; ++k) p[k] = {x_[k][i], y_[k][i], z_[k][i]};
}

void TetrahedronBlock::settle_sides(std::size_t i, const Lattice3& lattice) {
  Point3 p[4];
  corners(i, p);
  int in = 0;
  for (int k = 0; k < 4; ++k) in |= (circumcentre_side_exact(p, k, lattice) <= 0 ? 1 : 0) << k;
  attached[i] = static_cast<std::uint8_t>(in);
}

void TetrahedronBlock::settle_angles(std::size_t i, const Lattice3& lattice) {
  Point3 p[4];
  corners(i, p);
  int code = 0;
  for (int k = 0; k < 4; ++k) {
    int found = k;
    for (int m = 0; m < 4; ++m) {
      if (m == k) continue;
      const int u = m == 0 ? (k == 1 ? 2 : 1) : (k == 0 ? (m == 1 ? 2 : 1) : 0);
      const int v = 6 - k - m - u;
      if (dot3(p[u], p[v], p[m], lattice) < 0) found = m;
    }
    code |= found << (2 * k);
  }
  obtuse[i] = static_cast<std::uint8_t>(code);
}

// As TriangleBlock::evaluate().
void FlatBlock::evaluate() {
  for (std::size_t i = 0; i < count; ++i) {
    const Vector u{x_[1][i] - x_[0][i], y_[1][i] - y_[0][i], z_[1][i] - z_[0][i]};
    const Vector v{x_[2][i] - x_[1][i], y_[2][i] - y_[1][i], z_[2][i] - z_[1][i]};
    const Vector w{x_[0][i] - x_[2][i], y_[0][i] - y_[2][i], z_[0][i] - z_[2][i]};
    const double u2 = square(u), v2 = square(v), w2 = square(w);
    const double at_a = -dot(u, w), at_b = -dot(u, v), at_c = -dot(v, w);
    const double longest = larger(larger(u2, v2), w2);
    const double least = smaller(smaller(at_a, at_b), at_c);
    const double yz = u.y * w.z, zy = u.z * w.y, zx = u.z * w.x, xz = u.x * w.z;
    const double xy = u.x * w.y, yx = u.y * w.x;
    const double terms = (std::fabs(yz) + std::fabs(zy)) + (std::fabs(zx) + std::fabs(xz)) +
                         (std::fabs(xy) + std::fabs(yx));
    const double det = norm(Vector{yz - zy, zx - xz, xy - yx});
    const double radius_sq = 0.25 * ((u2 / det) * (w2 / det) * v2), quarter = 0.25 * longest;
    angle_[0][i] = at_a;
    angle_[1][i] = at_b;
    angle_[2][i] = at_c;
    radius[i] = std::sqrt(larger(radius_sq, quarter));
    double sure = std::fabs(least) > 4.0 * kEps * longest ? 1.0 : 0.0;
    sure = det * 16.0 >= terms ? sure : 0.0;
    sure = radius_sq < kLargeSq ? sure : 0.0;
    sure = radius_sq > kSmallSq ? sure : 0.0;
    doubtful_[i] = 1.0 - sure;
  }
}

void FlatBlock::measure(const Lattice3& lattice, int exponent) {
  evaluate();
  const PowerOfTwo unscale(-exponent);
  for (std::size_t i = 0; i < count; ++i) {
    const bool a = angle_[0][i] < 0.0, b = angle_[1][i] < 0.0, c = angle_[2][i] < 0.0;
    obtuse[i] = 3 - 3 * a - 2 * b - c;
    radius[i] = unscale * radius[i];
    if (doubtful_[i] != 0.0) measure_carefully(i, lattice, exponent);
  }
}

void FlatBlock::measure_carefully(std::size_t i, const Lattice3& lattice, int exponent) {
  const PowerOfTwo unscale(-exponent);
  Point3 p[3];
  for (int k = 0; k < 3; ++k) p[k] = {x_[k][i], y_[k][i], z_[k][i]};
  const double side[3] = {square(p[2] - p[1]), square(p[0] - p[2]), square(p[1] - p[0])};
  const double longest = std::max(side[0], std::max(side[1], side[2]));
  obtuse[i] = 3;
  for (int k = 0; k < 3; ++k) {
    const int angle = dot3(p[(k + 1) % 3], p[(k + 2) % 3], p[k], lattice);
    if (angle < 0) obtuse[i] = k;
    if (angle == 0) {  // half of the longest side, see TriangleBlock
      radius[i] = unscale * (0.5 * std::sqrt(longest));
      return;
    }
  }
  const double det = norm(normal_accurate(p[0], p[1], p[2]));
  const double radius_sq = 0.25 * ((side[2] / det) * (side[1] / det) * side[0]);
  const bool plain = radius_sq < kLargeSq && radius_sq > kSmallSq;
  const double r = plain ? unscale * std::sqrt(radius_sq)
                         : circumradius_scaled(side[2], side[1], side[0], det, -exponent);
  radius[i] = std::max(r, unscale * (0.5 * std::sqrt(longest)));
}

}  // namespace alphamesh
