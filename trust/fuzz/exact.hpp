// The geometry of a cloud in whole numbers of any length: what results are proved with.
// A first look in long double settles what is plain; nothing of the core is used here.
#pragma once

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <type_traits>
#include <utility>
#include <vector>

#include "../wide.hpp"
#include "decode.hpp"

namespace trust {

inline void require(bool holds, const char* claim) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", claim);
  std::abort();
}

// Wide or long double, with the size of the terms that were added.
struct Rough {
  long double value = 0, size = 0;
  friend Rough operator+(Rough a, Rough b) { return {a.value + b.value, a.size + b.size}; }
  friend Rough operator-(Rough a, Rough b) { return {a.value - b.value, a.size + b.size}; }
  friend Rough operator*(Rough a, Rough b) { return {a.value * b.value, a.size * b.size}; }
  bool sure() const { return std::fabs(value) > 0x1p-56L * size; }
  int sign() const { return (value > 0) - (value < 0); }
};

template <class R>
using Vector = std::array<R, 3>;

template <class R>
Vector<R> operator-(const Vector<R>& a, const Vector<R>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class R>
R dot(const Vector<R>& a, const Vector<R>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class R>
Vector<R> cross(const Vector<R>& a, const Vector<R>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class R>
R det(const Vector<R>& a, const Vector<R>& b, const Vector<R>& c) {
  return dot(cross(a, b), c);
}

// How often 2 divides v, negative for fractions; INT_MAX for zero.
inline int lowest_bit(double v) {
  if (v == 0.0) return INT_MAX;
  int e;
  auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(std::fabs(v), &e), 53));
  e -= 53;
  while ((mantissa & 1) == 0) mantissa >>= 1, ++e;
  return e;
}

using Id = std::int32_t;

class Geometry {
 public:
  // Points in the plane get a third coordinate, zero. Queries are numbered on from n, their
  // weights are zero.
  Geometry(const Cloud& cloud, const std::vector<double>& queries) {
    int least = 0;
    for (double v : cloud.coordinates) least = std::min(least, lowest_bit(v));
    for (double v : queries) least = std::min(least, lowest_bit(v));
    for (double w : cloud.weights) least = std::min(least, half_of(lowest_bit(w)));
    shift_ = -least;
    add(cloud.coordinates, cloud.dimension);
    add(queries, cloud.dimension);
    weight(cloud.weights);
  }

  // Places that no double holds, in units of 2^-shift, and rounded, by some units of the last
  // place of `size`. With weights for each, or none.
  Geometry(const std::vector<Vector<Wide>>& places, const std::vector<Vector<long double>>& rounded,
           long double size, const std::vector<double>& weights, int shift)
      : shift_(shift), size_(size), plain_(rounded), wide_(places) {
    weight(weights);
  }

  const Vector<Wide>& wide(Id i) const { return wide_[static_cast<std::size_t>(i)]; }
  const Vector<long double>& plain(Id i) const { return plain_[static_cast<std::size_t>(i)]; }
  bool weighted() const { return !plain_weight_.empty(); }
  double weight(Id i) const {
    return weighted() ? plain_weight_[static_cast<std::size_t>(i)] : 0.0;
  }

  // Lexicographically; weights do not count.
  bool before(Id a, Id b) const {
    if (size_ == 0) return plain(a) < plain(b);
    for (std::size_t k = 0; k < 3; ++k) {
      const int s = (wide(a)[k] - wide(b)[k]).sign();
      if (s != 0) return s < 0;
    }
    return false;
  }

  // Clouds on a plane of space are looked at along one axis.
  void look_along(std::size_t dropped) {
    axes_[0] = dropped == 0 ? 1 : 0;
    axes_[1] = dropped == 2 ? 1 : 2;
  }

  // +1 if a, b, c turn counter-clockwise, as looked at.
  int turn(Id a, Id b, Id c) const {
    return sign_of([&](auto kind) {
      using R = decltype(kind);
      const auto u = step<R>(b, a), v = step<R>(c, a);
      return u[axes_[0]] * v[axes_[1]] - u[axes_[1]] * v[axes_[0]];
    });
  }
  // Sign of (a - c) . (b - c).
  int angle(Id a, Id b, Id c) const {
    return sign_of([&](auto kind) {
      using R = decltype(kind);
      return dot(step<R>(a, c), step<R>(b, c));
    });
  }
  // Sign of (b - a) x (c - a) . (d - a).
  int side(Id a, Id b, Id c, Id d) const {
    return sign_of([&](auto kind) {
      using R = decltype(kind);
      return det(step<R>(b, a), step<R>(c, a), step<R>(d, a));
    });
  }
  bool on_line(Id a, Id b, Id c) const {
    for (int axis = 0; axis < 3; ++axis) {
      const int found = sign_of([&](auto kind) {
        using R = decltype(kind);
        return cross(step<R>(b, a), step<R>(c, a))[static_cast<std::size_t>(axis)];
      });
      if (found != 0) return false;
    }
    return true;
  }

  // +1 if c, between a and b on a line, is lifted below the segment from a to b; 0 on it.
  int in_interval(Id a, Id b, Id c) const {
    std::size_t axis = 0;
    while (axis < 2 && (wide(b)[axis] - wide(a)[axis]).sign() == 0) ++axis;
    return (wide(b)[axis] - wide(a)[axis]).sign() * sign_of([&](auto kind) {
             using R = decltype(kind);
             return lift<R>(a, c) * step<R>(b, c)[axis] - lift<R>(b, c) * step<R>(a, c)[axis];
           });
  }
  int in_interval_or_out(Id a, Id b, Id c) const {
    const int s = in_interval(a, b, c);
    if (s != 0) return s;
    if (before(a, c) && before(b, c)) return -1;
    const bool ascending = before(a, b);
    return (ascending ? before(a, c) : before(c, b)) == ascending ? 1 : -1;
  }

  // +1 if d is in the circle through a, b, c, counter-clockwise as looked at; 0 on it. With
  // weights, here and below, whether its power is less than theirs where these are equal.
  int in_circle(Id a, Id b, Id c, Id d) const {
    return sign_of([&](auto kind) {
      using R = decltype(kind);
      const auto u = step<R>(a, d), v = step<R>(b, d), w = step<R>(c, d);
      return lift<R>(a, d) * flat(v, w) - lift<R>(b, d) * flat(u, w) + lift<R>(c, d) * flat(u, v);
    });
  }
  // The same when ties are broken: the largest of the points is lifted most.
  int in_circle_or_out(Id a, Id b, Id c, Id d) const {
    const int s = in_circle(a, b, c, d);
    if (s != 0) return s;
    Id points[4] = {a, b, c, d};
    std::sort(points, points + 4, [this](Id i, Id j) { return before(j, i); });
    for (Id p : points) {
      const int by = p == a   ? turn(b, c, d)
                     : p == b ? turn(c, a, d)
                     : p == c ? turn(a, b, d)
                              : -turn(a, b, c);
      if (by != 0) return by;
    }
    return 0;
  }

  // +1 if e is in the sphere through a, b, c, d, positively oriented; 0 on it.
  int in_sphere(Id a, Id b, Id c, Id d, Id e) const {
    return sign_of([&](auto kind) {
      using R = decltype(kind);
      const auto s = step<R>(a, e), t = step<R>(b, e), u = step<R>(c, e), v = step<R>(d, e);
      return lift<R>(a, e) * det(t, u, v) - lift<R>(b, e) * det(s, u, v) +
             lift<R>(c, e) * det(s, t, v) - lift<R>(d, e) * det(s, t, u);
    });
  }
  int in_sphere_or_out(Id a, Id b, Id c, Id d, Id e) const {
    const int s = in_sphere(a, b, c, d, e);
    if (s != 0) return s;
    Id points[5] = {a, b, c, d, e};
    std::sort(points, points + 5, [this](Id i, Id j) { return before(j, i); });
    for (Id p : points) {
      const int by = p == a   ? side(e, b, c, d)
                     : p == b ? -side(e, a, c, d)
                     : p == c ? side(e, a, b, d)
                     : p == d ? -side(e, a, b, c)
                              : -side(a, b, c, d);
      if (by != 0) return by;
    }
    return 0;
  }

  // Which side of the smallest sphere through k points, 1 to 3: +1 if q is inside, 0 on it.
  int in_smallest(const Id* p, std::size_t k, Id q) const {
    return sign_of([&](auto kind) {
      using R = decltype(kind);
      // Inside if lift(q) < 2 (z - p0) . (q - p0); multiplied by the denominator of z.
      const auto w = step<R>(q, p[0]);
      const R height = lift<R>(q, p[0]);
      if (k == 1) return R() - height;
      const auto u = step<R>(p[1], p[0]);
      if (k == 2) return lift<R>(p[1], p[0]) * dot(u, w) - height * dot(u, u);
      const auto v = step<R>(p[2], p[0]), n = cross(u, v);
      const R along =
          lift<R>(p[1], p[0]) * dot(cross(v, n), w) + lift<R>(p[2], p[0]) * dot(cross(n, u), w);
      return along - height * dot(n, n);
    });
  }

  // Whether `radius` is the circumradius of k points, 1 to 4, or with weights the signed root of
  // their power value, up to a relative error.
  bool is_value(const Id* p, std::size_t k, double radius, double error) const {
    const auto [top, bottom] = value_of(p, k);
    const double some = std::fabs(radius) * error, low = radius - some, high = radius + some;
    const int finer = std::max({shift_, -lowest_bit(low), -lowest_bit(high)});
    const Wide unit = Wide::of(1.0, finer - shift_), t = top * unit * unit;
    const auto square = [&](double v) {
      const Wide root = Wide::of(v, finer);
      return v < 0 ? -(root * root) : root * root;
    };
    return (square(low) * bottom - t).sign() <= 0 && (square(high) * bottom - t).sign() >= 0;
  }
  bool is_zero(const Id* p, std::size_t k) const { return value_of(p, k).first.sign() == 0; }

 private:
  void add(const std::vector<double>& coordinates, std::size_t dimension) {
    for (std::size_t i = 0; i < coordinates.size(); i += dimension) {
      Vector<long double> p{};
      for (std::size_t k = 0; k < dimension; ++k) p[k] = coordinates[i + k];
      plain_.push_back(p);
      Vector<Wide> exact;
      for (std::size_t k = 0; k < dimension; ++k) exact[k] = Wide::of(coordinates[i + k], shift_);
      wide_.push_back(exact);
    }
  }
  void weight(const std::vector<double>& weights) {
    if (weights.empty()) return;
    plain_weight_ = weights;
    plain_weight_.resize(plain_.size());
    for (double w : plain_weight_) wide_weight_.push_back(Wide::of(w, 2 * shift_));
  }
  static int half_of(int bit) { return bit == INT_MAX ? bit : (bit - (bit & 1)) / 2; }

  // The square of the circumradius or, with weights, the power value: a quotient.
  std::pair<Wide, Wide> value_of(const Id* p, std::size_t k) const {
    const Wide weight = weighted() ? wide_weight_[static_cast<std::size_t>(p[0])] : Wide();
    if (k == 1) return {-weight, Wide::of(1.0, 0)};
    const Wide four = Wide::of(4.0, 0), lu = lift<Wide>(p[1], p[0]);
    const auto u = step<Wide>(p[1], p[0]);
    if (k == 2) {
      const Wide bottom = four * dot(u, u);
      return {lu * lu - bottom * weight, bottom};
    }
    const auto v = step<Wide>(p[2], p[0]), n = cross(u, v);
    const Wide lv = lift<Wide>(p[2], p[0]);
    // The orthocentre is z / 2d from the first point.
    Vector<Wide> z;
    Wide d;
    if (k == 3) {
      const auto vn = cross(v, n), nu = cross(n, u);
      for (std::size_t a = 0; a < 3; ++a) z[a] = lu * vn[a] + lv * nu[a];
      d = dot(n, n);
    } else {
      const auto w = step<Wide>(p[3], p[0]), vw = cross(v, w), wu = cross(w, u);
      const Wide lw = lift<Wide>(p[3], p[0]);
      for (std::size_t a = 0; a < 3; ++a) z[a] = lu * vw[a] + lv * wu[a] + lw * n[a];
      d = dot(n, w);
    }
    const Wide bottom = four * d * d;
    return {dot(z, z) - bottom * weight, bottom};
  }

  // The square of the distance less the difference of the weights.
  template <class R>
  R lift(Id to, Id from) const {
    const auto v = step<R>(to, from);
    const R square = dot(v, v);
    if (!weighted()) return square;
    if constexpr (std::is_same_v<R, Wide>) {
      return square - wide_weight_[static_cast<std::size_t>(to)] +
             wide_weight_[static_cast<std::size_t>(from)];
    } else {
      const long double change = static_cast<long double>(weight(to)) - weight(from);
      return square - Rough{change, std::fabs(change)};
    }
  }

  template <class R>
  Vector<R> step(Id to, Id from) const {
    if constexpr (std::is_same_v<R, Wide>) {
      return wide(to) - wide(from);
    } else {
      Vector<Rough> v;
      for (std::size_t k = 0; k < 3; ++k) {
        const long double d = plain(to)[k] - plain(from)[k];
        v[k] = {d, size_ == 0 ? std::fabs(d) : size_};
      }
      return v;
    }
  }

  template <class R>
  R flat(const Vector<R>& a, const Vector<R>& b) const {
    return a[axes_[0]] * b[axes_[1]] - a[axes_[1]] * b[axes_[0]];
  }

  template <class Expression>
  int sign_of(Expression&& of) const {
    const Rough rough = of(Rough{});
    return rough.sure() ? rough.sign() : of(Wide{}).sign();
  }

  int shift_ = 0;
  long double size_ = 0;
  std::array<std::size_t, 2> axes_{0, 1};
  std::vector<Vector<long double>> plain_;
  std::vector<Vector<Wide>> wide_;
  std::vector<double> plain_weight_;  // empty without weights
  std::vector<Wide> wide_weight_;
};

}  // namespace trust
