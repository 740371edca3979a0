// Distances in long double: what those of the core are held against.
#pragma once

#include <algorithm>
#include <cmath>

#include "exact.hpp"

namespace trust {

// From p to the segment from a to b, in the plane.
inline long double distance(const Vector<long double>& p, const Vector<long double>& a,
                            const Vector<long double>& b) {
  const long double x = b[0] - a[0], y = b[1] - a[1];
  const long double u = p[0] - a[0], v = p[1] - a[1];
  const long double square = x * x + y * y;
  const long double t = square > 0 ? std::min(1.0L, std::max(0.0L, (u * x + v * y) / square)) : 0;
  return std::hypot(u - t * x, v - t * y);
}

// From a point to a triangle, in space.
inline long double distance(const Vector<long double>& point, const Vector<long double>& first,
                            const Vector<long double>& second, const Vector<long double>& third) {
  using Long = Vector<long double>;
  const Long p = point, corners[3] = {first, second, third};
  const auto length = [](const Long& v) { return std::hypot(v[0], v[1], v[2]); };
  long double least = HUGE_VALL;
  for (int k = 0; k < 3; ++k) {
    const Long a = corners[k], u = corners[(k + 1) % 3] - a, w = p - a;
    const long double square = dot(u, u);
    const long double t = square > 0 ? std::min(1.0L, std::max(0.0L, dot(w, u) / square)) : 0;
    least = std::min(least, length(Long{w[0] - t * u[0], w[1] - t * u[1], w[2] - t * u[2]}));
  }
  const Long u = corners[1] - corners[0], v = corners[2] - corners[0], w = p - corners[0];
  const Long n = cross(u, v);
  const long double square = dot(n, n);
  if (square > 0) {
    const long double s = dot(cross(w, v), n) / square, t = dot(cross(u, w), n) / square;
    if (s >= 0 && t >= 0 && s + t <= 1) {
      least = std::min(least, std::fabs(dot(w, n)) / std::sqrt(square));
    }
  }
  return least;
}

}  // namespace trust
