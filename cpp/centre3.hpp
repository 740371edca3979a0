// What the exact predicates in space compute with: differences of coordinates, in double-double
// or as expansions, and the centre of the sphere through four points.
#pragma once

#include <cmath>

#include "big.hpp"
#include "counting.hpp"
#include "exact.hpp"
#include "predicates3.hpp"

namespace alphamesh {

inline Vector3<Dd> difference(Point3 a, Point3 b) {
  return {two_diff(a.x, b.x), two_diff(a.y, b.y), two_diff(a.z, b.z)};
}

inline Vector3<Pair> pair(const Vector3<Dd>& v) { return {Pair(v.x), Pair(v.y), Pair(v.z)}; }

inline Vector3<Big> big(const Vector3<Dd>& v) { return {Big(v.x), Big(v.y), Big(v.z)}; }

template <class R>
double length(const Vector3<R>& v) {
  return std::sqrt(v.x.h * v.x.h + v.y.h * v.y.h + v.z.h * v.z.h);
}

// The circumcentre of the origin, a, b, c is `numerator` / (2 volume). With weights, the squares
// a2, b2, c2 of the lengths are less by how much heavier the point is than the origin, and the
// centre is that of the sphere orthogonal to the four balls.
template <class R>
struct Circumcentre {
  Vector3<R> bc, ca, ab, numerator;
  R volume;

  Circumcentre(const Vector3<R>& a, const Vector3<R>& b, const Vector3<R>& c)
      : Circumcentre(a, b, c, dot(a, a), dot(b, b), dot(c, c)) {}
  Circumcentre(const Vector3<R>& a, const Vector3<R>& b, const Vector3<R>& c, const R& a2,
               const R& b2, const R& c2)
      : bc(cross(b, c)), ca(cross(c, a)), ab(cross(a, b)), volume(dot(a, bc)) {
    numerator = {a2 * bc.x + b2 * ca.x + c2 * ab.x, a2 * bc.y + b2 * ca.y + c2 * ab.y,
                 a2 * bc.z + b2 * ca.z + c2 * ab.z};
  }
  // Inside: |e|^2 < 2 e . centre.
  R in_sphere(const Vector3<R>& e) const { return in_sphere(e, dot(e, e)); }
  R in_sphere(const Vector3<R>& e, const R& e2) const { return dot(numerator, e) - volume * e2; }
  // Barycentric coordinate times 2 volume^2.
  R side(int k) const {
    if (k == 1) return dot(numerator, bc);
    if (k == 2) return dot(numerator, ca);
    if (k == 3) return dot(numerator, ab);
    const R w2 = volume * volume;
    return (w2 + w2) - (dot(numerator, bc) + dot(numerator, ca) + dot(numerator, ab));
  }
};

// Sign of a pair if its magnitude exceeds the bound, zero if it is below what the lattice
// resolves, otherwise by `exact`.
template <class Exact>
int decide(Pair pair, double bound, double resolution, Exact&& exact) {
  ALPHAMESH_NOTE(calls);
  const double value = pair.h + pair.l;
  if (std::fabs(value) > bound) return value > 0.0 ? 1 : -1;
  if (std::fabs(value) + bound < resolution) return 0;
  ALPHAMESH_NOTE(expansions);
  return exact().sign();
}

}  // namespace alphamesh
