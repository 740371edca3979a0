#include "power3.hpp"

#include <algorithm>
#include <cmath>

#include "centre3.hpp"
#include "vertex_rows.hpp"

namespace alphamesh {
namespace {

constexpr double kEpsSq = 0x1p-106;  // u^2, the unit of the errors of pairs

// A point seen from another: the difference, the square of its length and the difference of
// weights, which make up its lift.
struct View {
  Vector3<Dd> d;
  Dd weight;      // of the origin less that of the point
  double length;  // |d|
  double terms;   // |d|^2 + |weight|, which errors of the lift are measured by

  View(const Weighted3& from, const Weighted3& to)
      : d(difference(to, from)),
        weight(two_diff(from.weight, to.weight)),
        length(alphamesh::length(d)),
        terms(length * length + std::fabs(weight.h)) {}
};

Vector3<Pair> pair(const View& v) { return pair(v.d); }
Vector3<Big> big(const View& v) { return big(v.d); }
Pair lift_pair(const View& v) { return dot(pair(v), pair(v)) + Pair(v.weight); }
Big lift_big(const View& v) { return dot(big(v), big(v)) + Big(v.weight); }

// A tetrahedron seen from its first vertex.
struct Corner {
  View a, b, c;

  Corner(const Weighted3& o, const Weighted3& p, const Weighted3& q, const Weighted3& r)
      : a(o, p), b(o, q), c(o, r) {}
  Circumcentre<Pair> pairs() const {
    return {pair(a), pair(b), pair(c), lift_pair(a), lift_pair(b), lift_pair(c)};
  }
  Circumcentre<Big> bigs() const {
    return {big(a), big(b), big(c), lift_big(a), lift_big(b), lift_big(c)};
  }
  double product() const { return a.length * b.length * c.length; }
  // What errors of the numerator are measured by.
  double terms() const {
    return a.terms * (b.length * c.length) + b.terms * (c.length * a.length) +
           c.terms * (a.length * b.length);
  }
};

Dd normal(Pair p) { return two_sum(p.h, p.l); }
Vector3<Dd> normal(const Vector3<Pair>& v) { return {normal(v.x), normal(v.y), normal(v.z)}; }

Dd scaled(Dd v, int e) { return {std::ldexp(v.h, e), std::ldexp(v.l, e)}; }
Big scaled(const Big& v, int e) { return v.compressed().scaled_by_power(e); }
template <class R>
Vector3<R> scaled(const Vector3<R>& v, int e) {
  return {scaled(v.x, e), scaled(v.y, e), scaled(v.z, e)};
}

int exponent_of(double v) {
  int e = 0;
  std::frexp(v, &e);
  return v == 0.0 ? -4000 : e;
}

// Powers of two that bring the terms of |n|^2 - 4 w^2 `weight` to 1: they are of degree eight,
// beyond the range of doubles.
struct Frame {
  int shift;        // n and w are divided by 2^shift
  int root;         // and `weight` by 4^root
  double mantissa;  // which leaves this

