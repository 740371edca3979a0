#include "predicates2.hpp"

#include "counting.hpp"
#include "exact.hpp"

namespace alphamesh {
namespace {

// Bounds of the double-double stage: the worst chain of roundings below amounts to
// 19 u^2 (two products and their sum) and 44 u^2 (in-circle); rounded up generously.
constexpr double kBound2Dd = 0x1p-100;
constexpr double kBound4Dd = 0x1p-99;

Dd abs_dd(Dd a) { return a.h < 0.0 ? -a : a; }

// p q - r s, the factors being exact differences.
int det2_sign(Dd p, Dd q, Dd r, Dd s, double resolution) {
  ALPHAMESH_NOTE(calls);
  const Dd l = p * q, m = r * s, det = l - m;
  const double bound = kBound2Dd * (std::fabs(l.h) + std::fabs(m.h));
  if (std::fabs(det.h) > bound) return det.h > 0.0 ? 1 : -1;
  if (std::fabs(det.h) + bound < resolution) return 0;
  ALPHAMESH_NOTE(expansions);
  return (expansion(p) * expansion(q) - expansion(r) * expansion(s)).sign();
}

}  // namespace

int orient_exact(Point2 a, Point2 b, Point2 c, Lattice lattice) {
  return det2_sign(two_diff(a.x, c.x), two_diff(b.y, c.y), two_diff(a.y, c.y), two_diff(b.x, c.x),
                   lattice.unit * lattice.unit);
}

int dot_exact(Point2 a, Point2 b, Point2 c, Lattice lattice) {
  return det2_sign(two_diff(a.x, c.x), two_diff(b.x, c.x), two_diff(c.y, a.y), two_diff(b.y, c.y),
                   lattice.unit * lattice.unit);
}

int in_circle_exact(Point2 a, Point2 b, Point2 c, Point2 d, Lattice lattice) {
  ALPHAMESH_NOTE(calls);
  const Dd adx = two_diff(a.x, d.x), ady = two_diff(a.y, d.y);
  const Dd bdx = two_diff(b.x, d.x), bdy = two_diff(b.y, d.y);
  const Dd cdx = two_diff(c.x, d.x), cdy = two_diff(c.y, d.y);
  {
    const Dd al = adx * adx + ady * ady, bl = bdx * bdx + bdy * bdy, cl = cdx * cdx + cdy * cdy;
    const Dd bc = bdx * cdy, cb = cdx * bdy, ca = cdx * ady, ac = adx * cdy;
    const Dd ab = adx * bdy, ba = bdx * ady;
    const Dd det = al * (bc - cb) + bl * (ca - ac) + cl * (ab - ba);
    const double sum = (abs_dd(bc).h + abs_dd(cb).h) * al.h + (abs_dd(ca).h + abs_dd(ac).h) * bl.h +
                       (abs_dd(ab).h + abs_dd(ba).h) * cl.h;
    const double bound = kBound4Dd * sum;
    if (std::fabs(det.h) > bound) return det.h > 0.0 ? 1 : -1;
    const double u2 = lattice.unit * lattice.unit;
    if (std::fabs(det.h) + bound < u2 * u2) return 0;
  }
  ALPHAMESH_NOTE(expansions);
  const auto ax = expansion(adx), ay = expansion(ady), bx = expansion(bdx), by = expansion(bdy);
  const auto cx = expansion(cdx), cy = expansion(cdy);
  const auto at = (bx * cy - cx * by) * (ax * ax + ay * ay);
  const auto bt = (cx * ay - ax * cy) * (bx * bx + by * by);
  const auto ct = (ax * by - bx * ay) * (cx * cx + cy * cy);
  return ((at + bt) + ct).sign();
}

int in_circle_perturbed(Point2 a, Point2 b, Point2 c, Point2 d, const Lattice& lattice) {
  Point2 top = d;
  if (top < a) top = a;
  if (top < b) top = b;
  if (top < c) top = c;
  if (top == d) return -1;
  // The circle of a, b, c tilts up at the lifted point: d falls inside if it lies on
  // that point's side of the line through the other two.
  if (top == a) return orient(d, b, c, lattice);
  if (top == b) return orient(a, d, c, lattice);
  return orient(a, b, d, lattice);
}

namespace {

double cross_of(Dd p, Dd q, Dd r, Dd s) {  // p q - r s
  const Dd l = p * q, m = r * s, det = l - m;
  if (std::fabs(det.h) > 0x1p-48 * (std::fabs(l.h) + std::fabs(m.h))) return det.h + det.l;
  return (expansion(p) * expansion(q) - expansion(r) * expansion(s)).estimate();
}

}  // namespace

double cross_accurate(Point2 a, Point2 b, Point2 c) {
  return cross_of(two_diff(b.x, a.x), two_diff(c.y, a.y), two_diff(b.y, a.y), two_diff(c.x, a.x));
}

double cross_accurate(const Place2& a, const Place2& b, const Place2& c) {
  return cross_of(wide_difference(b.x(), a.x()), wide_difference(c.y(), a.y()),
                  wide_difference(b.y(), a.y()), wide_difference(c.x(), a.x()));
}

}  // namespace alphamesh
