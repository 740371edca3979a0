#include "predicates3.hpp"

#include <algorithm>

#include "centre3.hpp"

namespace alphamesh {

int orient3_exact(Point3 a, Point3 b, Point3 c, Point3 d, const Lattice3& lattice) {
  const Vector3<Dd> u = difference(b, a), v = difference(c, a), w = difference(d, a);
  const double bound = 0x1p-97 * length(u) * length(v) * length(w);  // k = 8, c = 66: see Pair
  return decide(dot(cross(pair(u), pair(v)), pair(w)), bound,
                lattice.unit * lattice.unit * lattice.unit,
                [&] { return dot(cross(big(u), big(v)), big(w)); });
}

int dot3_exact(Point3 a, Point3 b, Point3 c, const Lattice3& lattice) {
  const Vector3<Dd> u = difference(a, c), v = difference(b, c);
  const double bound = 0x1p-98 * length(u) * length(v);  // k = 5, c = 26
  return decide(dot(pair(u), pair(v)), bound, lattice.unit * lattice.unit,
                [&] { return dot(big(u), big(v)); });
}

// Sums of magnitudes: |a||b||c| (s |e| + |e|^2) with s = |a| + |b| + |c|, times sqrt(3) as
// components are bounded by lengths. The circumcentre has k = 12 and c = 136, the volume 8
// and 66, the value 17 and 284: with sqrt(3), below 2^9 u^2.
int in_sphere_exact(Point3 p, Point3 a, Point3 b, Point3 c, Point3 e, const Lattice3& lattice) {
  const Vector3<Dd> u = difference(a, p), v = difference(b, p), w = difference(c, p);
  const Vector3<Dd> q = difference(e, p);
  const double lu = length(u), lv = length(v), lw = length(w), lq = length(q);
  const double bound = 0x1p-95 * (lu * lv * lw) * ((lu + lv + lw) * lq + lq * lq);
  const double unit = lattice.unit;
  return decide(Circumcentre<Pair>(pair(u), pair(v), pair(w)).in_sphere(pair(q)), bound,
                unit * unit * unit * unit * unit,
                [&] { return Circumcentre<Big>(big(u), big(v), big(w)).in_sphere(big(q)); });
}

// Magnitudes: see TetrahedronBlock. k = 22 and c = 450, times 11 sqrt(3): below 2^14 u^2.
int circumcentre_side_exact(const Point3* p, int k, const Lattice3& lattice) {
  const Vector3<Dd> u = difference(p[1], p[0]), v = difference(p[2], p[0]);
  const Vector3<Dd> w = difference(p[3], p[0]);
  const double lu = length(u), lv = length(v), lw = length(w);
  const double most = std::max(lu, std::max(lv, lw));
  const double bound = 0x1p-90 * (lu * lv * lw) * (most * most * most);
  const double cube = lattice.unit * lattice.unit * lattice.unit;
  return decide(Circumcentre<Pair>(pair(u), pair(v), pair(w)).side(k), bound, cube * cube,
                [&] { return Circumcentre<Big>(big(u), big(v), big(w)).side(k); });
}

bool in_sphere_perturbed(Point3 a, Point3 b, Point3 c, Point3 d, Point3 e,
                         const Lattice3& lattice) {
  const Point3 vertex[4] = {a, b, c, d};
  int order[4] = {0, 1, 2, 3};
  std::sort(order, order + 4, [&](int i, int j) { return vertex[j] < vertex[i]; });
  for (const int i : order) {
    if (vertex[i] < e) return false;  // e is lifted first: it falls out of the sphere
    Point3 p[4] = {a, b, c, d};
    p[i] = e;
    const int s = orient3(p[0], p[1], p[2], p[3], lattice);
    if (s != 0) return s > 0;
  }
  return false;
}

namespace {

Vector3<Dd> difference(const Place3& a, const Place3& b) {
  return {wide_difference(a.x(), b.x()), wide_difference(a.y(), b.y()),
          wide_difference(a.z(), b.z())};
}

double volume_of(const Vector3<Dd>& u, const Vector3<Dd>& v, const Vector3<Dd>& w) {
  const Dd det = dot(cross(u, v), w);
  if (std::fabs(det.h) > 0x1p-46 * length(u) * length(v) * length(w)) return det.h + det.l;
  return dot(cross(big(u), big(v)), big(w)).estimate();
}

double component(Dd plain, double scale, const Big& x, const Big& y, const Big& z, const Big& w) {
  if (std::fabs(plain.h) > 0x1p-46 * scale) return plain.h + plain.l;
  return (x * y - z * w).estimate();
}

Vector3<double> normal_of(const Vector3<Dd>& u, const Vector3<Dd>& v) {
  const Vector3<Dd> n = cross(u, v);
  const double scale = length(u) * length(v);
  const Vector3<Big> s = big(u), t = big(v);
  return {component(n.x, scale, s.y, t.z, s.z, t.y), component(n.y, scale, s.z, t.x, s.x, t.z),
          component(n.z, scale, s.x, t.y, s.y, t.x)};
}

}  // namespace

double volume_accurate(Point3 a, Point3 b, Point3 c, Point3 d) {
  return volume_of(difference(b, a), difference(c, a), difference(d, a));
}

double volume_accurate(const Place3& a, const Place3& b, const Place3& c, const Place3& d) {
  return volume_of(difference(b, a), difference(c, a), difference(d, a));
}

Vector3<double> normal_accurate(Point3 a, Point3 b, Point3 c) {
  return normal_of(difference(b, a), difference(c, a));
}

Vector3<double> normal_accurate(const Place3& a, const Place3& b, const Place3& c) {
  return normal_of(difference(b, a), difference(c, a));
}

Vector3<double> circumcentre_accurate(Point3 p, Point3 a, Point3 b, Point3 c, double* w) {
  const Vector3<Dd> u = difference(a, p), v = difference(b, p), t = difference(c, p);
  const Circumcentre<Pair> plain(pair(u), pair(v), pair(t));
  const double lu = length(u), lv = length(v), lt = length(t), product = lu * lv * lt;
  const Vector3<Pair>& n = plain.numerator;
  if (std::fabs(plain.volume.h) > 0x1p-46 * product &&
      length(n) > 0x1p-46 * product * (lu + lv + lt)) {
    *w = plain.volume.h + plain.volume.l;
    return {n.x.h + n.x.l, n.y.h + n.y.l, n.z.h + n.z.l};
  }
  const Circumcentre<Big> exact(big(u), big(v), big(t));
  *w = exact.volume.estimate();
  return {exact.numerator.x.estimate(), exact.numerator.y.estimate(), exact.numerator.z.estimate()};
}

}  // namespace alphamesh