  Frame(double n, double w, double weight)
      : shift(0), root(weight == 0.0 ? 0 : (exponent_of(weight) + 1) / 2) {
    mantissa = std::ldexp(weight, -2 * root);
    shift = std::max(exponent_of(n), weight == 0.0 ? -4000 : exponent_of(w) + root);
  }
};

double largest(const Vector3<Dd>& v) {
  return std::max(std::fabs(v.x.h), std::max(std::fabs(v.y.h), std::fabs(v.z.h)));
}

// sign(v) sqrt(|v|) 2^(shift + exponent) / (2 |w|)
double root_over(double v, int shift, double w, int exponent) {
  int ew = 0;
  const double mw = std::frexp(std::fabs(w), &ew);
  return std::ldexp(signed_root(v) / (2.0 * mw), shift - ew + exponent);
}

}  // namespace

// See in_sphere_exact(): a lift has k = 6 and c = 38, the centre 13 and 159, the value 18 and
// 317. Sums of magnitudes over components are at most 2 / sqrt(3) times products of lengths (the
// greatest permanent of three unit vectors), its square for two: below 2^9 u^2.
int in_power_sphere_exact(const Weighted3& p, const Weighted3& a, const Weighted3& b,
                          const Weighted3& c, const Weighted3& e, const Lattice3& lattice) {
  const Corner corner(p, a, b, c);
  const View q(p, e);
  const double bound = 0x1p-95 * (corner.terms() * q.length + corner.product() * q.terms);
  const double unit = lattice.unit;
  return decide(corner.pairs().in_sphere(pair(q), lift_pair(q)), bound,
                unit * unit * unit * unit * unit,
                [&] { return corner.bigs().in_sphere(big(q), lift_big(q)); });
}

// k = 23 and c = 489: below 2^10 u^2.
int orthocentre_side_exact(const Weighted3* p, int k, const Lattice3& lattice) {
  const Corner corner(p[0], p[1], p[2], p[3]);
  const double la = corner.a.length, lb = corner.b.length, lc = corner.c.length;
  const double product = corner.product();
  const double bound =
      0x1p-95 * (corner.terms() * (la * lb + lb * lc + lc * la) + 2.0 * product * product);
  const double cube = lattice.unit * lattice.unit * lattice.unit;
  return decide(corner.pairs().side(k), bound, cube * cube, [&] { return corner.bigs().side(k); });
}

namespace {

template <class R>
R triangle_side(const Vector3<R>& u, const Vector3<R>& v, const R& u2, const R& v2) {
  return v2 * dot(u, u) - u2 * dot(u, v);
}

}  // namespace

// With u and v from a to b and c: the sign of lift(v) |u|^2 - lift(u) u . v. The products have
// k = 12 and c = 38 + 26 + 30 + 33 + 1 = 128, their difference 13 and 154: below 2^8 u^2.
int orthocentre_side_exact(const Weighted3& a, const Weighted3& b, const Weighted3& c,
                           const Lattice3& lattice) {
  const View u(a, b), v(a, c);
  const double bound =
      0x1p-97 * (v.terms * (u.length * u.length) + u.terms * (u.length * v.length));
  const double square = lattice.unit * lattice.unit;
  return decide(triangle_side(pair(u), pair(v), lift_pair(u), lift_pair(v)), bound, square * square,
                [&] { return triangle_side(big(u), big(v), lift_big(u), lift_big(v)); });
}

int orthocentre_side(const Weighted3& a, const Weighted3& b, const Lattice3& lattice) {
  const Vector3<double> d = b - a;
  const double weight = a.weight - b.weight, square = dot(d, d), value = square + weight;
  const double bound = 8.0 * kEps * (square + std::fabs(weight));
  if (value > bound) return 1;
  if (value < -bound) return -1;
  const View v(a, b);
  return decide(lift_pair(v), 0x1p-99 * v.terms, lattice.unit * lattice.unit,
                [&] { return lift_big(v); });
}

// The numerator's error is at most 184 u^2 terms() in length, the volume's 77 u^2 product():
// constants and magnitudes as above. That of n^2 - 4 w^2 weight follows.
double tetrahedron_root(const Weighted3* p, const Lattice3& lattice, int exponent) {
  const Corner corner(p[0], p[1], p[2], p[3]);
  const Circumcentre<Pair> plain = corner.pairs();
  const Vector3<Dd> n = normal(plain.numerator);
  const Dd w = normal(plain.volume);
  const Frame frame(largest(n), w.h, p[0].weight);
  const Vector3<Dd> ns = scaled(n, -frame.shift);
  const Dd ws = scaled(w, frame.root - frame.shift);
  const Dd four{4.0 * frame.mantissa, 0.0}, value = dot(ns, ns) - ws * ws * four;
  const double nl = length(ns), wl = std::fabs(ws.h), weight = std::fabs(four.h);
  const double tn = 184.0 * kEpsSq * std::ldexp(corner.terms(), -frame.shift);
  const double tw = 77.0 * kEpsSq * std::ldexp(corner.product(), frame.root - frame.shift);
  const double error = (2.0 * nl + tn) * tn + (2.0 * wl + tw) * tw * weight +
                       64.0 * kEpsSq * (nl * nl + wl * wl * weight);
  const bool solid = 77.0 * kEpsSq * corner.product() <= 0x1p-52 * std::fabs(w.h);
  if (solid && error <= 0x1p-50 * std::fabs(value.h)) {
    return root_over(value.h, frame.shift, w.h, exponent);
  }
  if (lattice.unit > 0.0) {
    const double resolution = std::ldexp(1.0, 8 * std::ilogb(lattice.unit) - 2 * frame.shift);
    if (std::fabs(value.h) + error < resolution) return 0.0;
  }
  const Circumcentre<Big> exact = corner.bigs();
  const Vector3<Big> numerator{exact.numerator.x.compressed(), exact.numerator.y.compressed(),
                               exact.numerator.z.compressed()};
  const Big volume = exact.volume.compressed();
  const Vector3<Dd> rough{
      {numerator.x.estimate(), 0.0}, {numerator.y.estimate(), 0.0}, {numerator.z.estimate(), 0.0}};
  const Frame fine(largest(rough), volume.estimate(), p[0].weight);
  const Vector3<Big> nb = scaled(numerator, -fine.shift);
  const Big wb = scaled(volume, fine.root - fine.shift);
  const Big difference = dot(nb, nb) - wb * wb * Big(Dd{4.0 * fine.mantissa, 0.0});
  return root_over(difference.compressed().estimate(), fine.shift, volume.estimate(), exponent);
}

namespace {

// The orthocentre of the origin, u, v lies at a distance of |lift(u) v - lift(v) u| / (2 |u x v|).
template <class R>
struct FlatCentre {
  Vector3<R> across;
  R area_sq;  // |u x v|^2

