#include "power_values3.hpp"

#include <cmath>

#include "vertex_rows.hpp"

namespace alphamesh {
namespace {

using Vector = Vector3<double>;

// Power values between these bounds come from terms that neither overflow nor underflow.
constexpr double kLarge = 0x1p900, kSmall = 0x1p-900;
// The error of a power value that is good enough, relative to it, in units of kEps: 9.1e-13,
// half of that for its root. Bounds add up; errors as they come are less by far.
constexpr double kEnough = 8192.0;

double square(const Vector& v) { return dot(v, v); }

double distance_sq(const Vector& a, const Vector& b) {
  return square({a.x - b.x, a.y - b.y, a.z - b.z});
}

double larger(double a, double b) { return a > b ? a : b; }  // as one instruction
double smaller(double a, double b) { return a < b ? a : b; }

// Which edges of a facet are attached, by the bits of their opposite vertices: a < b < c with
// the squared sides u, v, w across and their weights less a common one. Twice the barycentric
// coordinate of the orthocentre times a square of areas: the terms add up to 3 of the longest
// squared side and 8 of the greatest weight, times the longest squared side; some 16 roundings.
struct Facet {
  double code, least;
};

Facet facet(int k, int a, int b, int c, double u, double v, double w, double wa, double wb,
            double wc, double bound) {
  const double at_a = v + w - u, at_b = w + u - v, at_c = u + v - w;
  const double sa = u * (at_a - 2.0 * wa) + (wb * at_c + wc * at_b);
  const double sb = v * (at_b - 2.0 * wb) + (wa * at_c + wc * at_a);
  const double sc = w * (at_c - 2.0 * wc) + (wa * at_b + wb * at_a);
  const double unit = static_cast<double>(1 << (4 * k));
  return {(sa < -bound ? unit * (1 << a) : 0.0) + (sb < -bound ? unit * (1 << b) : 0.0) +
              (sc < -bound ? unit * (1 << c) : 0.0),
          smaller(std::fabs(sa), smaller(std::fabs(sb), std::fabs(sc)))};
}

}  // namespace

void PowerTetrahedra::evaluate(const Lattice3& lattice) {
  const double exact6 = lattice.exact6;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = x_[0][i], y = y_[0][i], z = z_[0][i], weight = w_[0][i];
    const Vector a{x_[1][i] - x, y_[1][i] - y, z_[1][i] - z};
    const Vector b{x_[2][i] - x, y_[2][i] - y, z_[2][i] - z};
    const Vector c{x_[3][i] - x, y_[3][i] - y, z_[3][i] - z};
    const double a2 = square(a), b2 = square(b), c2 = square(c);
    const double wa = weight - w_[1][i], wb = weight - w_[2][i], wc = weight - w_[3][i];
    const double as = a2 + wa, bs = b2 + wb, cs = c2 + wc;
    const Vector bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    const double w = dot(a, bc), inverse = 0.5 / w;
    const Vector n{as * bc.x + bs * ca.x + cs * ab.x, as * bc.y + bs * ca.y + cs * ab.y,
                   as * bc.z + bs * ca.z + cs * ab.z};
    const Vector centre{n.x * inverse, n.y * inverse, n.z * inverse};
    const double centre_sq = square(centre), power = centre_sq - weight;
    radius[i] =
        larger(power, 0.0 - smaller(smaller(weight, w_[1][i]), smaller(w_[2][i], w_[3][i])));

    // As in sphere_of(): n is wrong by 15 units of `terms` at most, w by 10 of `product`.
    const double la = std::sqrt(a2), lb = std::sqrt(b2), lc = std::sqrt(c2);
    const double product = la * lb * lc;
    const double terms = (a2 + std::fabs(wa)) * (lb * lc) + (b2 + std::fabs(wb)) * (lc * la) +
                         (c2 + std::fabs(wc)) * (la * lb);
    // The centre is wrong by `off` units if w is known to one part in a hundred; where it comes
    // out near the origin by chance, the square of that counts.
    const double distance = std::sqrt(centre_sq);
    const double off = (8.0 * terms + 10.0 * distance * product) / std::fabs(w);
    const double error =
        off * (2.0 * distance + kEps * off) + 8.0 * (centre_sq + std::fabs(weight));
    double good = error <= kEnough * std::fabs(power) ? 1.0 : 0.0;
    good = 1024.0 * kEps * product <= std::fabs(w) ? good : 0.0;
    good = centre_sq < kLarge ? good : 0.0;
    good = std::fabs(power) > kSmall ? good : 0.0;
    bad_radius_[i] = 1.0 - good;

    // Barycentric coordinates of the orthocentre, times 2 w^2. Their terms add up to 4/3 of
    // `all` at most; some 24 roundings.
    const double s1 = dot(n, bc), s2 = dot(n, ca), s3 = dot(n, ab);
    const double s0 = 2.0 * w * w - (s1 + s2 + s3);
    const double all = terms * (lb * lc + lc * la + la * lb) + 2.0 * product * product;
    const double bound = 2.0 * all < exact6 ? -1.0 : 40.0 * kEps * all;
    const double least =
        smaller(smaller(std::fabs(s0), std::fabs(s1)), smaller(std::fabs(s2), std::fabs(s3)));
    bad_facet_[i] = least > bound ? 0.0 : 1.0;
    attached_[i] = (s0 > 0.0 ? 0.0 : 1.0) + (s1 > 0.0 ? 0.0 : 2.0) + (s2 > 0.0 ? 0.0 : 4.0) +
                   (s3 > 0.0 ? 0.0 : 8.0);
  }
}

