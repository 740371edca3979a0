// The circumsphere of a tetrahedron as a record, so that testing a point is a dot product.
#pragma once

#include <cstdint>
#include <cstring>

#include "power3.hpp"
#include "predicates3.hpp"

namespace alphamesh {

// The circumsphere of a tetrahedron, as in_sphere() needs it: the sign of
// n . e - w |e|^2, e the point relative to the origin, is sure beyond b1 |e|^2 + b0.
struct alignas(64) Sphere {
  double nx, ny, nz, w, ox, oy, oz;
  std::uint32_t b0, b1;  // upper halves of doubles, rounded up
};

inline std::uint32_t upper_half(double v) {
  std::uint64_t bits;
  std::memcpy(&bits, &v, sizeof bits);
  return static_cast<std::uint32_t>(bits >> 32) + 1;
}

inline double from_upper_half(std::uint32_t half) {
  const std::uint64_t bits = std::uint64_t{half} << 32;
  double v;
  std::memcpy(&v, &bits, sizeof v);
  return v;
}

// A vertex of a cavity's border relative to the new point. The point at infinity has the
// coordinates 0, the square 1 and the length 0, which turns spheres into planes.
struct Arm {
  double x, y, z, square, length;
  std::int32_t vertex;
};

template <class S, class A>
inline void set_equation(S& s, Point3 p, const A& a, const A& b, const A& c) {
  const double bx = b.y * c.z - b.z * c.y, by = b.z * c.x - b.x * c.z, bz = b.x * c.y - b.y * c.x;
  const double cx = c.y * a.z - c.z * a.y, cy = c.z * a.x - c.x * a.z, cz = c.x * a.y - c.y * a.x;
  const double ax = a.y * b.z - a.z * b.y, ay = a.z * b.x - a.x * b.z, az = a.x * b.y - a.y * b.x;
  s.nx = a.square * bx + b.square * cx + c.square * ax;
  s.ny = a.square * by + b.square * cy + c.square * ay;
  s.nz = a.square * bz + b.square * cz + c.square * az;
  s.w = a.x * bx + a.y * by + a.z * bz;
  s.ox = p.x;
  s.oy = p.y;
  s.oz = p.z;
}

inline Sphere sphere_of(Point3 p, const Arm& a, const Arm& b, const Arm& c) {
  Sphere s;
  set_equation(s, p, a, b, c);
  // The terms add up to at most sqrt(3) |a||b||c| (s |e| + |e|^2), s = |a| + |b| + |c|, and
  // for a ghost to sqrt(3) |a||b||e|; s |e| is at most (s^2 + |e|^2) / 2. Some 16 roundings.
  const double product = a.length * b.length * c.length, sum = a.length + b.length + c.length;
  if (product != 0.0) {
    s.b0 = upper_half(16.0 * kEps * product * sum * sum);
    s.b1 = upper_half(48.0 * kEps * product);
  } else {
    const double pair = a.length * b.length + b.length * c.length + c.length * a.length;
    s.b0 = upper_half(16.0 * kEps * pair * sum);
    s.b1 = upper_half(16.0 * kEps * pair / sum);
  }
  return s;
}

struct Verdict {
  double value, bound;
};

inline Verdict test(const Sphere& s, Point3 q) {
  const double x = q.x - s.ox, y = q.y - s.oy, z = q.z - s.oz, square = x * x + y * y + z * z;
  return {s.nx * x + s.ny * y + s.nz * z - s.w * square,
          from_upper_half(s.b1) * square + from_upper_half(s.b0)};
}

// The same with weights: the sphere orthogonal to the four balls. Where it says |e|^2 above, it
// is less by how much heavier e is than the origin; the sign is sure beyond
// b1 |e|^2 + b2 |difference of weights| + b0.
struct PowerSphere {
  double nx, ny, nz, w, ox, oy, oz, weight;
  std::uint32_t b0, b1, b2;
};

// `square` is lifted, `terms` the sum of the magnitudes of what it is made of.
struct PowerArm {
  double x, y, z, square, length, terms;
  std::int32_t vertex;
};

inline PowerSphere sphere_of(const Weighted3& p, const PowerArm& a, const PowerArm& b,
                             const PowerArm& c) {
  PowerSphere s;
  set_equation(s, p, a, b, c);
  s.weight = p.weight;
  // With P = |a||b||c|, T = sum of terms(a) |b||c| and s = |a| + |b| + |c| the terms add up to at
  // most 2 / sqrt(3) (T |e| + P terms(e)), and T |e| to T (s + |e|^2 / s) / 2. For a ghost P is 0.
  // Some 18 roundings, two more than without weights.
  const double bc = b.length * c.length, ca = c.length * a.length, ab = a.length * b.length;
  const double product = a.length * bc, sum = a.length + b.length + c.length;
  const double terms = a.terms * bc + b.terms * ca + c.terms * ab;
  s.b0 = upper_half(16.0 * kEps * terms * sum);
  s.b1 = upper_half(kEps * (16.0 * terms / sum + 32.0 * product));
  s.b2 = upper_half(32.0 * kEps * product);
  return s;
}

inline Verdict test(const PowerSphere& s, const Weighted3& q) {
  const double x = q.x - s.ox, y = q.y - s.oy, z = q.z - s.oz, square = x * x + y * y + z * z;
  const double weight = q.weight - s.weight;
  return {s.nx * x + s.ny * y + s.nz * z - s.w * (square - weight),
          from_upper_half(s.b1) * square + from_upper_half(s.b2) * std::fabs(weight) +
              from_upper_half(s.b0)};
}

}  // namespace alphamesh
