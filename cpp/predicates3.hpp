// Exact predicates in space: which side of a plane, which side of a sphere, which angle.
//
// Each reads filter, then double-double, then exact, as in predicates2.hpp. Coordinates
// must lie below 2^165 and be multiples of 2^-160, where products of six differences
// neither overflow nor underflow.
#pragma once

#include <cmath>

#include "predicates2.hpp"

namespace alphamesh {

struct Point3 {
  double x, y, z;
};

inline bool operator==(Point3 a, Point3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

inline bool operator<(Point3 a, Point3 b) {  // lexicographic
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

// All coordinates are multiples of `unit` (0: nothing known); see Lattice.
struct Lattice3 {
  double unit = 0.0;
  // Sums of products of two, three, five or six below these are exact.
  double exact2 = 0.0, exact3 = 0.0, exact5 = 0.0, exact6 = 0.0;

  Lattice3() = default;
  explicit Lattice3(double u)
      : unit(u),
        exact2(std::ldexp(u * u, 53)),
        exact3(std::ldexp(u * u * u, 53)),
        exact5(std::ldexp(u * u * u * u * u, 53)),
        exact6(std::ldexp(u * u * u * u * u * u, 53)) {}
};

template <class R>
struct Vector3 {
  R x, y, z;
};

template <class R>
inline Vector3<R> cross(const Vector3<R>& a, const Vector3<R>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class R>
inline R dot(const Vector3<R>& a, const Vector3<R>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline Vector3<double> operator-(Point3 a, Point3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

// A point whose coordinates are sums of two doubles, the first rounded: a copy in a periodic box.
struct Place3 {
  Point3 high, low;

  Dd x() const { return {high.x, low.x}; }
  Dd y() const { return {high.y, low.y}; }
  Dd z() const { return {high.z, low.z}; }
};

inline Vector3<double> operator-(const Place3& a, const Place3& b) {
  const Vector3<double> high = a.high - b.high, low = a.low - b.low;
  return {high.x + low.x, high.y + low.y, high.z + low.z};
}

inline double norm(const Vector3<double>& a) { return std::sqrt(dot(a, a)); }

int orient3_exact(Point3 a, Point3 b, Point3 c, Point3 d, const Lattice3& lattice);
int in_sphere_exact(Point3 a, Point3 b, Point3 c, Point3 d, Point3 e, const Lattice3& lattice);
int dot3_exact(Point3 a, Point3 b, Point3 c, const Lattice3& lattice);
// Sign of the barycentric coordinate of the circumcentre of a positive tetrahedron that
// belongs to its vertex `k`: negative if that vertex lies inside the smallest sphere
// through the other three, zero if on it.
int circumcentre_side_exact(const Point3* p, int k, const Lattice3& lattice);

// Sign of (b - a) x (c - a) . (d - a): +1 if a, b, c, d is positively oriented.
inline int orient3(Point3 a, Point3 b, Point3 c, Point3 d, const Lattice3& lattice) {
  const Vector3<double> u = b - a, v = c - a, w = d - a;
  const double xy = u.x * v.y, yx = u.y * v.x, yz = u.y * v.z, zy = u.z * v.y;
  const double zx = u.z * v.x, xz = u.x * v.z;
  const double det = (yz - zy) * w.x + (zx - xz) * w.y + (xy - yx) * w.z;
  const double sum = (std::fabs(yz) + std::fabs(zy)) * std::fabs(w.x) +
                     (std::fabs(zx) + std::fabs(xz)) * std::fabs(w.y) +
                     (std::fabs(xy) + std::fabs(yx)) * std::fabs(w.z);
  const double bound = (7.0 + 56.0 * kEps) * kEps * sum;  // Shewchuk's o3derrboundA
  if (det > bound) return 1;
  if (det < -bound) return -1;
  if (sum < lattice.exact3 || sum == 0.0) return sign_of(det);
  return orient3_exact(a, b, c, d, lattice);
}

// Sign of (a - c) . (b - c): -1 if the angle at c is obtuse.
inline int dot3(Point3 a, Point3 b, Point3 c, const Lattice3& lattice) {
  const Vector3<double> u = a - c, v = b - c;
  const double x = u.x * v.x, y = u.y * v.y, z = u.z * v.z, s = x + y + z;
  const double sum = std::fabs(x) + std::fabs(y) + std::fabs(z), bound = 8.0 * kEps * sum;
  if (s > bound) return 1;
  if (s < -bound) return -1;
  if (sum < lattice.exact2) return sign_of(s);
  return dot3_exact(a, b, c, lattice);
}

// Whether e is inside the sphere through a, b, c, d (positively oriented), given that the
// plain sign of the determinant is zero: the lexicographically largest point is lifted
// most of all, then the second, and so on (Devillers & Teillaud 2011).
bool in_sphere_perturbed(Point3 a, Point3 b, Point3 c, Point3 d, Point3 e, const Lattice3& lattice);

// With neither filter nor record: for tests and rare cases.
inline bool in_sphere(Point3 a, Point3 b, Point3 c, Point3 d, Point3 e, const Lattice3& lattice) {
  const int s = in_sphere_exact(a, b, c, d, e, lattice);
  return s != 0 ? s > 0 : in_sphere_perturbed(a, b, c, d, e, lattice);
}

// To a relative error of about 2^-50: 6 x signed volume; (b - a) x (c - a).
double volume_accurate(Point3 a, Point3 b, Point3 c, Point3 d);
double volume_accurate(const Place3& a, const Place3& b, const Place3& c, const Place3& d);
Vector3<double> normal_accurate(Point3 a, Point3 b, Point3 c);
Vector3<double> normal_accurate(const Place3& a, const Place3& b, const Place3& c);
// Circumcentre of a positive tetrahedron relative to a, times `w` (6 x volume) times 2.
Vector3<double> circumcentre_accurate(Point3 a, Point3 b, Point3 c, Point3 d, double* w);

}  // namespace alphamesh
