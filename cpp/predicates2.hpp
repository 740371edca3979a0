// Exact predicates in the plane: which side, which circle, which angle.
//
// Each reads filter, then double-double, then exact. The filters are inlined; the
// rest lives in predicates2.cpp. Coordinates must lie in the range that Lattice
// describes, where no product overflows or underflows.
#pragma once

#include <cmath>

#include "exact.hpp"

namespace alphamesh {

struct Point2 {
  double x, y;
};

inline Point2 operator-(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }

// A point whose coordinates are sums of two doubles, the first rounded: a copy in a periodic box.
struct Place2 {
  Point2 high, low;

  Dd x() const { return {high.x, low.x}; }
  Dd y() const { return {high.y, low.y}; }
};

inline Point2 operator-(const Place2& a, const Place2& b) {
  const Point2 high = a.high - b.high, low = a.low - b.low;
  return {high.x + low.x, high.y + low.y};
}

inline bool operator==(Point2 a, Point2 b) { return a.x == b.x && a.y == b.y; }

// Lexicographic order, the order of the symbolic perturbation.
inline bool operator<(Point2 a, Point2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

// All coordinates are multiples of `unit` (0: nothing known). Differences and products
// of them are exact as long as they stay below 2^53 units, so that grids, pixels and
// integer coordinates never leave the first stage.
struct Lattice {
  double unit = 0.0;
  double exact2 = 0.0;  // sums of products of two below this are exact
  double exact4 = 0.0;  // sums of products of four

  Lattice() = default;
  explicit Lattice(double u)
      : unit(u), exact2(std::ldexp(u * u, 53)), exact4(std::ldexp(u * u * u * u, 53)) {}
};

// Multiplies by 2^e exactly, in two steps as 2^e itself may not be a double.
class PowerOfTwo {
 public:
  explicit PowerOfTwo(int e)
      : first_(std::ldexp(1.0, e / 2)), second_(std::ldexp(1.0, e - e / 2)) {}
  double operator*(double v) const { return v * first_ * second_; }

 private:
  double first_, second_;
};

constexpr double kEps = 1.1102230246251565e-16;  // 2^-53

// Shewchuk's ccwerrboundA: also covers the rounding of the four differences.
constexpr double kBound2 = (3.0 + 16.0 * kEps) * kEps;
constexpr double kBound4 = (10.0 + 96.0 * kEps) * kEps;  // iccerrboundA

int orient_exact(Point2 a, Point2 b, Point2 c, Lattice lattice);
int dot_exact(Point2 a, Point2 b, Point2 c, Lattice lattice);
int in_circle_exact(Point2 a, Point2 b, Point2 c, Point2 d, Lattice lattice);
// (b - a) x (c - a), relative error below 2^-50.
double cross_accurate(Point2 a, Point2 b, Point2 c);
double cross_accurate(const Place2& a, const Place2& b, const Place2& c);

inline int sign_of(double v) { return (v > 0.0) - (v < 0.0); }

// Sign of (a - c) x (b - c): +1 if a, b, c turn counter-clockwise.
inline int orient(Point2 a, Point2 b, Point2 c, const Lattice& lattice) {
  const double l = (a.x - c.x) * (b.y - c.y), r = (a.y - c.y) * (b.x - c.x);
  const double det = l - r, sum = std::fabs(l) + std::fabs(r);
  const double bound = kBound2 * sum;
  if (det > bound) return 1;
  if (det < -bound) return -1;
  if (sum < lattice.exact2) return sign_of(det);
  return orient_exact(a, b, c, lattice);
}

// Sign of (a - c) . (b - c): -1 if the angle at c is obtuse.
inline int dot(Point2 a, Point2 b, Point2 c, const Lattice& lattice) {
  const double l = (a.x - c.x) * (b.x - c.x), r = (a.y - c.y) * (b.y - c.y);
  const double det = l + r, sum = std::fabs(l) + std::fabs(r);
  const double bound = kBound2 * sum;
  if (det > bound) return 1;
  if (det < -bound) return -1;
  if (sum < lattice.exact2) return sign_of(det);
  return dot_exact(a, b, c, lattice);
}

// Which side of the circle through a, b, c (counter-clockwise) d is on when the four are
// cocircular: the lexicographically largest point is lifted off the paraboloid, hence
// out of the circle of the others (Devillers & Teillaud 2011, in the plane). Never 0 for
// distinct points, and the same for any order of the input.
int in_circle_perturbed(Point2 a, Point2 b, Point2 c, Point2 d, const Lattice& lattice);

// +1 if d is inside the circle through a, b, c (counter-clockwise), -1 if outside.
inline int in_circle_or_zero(Point2 a, Point2 b, Point2 c, Point2 d, const Lattice& lattice) {
  const double adx = a.x - d.x, ady = a.y - d.y, bdx = b.x - d.x, bdy = b.y - d.y;
  const double cdx = c.x - d.x, cdy = c.y - d.y;
  const double bc = bdx * cdy, cb = cdx * bdy, ca = cdx * ady, ac = adx * cdy;
  const double ab = adx * bdy, ba = bdx * ady;
  const double al = adx * adx + ady * ady, bl = bdx * bdx + bdy * bdy;
  const double cl = cdx * cdx + cdy * cdy;
  const double det = al * (bc - cb) + bl * (ca - ac) + cl * (ab - ba);
  const double sum = (std::fabs(bc) + std::fabs(cb)) * al + (std::fabs(ca) + std::fabs(ac)) * bl +
                     (std::fabs(ab) + std::fabs(ba)) * cl;
  const double bound = kBound4 * sum;
  if (det > bound) return 1;
  if (det < -bound) return -1;
  if (sum < lattice.exact4) return sign_of(det);
  return in_circle_exact(a, b, c, d, lattice);
}

inline bool in_circle(Point2 a, Point2 b, Point2 c, Point2 d, const Lattice& lattice) {
  const int s = in_circle_or_zero(a, b, c, d, lattice);
  return (s != 0 ? s : in_circle_perturbed(a, b, c, d, lattice)) > 0;
}

}  // namespace alphamesh