  FlatCentre(const Vector3<R>& u, const Vector3<R>& v, const R& u2, const R& v2) {
    across = {u2 * v.x - v2 * u.x, u2 * v.y - v2 * u.y, u2 * v.z - v2 * u.z};
    const Vector3<R> n = cross(u, v);
    area_sq = dot(n, n);
  }
};

}  // namespace

// `across` has k = 9 and c = 84, n 4 and 16. Of degree six at most: nothing to be scaled.
double triangle_root(const Weighted3* p, const Lattice3& lattice, int exponent) {
  const View u(p[0], p[1]), v(p[0], p[2]);
  const double weight = p[0].weight;
  const FlatCentre<Pair> plain(pair(u), pair(v), lift_pair(u), lift_pair(v));
  const Vector3<Dd> g = normal(plain.across);
  const Dd area_sq = normal(plain.area_sq), four{4.0 * weight, 0.0};
  const Dd value = dot(g, g) - area_sq * four;
  const double gl = length(g), product = u.length * v.length;
  const double tg = 84.0 * kEpsSq * (u.terms * v.length + v.terms * u.length);
  // Relative to product^2 the square of the area has k = 11 and c = 16 + 16 + 16 + 24 + 1 + 42,
  // times the square of a permanent.
  const double ta = 160.0 * kEpsSq * product * product;
  const double error = (2.0 * gl + tg) * tg + ta * std::fabs(four.h) +
                       64.0 * kEpsSq * (gl * gl + area_sq.h * std::fabs(four.h));
  const PowerOfTwo unscale(exponent);
  if (ta <= 0x1p-52 * area_sq.h && error <= 0x1p-50 * std::fabs(value.h)) {
    return unscale * (signed_root(value.h) / (2.0 * std::sqrt(area_sq.h)));
  }
  const double square = lattice.unit * lattice.unit;
  if (std::fabs(value.h) + error < square * square * square) return 0.0;
  const FlatCentre<Big> exact(big(u), big(v), lift_big(u), lift_big(v));
  const Vector3<Big> gb{exact.across.x.compressed(), exact.across.y.compressed(),
                        exact.across.z.compressed()};
  const Big area = exact.area_sq.compressed();
  const Big difference = dot(gb, gb) - area * Big(Dd{4.0 * weight, 0.0});
  return unscale *
         (signed_root(difference.compressed().estimate()) / (2.0 * std::sqrt(area.estimate())));
}

double edge_root(const Weighted3& a, const Weighted3& b, const Lattice3& lattice, int exponent) {
  const View v(a, b);
  const PowerOfTwo unscale(exponent);
  const Dd d2 = normal(dot(pair(v), pair(v))), s = normal(lift_pair(v));
  const Dd four{4.0 * a.weight, 0.0}, value = s * s - d2 * four;
  const double error =
      128.0 * kEpsSq * (v.terms * v.terms + d2.h * std::fabs(four.h));  // c = 38 twice, and so on
  const double square = lattice.unit * lattice.unit;
  if (error <= 0x1p-50 * std::fabs(value.h)) {
    return unscale * (signed_root(value.h) / (2.0 * std::sqrt(d2.h)));
  }
  if (std::fabs(value.h) + error < square * square) return 0.0;
  const Big db = dot(big(v), big(v)).compressed(), sb = lift_big(v).compressed();
  const Big difference = sb * sb - db * Big(Dd{4.0 * a.weight, 0.0});
  return unscale *
         (signed_root(difference.compressed().estimate()) / (2.0 * std::sqrt(db.estimate())));
}

}  // namespace alphamesh
