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
  // Points in the plane get a third coordinate, zero. Queries are numbered on from n.
  Geometry(const Cloud& cloud, const std::vector<double>& queries) {
    int least = 0;
    for (double v : cloud.coordinates) least = std::min(least, lowest_bit(v));
    for (double v : queries) least = std::min(least, lowest_bit(v));
    shift_ = -least;
    add(cloud.coordinates, cloud.dimension);
    add(queries, cloud.dimension);
    axes_ = {0, 1};
  }

  int shift() const { return shift_; }
  const Vector<Wide>& wide(Id i) const { return wide_[static_cast<std::size_t>(i)]; }
  const Vector<double>& plain(Id i) const { return plain_[static_cast<std::size_t>(i)]; }

  bool before(Id a, Id b) const { return plain(a) < plain(b); }
  bool same(Id a, Id b) const { return plain(a) == plain(b); }

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

  // +1 if d is in the circle through a, b, c, counter-clockwise as looked at; 0 on it.
  int in_circle(Id a, Id b, Id c, Id d) const {
    return sign_of([&](auto kind) {
      using R = decltype(kind);
      const auto u = step<R>(a, d), v = step<R>(b, d), w = step<R>(c, d);
      return dot(u, u) * flat(v, w) - dot(v, v) * flat(u, w) + dot(w, w) * flat(u, v);
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
      return dot(s, s) * det(t, u, v) - dot(t, t) * det(s, u, v) + dot(u, u) * det(s, t, v) -
             dot(v, v) * det(s, t, u);
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

  // Which side of the smallest sphere through a, b, c: +1 if d is inside, 0 on it.
  int in_smallest(Id a, Id b, Id c, Id d) const {
    return sign_of([&](auto kind) {
      using R = decltype(kind);
      // Inside if |d - z|^2 < r^2 with z = a + (u2 (v x n) + v2 (n x u)) / 2n.n, n = u x v.
      const auto u = step<R>(b, a), v = step<R>(c, a), w = step<R>(d, a), n = cross(u, v);
      const auto vn = cross(v, n), nu = cross(n, u);
      const R u2 = dot(u, u), v2 = dot(v, v), along = u2 * dot(vn, w) + v2 * dot(nu, w);
      return along - dot(w, w) * dot(n, n);
    });
  }

  // Whether `radius` is the circumradius of k points, 2 to 4, up to a relative error.
  bool is_circumradius(const Id* p, std::size_t k, double radius, double error) const {
    Wide top, bottom;  // the square of the radius is their quotient
    const auto u = step<Wide>(p[1], p[0]);
    const Wide four = Wide::of(4.0, 0);
    if (k == 2) {
      top = dot(u, u);
      bottom = four;
    } else if (k == 3) {
      const auto v = step<Wide>(p[2], p[0]), w = v - u, n = cross(u, v);
      top = dot(u, u) * dot(v, v) * dot(w, w);
      bottom = four * dot(n, n);
    } else {
      const auto v = step<Wide>(p[2], p[0]), w = step<Wide>(p[3], p[0]);
      const auto vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
      const Wide u2 = dot(u, u), v2 = dot(v, v), w2 = dot(w, w), d = dot(uv, w);
      Vector<Wide> z;
      for (std::size_t a = 0; a < 3; ++a) z[a] = u2 * vw[a] + v2 * wu[a] + w2 * uv[a];
      top = dot(z, z);
      bottom = four * d * d;
    }
    const double low = radius * (1.0 - error), high = radius * (1.0 + error);
    const int finer = std::max({shift_, -lowest_bit(low), -lowest_bit(high)});
    const Wide unit = Wide::of(1.0, finer - shift_);
    const Wide l = Wide::of(low, finer), h = Wide::of(high, finer), t = top * unit * unit;
    return (l * l * bottom - t).sign() <= 0 && (h * h * bottom - t).sign() >= 0;
  }

 private:
  void add(const std::vector<double>& coordinates, std::size_t dimension) {
    for (std::size_t i = 0; i < coordinates.size(); i += dimension) {
      Vector<double> p{};
      for (std::size_t k = 0; k < dimension; ++k) p[k] = coordinates[i + k];
      plain_.push_back(p);
      wide_.push_back({Wide::of(p[0], shift_), Wide::of(p[1], shift_), Wide::of(p[2], shift_)});
    }
  }

  template <class R>
  Vector<R> step(Id to, Id from) const {
    if constexpr (std::is_same_v<R, Wide>) {
      return wide(to) - wide(from);
    } else {
      Vector<Rough> v;
      for (std::size_t k = 0; k < 3; ++k) {
        const long double d =
            static_cast<long double>(plain(to)[k]) - static_cast<long double>(plain(from)[k]);
        v[k] = {d, std::fabs(d)};
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
  std::array<std::size_t, 2> axes_{};
  std::vector<Vector<double>> plain_;
  std::vector<Vector<Wide>> wide_;
};

}  // namespace trust
