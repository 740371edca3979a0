// The circumsphere of a tetrahedron as a record, so that testing a point is a dot product.
#pragma once

#include <cstdint>
#include <cstring>

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

inline Sphere sphere_of(Point3 p, const Arm& a, const Arm& b, const Arm& c) {
  const double bx = b.y * c.z - b.z * c.y, by = b.z * c.x - b.x * c.z, bz = b.x * c.y - b.y * c.x;
  const double cx = c.y * a.z - c.z * a.y, cy = c.z * a.x - c.x * a.z, cz = c.x * a.y - c.y * a.x;
  const double ax = a.y * b.z - a.z * b.y, ay = a.z * b.x - a.x * b.z, az = a.x * b.y - a.y * b.x;
  Sphere s;
  s.nx = a.square * bx + b.square * cx + c.square * ax;
  s.ny = a.square * by + b.square * cy + c.square * ay;
  s.nz = a.square * bz + b.square * cz + c.square * az;
  s.w = a.x * bx + a.y * by + a.z * bz;
  s.ox = p.x;
  s.oy = p.y;
  s.oz = p.z;
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

}  // namespace alphamesh
