#include "power2.hpp"

#include <algorithm>

#include "big.hpp"
#include "counting.hpp"

namespace alphamesh {
namespace {

Vector2<Big> big(const Vector2<Dd>& v) { return {Big(v.x), Big(v.y)}; }
Vector3<Big> big(const Vector3<Dd>& v) { return {Big(v.x), Big(v.y), Big(v.z)}; }

}  // namespace

template <class P>
int in_power_circle_exact(const Weighted<P>& a, const Weighted<P>& b, const Weighted<P>& c,
                          const Weighted<P>& d, const Lattice& lattice) {
  ALPHAMESH_NOTE(calls);
  const Weighted<P>* p[3] = {&a, &b, &c};
  decltype(exact_offset(a, d)) e[3];
  Dd square[3], weight[3];
  for (int i = 0; i < 3; ++i) {
    e[i] = exact_offset(*p[i], d);
    square[i] = dot(e[i], e[i]);
    weight[i] = two_diff(p[i]->w, d.w);
  }
  Dd det{0.0, 0.0};
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) {
    const auto &u = e[(i + 1) % 3], &v = e[(i + 2) % 3];
    const Dd l = u.x * v.y, r = v.x * u.y;
    det = det + (square[i] - weight[i]) * (l - r);
    sum += (square[i].h + std::fabs(weight[i].h)) * (std::fabs(l.h) + std::fabs(r.h));
  }
  const double bound = 0x1p-98 * sum;  // some 60 u^2, u = 2^-53
  if (std::fabs(det.h) > bound) return sign_of(det.h);
  const double u2 = lattice.unit * lattice.unit;
  if (std::fabs(det.h) + bound < u2 * u2) return 0;
  ALPHAMESH_NOTE(expansions);
  Big exact;
  for (int i = 0; i < 3; ++i) {
    const auto o = big(e[i]), u = big(e[(i + 1) % 3]), v = big(e[(i + 2) % 3]);
    exact = exact + (dot(o, o) - Big(weight[i])) * (u.x * v.y - v.x * u.y);
  }
  return exact.sign();
}

template <class P>
bool in_power_circle_perturbed(const Weighted<P>& a, const Weighted<P>& b, const Weighted<P>& c,
                               const Weighted<P>& d, const Lattice& lattice) {
  const Weighted<P> vertex[3] = {a, b, c};
  int order[3] = {0, 1, 2};
  std::sort(order, order + 3, [&](int i, int j) { return vertex[j] < vertex[i]; });
  for (const int i : order) {
    if (vertex[i] < d) return false;  // d is lifted first: it falls out
    Weighted<P> p[3] = {a, b, c};
    p[i] = d;
    const int s = orient(p[0], p[1], p[2], lattice);
    if (s != 0) return s > 0;
  }
  return false;
}

template <class P>
bool hidden_between(const Weighted<P>& a, const Weighted<P>& b, const Weighted<P>& c) {
  const bool upright = a.x == c.x;
  const Dd left = upright ? two_diff(b.y, a.y) : two_diff(b.x, a.x);
  const Dd right = upright ? two_diff(c.y, b.y) : two_diff(c.x, b.x);
  const auto u = exact_offset(a, b), v = exact_offset(c, b);
  const Dd u2 = dot(u, u), v2 = dot(v, v), uw = two_diff(a.w, b.w), vw = two_diff(c.w, b.w);
  // How far the segment of the lifted a and c runs above the lifted b; at a tie, c is lifted.
  const Dd height = right * (u2 - uw) + left * (v2 - vw);
  const double bound =
      0x1p-98 * (right.h * (u2.h + std::fabs(uw.h)) + left.h * (v2.h + std::fabs(vw.h)));
  if (std::fabs(height.h) > bound) return height.h < 0.0;
  const auto s = big(u), t = big(v);
  return (Big(right) * (dot(s, s) - Big(uw)) + Big(left) * (dot(t, t) - Big(vw))).sign() < 0;
}

template <class P>
int in_own_cell_exact(const Weighted<P>& a, const Weighted<P>& b) {
  const auto e = big(exact_offset(a, b));
  return (dot(e, e) + Big(two_diff(a.w, b.w))).sign();
}

#define ALPHAMESH_FOR(P)                                                                         \
  template int in_power_circle_exact<P>(const Weighted<P>&, const Weighted<P>&,                  \
                                        const Weighted<P>&, const Weighted<P>&, const Lattice&); \
  template bool in_power_circle_perturbed<P>(const Weighted<P>&, const Weighted<P>&,             \
                                             const Weighted<P>&, const Weighted<P>&,             \
                                             const Lattice&);                                    \
  template bool hidden_between<P>(const Weighted<P>&, const Weighted<P>&, const Weighted<P>&);   \
  template int in_own_cell_exact<P>(const Weighted<P>&, const Weighted<P>&);
ALPHAMESH_FOR(Point2)
ALPHAMESH_FOR(SheetPoint)
#undef ALPHAMESH_FOR

}  // namespace alphamesh