void PowerTetrahedra::evaluate_edges(const Lattice3& lattice) {
  const double exact4 = lattice.exact2 * lattice.unit * lattice.unit;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector p{x_[0][i], y_[0][i], z_[0][i]}, q{x_[1][i], y_[1][i], z_[1][i]};
    const Vector r{x_[2][i], y_[2][i], z_[2][i]}, t{x_[3][i], y_[3][i], z_[3][i]};
    const double a2 = distance_sq(p, q), b2 = distance_sq(p, r), c2 = distance_sq(p, t);
    const double d2 = distance_sq(q, r), e2 = distance_sq(q, t), f2 = distance_sq(r, t);
    const double wa = w_[1][i] - w_[0][i], wb = w_[2][i] - w_[0][i], wc = w_[3][i] - w_[0][i];
    const double longest = larger(larger(larger(a2, b2), larger(c2, d2)), larger(e2, f2));
    const double weight = larger(std::fabs(wa), larger(std::fabs(wb), std::fabs(wc)));
    const double all = longest * (3.0 * longest + 8.0 * weight);
    const double bound = all < exact4 ? 0.0 : 18.0 * kEps * all;
    const Facet f0 = facet(0, 1, 2, 3, f2, e2, d2, wa, wb, wc, bound);
    const Facet f1 = facet(1, 0, 2, 3, f2, c2, b2, 0.0, wb, wc, bound);
    const Facet g2 = facet(2, 0, 1, 3, e2, c2, a2, 0.0, wa, wc, bound);
    const Facet g3 = facet(3, 0, 1, 2, d2, b2, a2, 0.0, wa, wb, bound);
    sides_[i] = (f0.code + f1.code) + (g2.code + g3.code);
    const double least = smaller(smaller(f0.least, f1.least), smaller(g2.least, g3.least));
    double good = least > bound ? 1.0 : 0.0;
    good = bound > 0.0 ? good : 1.0;
    bad_edge_[i] = 1.0 - good;
  }
}

void PowerTetrahedra::measure(const Lattice3& lattice, int exponent) {
  evaluate(lattice);
  evaluate_edges(lattice);
  const PowerOfTwo unscale(-exponent);
  for (std::size_t i = 0; i < count; ++i) {
    radius[i] = unscale * signed_root(radius[i]);
    attached[i] = static_cast<std::uint8_t>(static_cast<int>(attached_[i]));
    sides[i] = static_cast<std::uint16_t>(static_cast<int>(sides_[i]));
    if (bad_radius_[i] + bad_facet_[i] + bad_edge_[i] == 0.0) continue;
    if (bad_facet_[i] != 0.0) settle_facets(i, lattice);
    if (bad_edge_[i] != 0.0) settle_edges(i, lattice);
    if (bad_radius_[i] == 0.0) continue;
    Weighted3 p[4];
    corners(i, p);
    const double least =
        std::min(std::min(p[0].weight, p[1].weight), std::min(p[2].weight, p[3].weight));
    radius[i] =
        std::max(tetrahedron_root(p, lattice, -exponent), unscale * signed_root(0.0 - least));
  }
}

void PowerTetrahedra::corners(std::size_t i, Weighted3* p) const {
  for (int k = 0; k < 4; ++k) p[k] = {{x_[k][i], y_[k][i], z_[k][i]}, w_[k][i]};
}

void PowerTetrahedra::settle_facets(std::size_t i, const Lattice3& lattice) {
  Weighted3 p[4];
  corners(i, p);
  int in = 0;
  for (int k = 0; k < 4; ++k) in |= (orthocentre_side_exact(p, k, lattice) <= 0 ? 1 : 0) << k;
  attached[i] = static_cast<std::uint8_t>(in);
}

