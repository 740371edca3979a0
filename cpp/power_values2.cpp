#include "power_values2.hpp"

#include <algorithm>
#include <cmath>

#include "big.hpp"
#include "vertex_rows.hpp"

namespace alphamesh {
namespace {

constexpr double kShare = 128.0;  // of half a unit in the last place: what a power may be off

double larger(double a, double b) { return a > b ? a : b; }  // as one instruction

Vector2<double> vector(const double (*x)[2][TriangleBlock::kSize], int k, int m, std::size_t i) {
  return {x[k][0][i] - x[m][0][i], x[k][1][i] - x[m][1][i]};
}
Vector3<double> vector(const double (*x)[3][TriangleBlock::kSize], int k, int m, std::size_t i) {
  return {x[k][0][i] - x[m][0][i], x[k][1][i] - x[m][1][i], x[k][2][i] - x[m][2][i]};
}

double dot_of_magnitudes(const Vector2<double>& a, const Vector2<double>& b) {
  return std::fabs(a.x * b.x) + std::fabs(a.y * b.y);
}
double dot_of_magnitudes(const Vector3<double>& a, const Vector3<double>& b) {
  return std::fabs(a.x * b.x) + std::fabs(a.y * b.y) + std::fabs(a.z * b.z);
}

// The squared cross product, and the same of the magnitudes of its terms.
struct Cross {
  double square, terms;
};

Cross cross_sq(const Vector2<double>& a, const Vector2<double>& b) {
  const double l = a.x * b.y, r = a.y * b.x, det = l - r, sum = std::fabs(l) + std::fabs(r);
  return {det * det, sum * sum};
}
Cross cross_sq(const Vector3<double>& a, const Vector3<double>& b) {
  const Cross x = cross_sq(Vector2<double>{a.y, a.z}, {b.y, b.z});
  const Cross y = cross_sq(Vector2<double>{a.z, a.x}, {b.z, b.x});
  const Cross z = cross_sq(Vector2<double>{a.x, a.y}, {b.x, b.y});
  return {x.square + y.square + z.square, x.terms + y.terms + z.terms};
}

template <class R>
R cross_square(const Vector2<R>& a, const Vector2<R>& b) {
  const R det = a.x * b.y - a.y * b.x;
  return det * det;
}
template <class R>
R cross_square(const Vector3<R>& a, const Vector3<R>& b) {
  const Vector3<R> n = cross(a, b);
  return dot(n, n);
}

double accurate_cross_sq(Point2 a, Point2 b, Point2 c) {
  const double det = cross_accurate(a, b, c);
  return det * det;
}
double accurate_cross_sq(SheetPoint a, SheetPoint b, SheetPoint c) {
  const Vector3<double> n = normal_accurate(a, b, c);
  return dot(n, n);
}

Vector2<Big> big(const Vector2<Dd>& v) { return {Big(v.x), Big(v.y)}; }
Vector3<Big> big(const Vector3<Dd>& v) { return {Big(v.x), Big(v.y), Big(v.z)}; }

template <class R>
R fourfold(const R& a) {
  const R twice = a + a;
  return twice + twice;
}

// |f (|e|^2 + ew) - e (|f|^2 + fw)|^2 as a quadratic form.
template <class R, class V>
R shifted_square(const V& e, const V& f, const R& ew, const R& fw) {
  const R e2 = dot(e, e), f2 = dot(f, f), ef = dot(e, f), s = e2 + ew, t = f2 + fw;
  const R st = s * t * ef;
  return s * s * f2 - (st + st) + t * t * e2;
}

// The signed root of num / (4 den) times 2^exponent, without overflow on the way.
double root_of_quotient(double num, double den, int exponent) {
  if (num == 0.0) return 0.0;
  int en, ed;
  double q = std::frexp(num, &en) / std::frexp(den, &ed);
  int e = en - ed;
  if ((e & 1) != 0) {
    q *= 2.0;
    --e;
  }
  return std::ldexp(signed_root(q), e / 2 - 1 + exponent);
}

// num, if its error is small or it is known to be zero; else exactly.
template <class Exact>
double settle(Dd num, double terms, double resolution, Exact&& exact) {
  const double bound = 0x1p-95 * terms;
  if (std::fabs(num.h) > 0x1p-46 * terms) return num.h + num.l;
  if (std::fabs(num.h) + bound < resolution) return 0.0;
  return exact().estimate();
}

// The power value of a triangle is (N^2 - 4 n^2 w) / (4 n^2): see PowerTriangles::evaluate().
template <class P>
double careful_radius(const Weighted<P>* corner, const Lattice& lattice, int exponent) {
  const Weighted<P>&a = corner[0], &b = corner[1], &c = corner[2];
  const auto e = exact_offset(b, a), f = exact_offset(c, a);
  const Dd ew = two_diff(a.w, b.w), fw = two_diff(a.w, c.w);
  const Dd e2 = dot(e, e), f2 = dot(f, f);
  const double s = e2.h + std::fabs(ew.h), t = f2.h + std::fabs(fw.h);
  const double n = s * std::sqrt(f2.h) + t * std::sqrt(e2.h);
  const double terms = n * n + 4.0 * e2.h * f2.h * std::fabs(a.w);
  const Dd num = shifted_square(e, f, ew, fw) - fourfold(cross_square(e, f)) * Dd{a.w, 0.0};
  const double u3 = lattice.unit * lattice.unit * lattice.unit;
  const double exact = settle(num, terms, u3 * u3, [&] {
    const auto i = big(e), j = big(f);
    return shifted_square(i, j, Big(ew), Big(fw)) -
           fourfold(cross_square(i, j)) * Big(Dd{a.w, 0.0});
  });
  return root_of_quotient(exact, accurate_cross_sq(a, b, c), exponent);
}

// ((L + w_a - w_b)^2 - 4 L w_a) / (4 L), L the squared length.
template <class P>
double careful_edge(const Weighted<P>& p, const Weighted<P>& q, const Lattice& lattice) {
  const Weighted<P>&a = p < q ? p : q, &b = p < q ? q : p;
  const auto e = exact_offset(b, a);
  const Dd w = two_diff(a.w, b.w), length_sq = dot(e, e), s = length_sq + w;
  const double most = length_sq.h + std::fabs(w.h);
  const double terms = most * most + 4.0 * length_sq.h * std::fabs(a.w);
  const double u2 = lattice.unit * lattice.unit;
  const double num = settle(s * s - fourfold(length_sq) * Dd{a.w, 0.0}, terms, u2 * u2, [&] {
    const auto i = big(e);
    const Big square = dot(i, i), sum = square + Big(w);
    return sum * sum - fourfold(square) * Big(Dd{a.w, 0.0});
  });
  return root_of_quotient(num, length_sq.h, 0);
}

// The sign of the barycentric coordinate of the orthocentre that belongs to c, of counter-
// clockwise a, b, c.
template <class P>
int exact_side(const Weighted<P>& a, const Weighted<P>& b, const Weighted<P>& c,
               const Lattice& lattice) {
  const auto e = exact_offset(b, a), f = exact_offset(c, a);
  const Dd ew = two_diff(a.w, b.w), fw = two_diff(a.w, c.w);
  const Dd e2 = dot(e, e), f2 = dot(f, f);
  const Dd side = e2 * (f2 + fw) - dot(e, f) * (e2 + ew);
  const double sum =
      e2.h * (f2.h + std::fabs(fw.h)) + std::sqrt(e2.h * f2.h) * (e2.h + std::fabs(ew.h));
  const double bound = 0x1p-98 * sum;
  if (std::fabs(side.h) > bound) return sign_of(side.h);
  const double u2 = lattice.unit * lattice.unit;
  if (std::fabs(side.h) + bound < u2 * u2) return 0;
  const auto i = big(e), j = big(f);
  const Big i2 = dot(i, i);
  return (i2 * (dot(j, j) + Big(fw)) - dot(i, j) * (i2 + Big(ew))).sign();
}

Weighted3 in_space(const Weighted<SheetPoint>& p) { return {Point3(p), p.w}; }

void store(const Point2& p, double (*to)[TriangleBlock::kSize], std::size_t i) {
  to[0][i] = p.x;
  to[1][i] = p.y;
}
void store(const SheetPoint& p, double (*to)[TriangleBlock::kSize], std::size_t i) {
  to[0][i] = p.x;
  to[1][i] = p.y;
  to[2][i] = p.z;
}

}  // namespace

// From the vertex opposite to the longest side on, where terms cancel least; of equal ones
// the lexicographically least, so that the result does not depend on where the triangle
// began, to the last bit.
template <class P>
void PowerTriangles<P>::push(const Weighted<P>& a, const Weighted<P>& b, const Weighted<P>& c) {
  const Weighted<P>* p[5] = {&a, &b, &c, &a, &b};
  int first = b < a ? 1 : 0;
  first = c < *p[first] ? 2 : first;
  double side[3];  // opposite to each vertex
  for (int k = 0; k < 3; ++k) {
    const auto e = offset(*p[(first + k + 1) % 3], *p[(first + k + 2) % 3]);
    side[k] = dot(e, e);
  }
  int base = side[1] > side[0] ? 1 : 0;
  base = side[2] > side[base] ? 2 : base;
  first = (first + base) % 3;
  const Weighted<P>* const* q = p + first;
  for (int k = 0; k < 3; ++k) {
    store(*q[k], x_[k], count);
    w_[k][count] = q[k]->w;
  }
  first_[count++] = first;
  if constexpr (kDim == 3) {
    const Weighted<P>* v[3] = {&a, &b, &c};
    std::sort(v, v + 3, [](const Weighted<P>* l, const Weighted<P>* r) { return *l < *r; });
    in_space_.push(in_space(*v[0]), in_space(*v[1]), in_space(*v[2]));
  }
}

template <class P>
Weighted<P> PowerTriangles<P>::corner(std::size_t i, int k) const {
  if constexpr (kDim == 2) {
    return {{x_[k][0][i], x_[k][1][i]}, w_[k][i]};
  } else {
    return {{x_[k][0][i], x_[k][1][i], x_[k][2][i]}, w_[k][i]};
  }
}

// With u, v, w the sides from a to b, b to c, c to a, the orthocentre is N / (2 n) from a,
// where n is the cross product and N^2 = |(U + w_a - w_b) w + (W + w_a - w_c) u|^2, which is
// U V W if the weights are equal.
template <class P>
void PowerTriangles<P>::evaluate(const Lattice& lattice) {
  const double exact4 = 0.25 * lattice.exact4;
  for (std::size_t i = 0; i < count; ++i) {
    const auto u = vector(x_, 1, 0, i), v = vector(x_, 2, 1, i), w = vector(x_, 0, 2, i);
    const double u2 = dot(u, u), v2 = dot(v, v), w2 = dot(w, w);
    const double at_a = -dot(u, w), at_b = -dot(u, v), at_c = -dot(v, w);
    const double aw = w_[0][i], bw = w_[1][i], cw = w_[2][i];
    const double ab = aw - bw, bc = bw - cw, ca = cw - aw;
    const double mab = std::fabs(ab), mbc = std::fabs(bc), mca = std::fabs(ca);
    const Cross n = cross_sq(u, w);
    const double half_a = 0.5 * (u2 + w2), half_b = 0.5 * (u2 + v2), half_c = 0.5 * (v2 + w2);

    const double plain = (u2 * v2) * w2;
    const double mixed = u2 * (w2 * (ab - ca)) + at_a * (u2 * ca - w2 * ab);
    const double shift = w2 * (ab * ab) + 2.0 * (at_a * (ab * ca)) + u2 * (ca * ca);
    const double m = u2 * (w2 * (mab + mca)) + dot_of_magnitudes(u, w) * (u2 * mca + w2 * mab);
    const double ms = 2.0 * (w2 * (ab * ab) + u2 * (ca * ca));
    const double quarter = 0.25 / n.square;
    const double radius_sq = ((plain + 2.0 * mixed) + shift) * quarter;
    const double value = radius_sq - aw;
    const double spread = std::sqrt(n.terms / n.square);
    const double error = 6.0 * spread * radius_sq + 19.0 * ((plain + 2.0 * m) + ms) * quarter +
                         4.0 * (radius_sq + std::fabs(aw));
    // No less than the vertices: true in exact arithmetic, so enforced.
    const double least = -(aw < bw ? (aw < cw ? aw : cw) : (bw < cw ? bw : cw));
    const double power = larger(value, least), root = std::sqrt(std::fabs(power));
    radius[i] = power < 0.0 ? -root : root;
    bad_value_[i] = error <= kShare * std::fabs(value) && radius_sq < kLargeSq ? 0.0 : 1.0;

    const double s0 = u2 * (w2 - ca) - at_a * (u2 + ab);
    const double s1 = v2 * (u2 - ab) - at_b * (v2 + bc);
    const double s2 = w2 * (v2 - bc) - at_c * (w2 + ca);
    const double t0 = u2 * (w2 + mca) + half_a * (u2 + mab);
    const double t1 = v2 * (u2 + mab) + half_b * (v2 + mbc);
    const double t2 = w2 * (v2 + mbc) + half_c * (w2 + mca);
    const double terms = larger(t0, larger(t1, t2));
    const double b0 = terms < exact4 ? -1.0 : 16.0 * kEps * t0;
    const double b1 = terms < exact4 ? -1.0 : 16.0 * kEps * t1;
    const double b2 = terms < exact4 ? -1.0 : 16.0 * kEps * t2;
    if constexpr (kDim == 2) {
      mask_[i] = (s0 > 0.0 ? 0.0 : 1.0) + (s1 > 0.0 ? 0.0 : 2.0) + (s2 > 0.0 ? 0.0 : 4.0);
    } else {
      mask_[i] = (s0 < 0.0 ? 1.0 : 0.0) + (s1 < 0.0 ? 2.0 : 0.0) + (s2 < 0.0 ? 4.0 : 0.0);
    }
    bad_side_[i] = (std::fabs(s0) > b0 ? 0.0 : 1.0) + (std::fabs(s1) > b1 ? 0.0 : 1.0) +
                   (std::fabs(s2) > b2 ? 0.0 : 1.0);
  }
}

template <class P>
void PowerTriangles<P>::measure(const Lattice& lattice, int exponent) {
  evaluate(lattice);
  if constexpr (kDim == 3) {
    in_space_.measure(Lattice3(lattice.unit), exponent);
    in_space_.count = 0;
    std::copy(in_space_.radius, in_space_.radius + count, radius);
    std::fill(bad_value_, bad_value_ + count, 0.0);
  }
  const PowerOfTwo unscale(kDim == 3 ? 0 : -exponent);
  for (std::size_t i = 0; i < count; ++i) {
    radius[i] = unscale * radius[i];
    int mask = static_cast<int>(mask_[i]);
    if (bad_value_[i] + bad_side_[i] != 0.0) {
      const Weighted<P> p[3] = {corner(i, 0), corner(i, 1), corner(i, 2)};
      if (bad_side_[i] != 0.0) {
        mask = 0;
        for (int k = 0; k < 3; ++k) {
          const int side = exact_side(p[k], p[(k + 1) % 3], p[(k + 2) % 3], lattice);
          mask |= (is_attached(side) ? 1 : 0) << k;
        }
      }
      if (bad_value_[i] != 0.0) {
        const double least = signed_root(0.0 - std::min(p[0].w, std::min(p[1].w, p[2].w)));
        radius[i] = larger(careful_radius(p, lattice, -exponent), unscale * least);
      }
    }
    mask <<= first_[i];  // edge k is edge first + k of the triangle as it came
    attached[i] = (mask | mask >> 3) & 7;
  }
}

template <class P>
void PowerEdges<P>::set(std::size_t i, const Weighted<P>& a, const Weighted<P>& b) {
  const auto e = offset(a, b);
  a_[i] = a;
  b_[i] = b;
  length_sq_[i] = dot(e, e);
  aw_[i] = a.w;
  bw_[i] = b.w;
}

template <>
void PowerEdges<SheetPoint>::measure(std::size_t count, const Lattice& lattice) {
  for (std::size_t i = 0; i < count; ++i) {
    const bool turned = b_[i] < a_[i];
    const Weighted3 a = in_space(turned ? b_[i] : a_[i]), b = in_space(turned ? a_[i] : b_[i]);
    radius[i] = power_radius(a, b, Lattice3(lattice.unit), 0);
  }
}

// L / 4 - (w_a + w_b) / 2 + (w_a - w_b)^2 / (4 L); some ten roundings of the terms.
template <class P>
void PowerEdges<P>::measure(std::size_t count, const Lattice& lattice) {
  for (std::size_t i = 0; i < count; ++i) {
    const double square = length_sq_[i], difference = aw_[i] - bw_[i];
    const double quarter = 0.25 * square, mean = 0.5 * (aw_[i] + bw_[i]);
    const double shift = difference * (0.25 * difference / square);
    const double value = (quarter - mean) + shift;
    const double power = larger(value, aw_[i] < bw_[i] ? -aw_[i] : -bw_[i]);
    const double root = std::sqrt(std::fabs(power));
    radius[i] = power < 0.0 ? -root : root;
    bad_[i] = 6.0 * quarter + 3.0 * std::fabs(mean) + 9.0 * shift <= kShare * std::fabs(value)
                  ? 0.0
                  : 1.0;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (bad_[i] == 0.0) continue;
    const double least = signed_root(0.0 - std::min(aw_[i], bw_[i]));
    radius[i] = larger(careful_edge(a_[i], b_[i], lattice), least);
  }
}

template class PowerTriangles<Point2>;
template class PowerTriangles<SheetPoint>;
template class PowerEdges<Point2>;
template class PowerEdges<SheetPoint>;

}  // namespace alphamesh