void PowerTetrahedra::settle_edges(std::size_t i, const Lattice3& lattice) {
  Weighted3 p[4];
  corners(i, p);
  int code = 0;
  for (int k = 0; k < 4; ++k) {
    for (int m = 0; m < 4; ++m) {
      if (m == k) continue;
      const int u = m == 0 ? (k == 1 ? 2 : 1) : (k == 0 ? (m == 1 ? 2 : 1) : 0);
      const int v = 6 - k - m - u;
      if (orthocentre_side_exact(p[u], p[v], p[m], lattice) < 0) code |= 1 << (4 * k + m);
    }
  }
  sides[i] = static_cast<std::uint16_t>(code);
}

// The square of |lift(u) v - lift(v) u| / (2 |u x v|), less the weight; see power3.cpp.
void PowerTriangles3::evaluate() {
  for (std::size_t i = 0; i < count; ++i) {
    const Vector u{x_[1][i] - x_[0][i], y_[1][i] - y_[0][i], z_[1][i] - z_[0][i]};
    const Vector v{x_[2][i] - x_[0][i], y_[2][i] - y_[0][i], z_[2][i] - z_[0][i]};
    const double weight = w_[0][i], wu = weight - w_[1][i], wv = weight - w_[2][i];
    const double u2 = square(u), v2 = square(v), us = u2 + wu, vs = v2 + wv;
    const Vector g{us * v.x - vs * u.x, us * v.y - vs * u.y, us * v.z - vs * u.z};
    const Vector n = cross(u, v);
    const double area_sq = square(n), g2 = square(g);
    const double centre_sq = 0.25 * (g2 / area_sq), power = centre_sq - weight;
    radius[i] = larger(power, 0.0 - smaller(weight, smaller(w_[1][i], w_[2][i])));
    // g is wrong by 9 units of `terms`, n by 5 of |u||v|.
    const double lu = std::sqrt(u2), lv = std::sqrt(v2);
    const double terms = (u2 + std::fabs(wu)) * lv + (v2 + std::fabs(wv)) * lu;
    const double area = std::sqrt(area_sq), distance = std::sqrt(centre_sq);
    // As for tetrahedra.
    const double off = (4.7 * terms + 5.2 * distance * (lu * lv)) / area;
    const double error =
        off * (2.0 * distance + kEps * off) + 12.0 * (centre_sq + std::fabs(weight));
    double sure = error <= kEnough * std::fabs(power) ? 1.0 : 0.0;
    sure = 1024.0 * kEps * (lu * lv) <= area ? sure : 0.0;
    sure = centre_sq < kLarge ? sure : 0.0;
    sure = std::fabs(power) > kSmall ? sure : 0.0;
    doubtful_[i] = 1.0 - sure;
  }
}

void PowerTriangles3::measure(const Lattice3& lattice, int exponent) {
  evaluate();
  const PowerOfTwo unscale(-exponent);
  for (std::size_t i = 0; i < count; ++i) {
    radius[i] = unscale * signed_root(radius[i]);
    if (doubtful_[i] == 0.0) continue;
    Weighted3 p[3];
    for (int k = 0; k < 3; ++k) p[k] = {{x_[k][i], y_[k][i], z_[k][i]}, w_[k][i]};
    const double least = std::min(p[0].weight, std::min(p[1].weight, p[2].weight));
    radius[i] = std::max(triangle_root(p, lattice, -exponent), unscale * signed_root(0.0 - least));
  }
}

// (|d|^2 + w_a - w_b)^2 / (4 |d|^2) - w_a
double power_radius(const Weighted3& a, const Weighted3& b, const Lattice3& lattice, int exponent) {
  const PowerOfTwo unscale(-exponent);
  const double d2 = square(b - a), weight = a.weight - b.weight, lift = d2 + weight;
  const double centre_sq = 0.25 * (lift / d2) * lift, power = centre_sq - a.weight;
  const double least = 0.0 - std::min(a.weight, b.weight);
  const double terms = d2 + std::fabs(weight);
  const double error = 16.0 * (terms / d2) * terms + 2.0 * std::fabs(a.weight);
  const bool sure =
      error <= 512.0 * std::fabs(power) && centre_sq < kLarge && std::fabs(power) > kSmall;
  if (sure) return unscale * signed_root(std::max(power, least));
  return std::max(edge_root(a, b, lattice, -exponent), unscale * signed_root(least));
}

}  // namespace alphamesh
