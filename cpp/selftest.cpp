#include "selftest.hpp"

#include <cmath>

#include "exact.hpp"
#include "predicates2.hpp"

namespace alphamesh {
namespace {

// Kept from being folded at compile time.
double opaque(double v) {
  volatile double copy = v;
  return copy;
}

bool products_are_rounded() {
  // (1 + e)(1 - e) = 1 - e^2 rounds to 1: a fused multiply-subtract would return -e^2.
  const double e = opaque(0x1p-30), a = 1.0 + e, b = 1.0 - e, c = opaque(1.0);
  return a * b - c == 0.0 && c - a * b == 0.0;
}

bool rounds_to_nearest_even() {
  const double one = opaque(1.0);
  return one + opaque(0x1p-53) == one && one + opaque(0x1.8p-53) == one + 0x1p-52 &&
         -one - opaque(0x1p-53) == -one;
}

bool keeps_subnormals() { return opaque(0x1p-1060) * opaque(0x1p-10) != 0.0; }

bool products_are_error_free() {
  const double a = opaque(1.0 + 0x1p-52), b = opaque(1.0 - 0x1p-53);
  const Dd p = two_prod(a, b), s = two_sum(opaque(1.0), opaque(0x1p-80));
  return p.h + p.l == p.h && p.l != 0.0 && s.h == 1.0 && s.l == 0x1p-80;
}

bool predicates_are_exact() {
  // Nearly collinear, nearly cocircular, and exactly so.
  const double u = opaque(0x1p-52);
  const Lattice none;
  const Point2 a{12.0, 12.0}, b{24.0, 24.0}, c{0.5, 0.5}, d{0.5, 0.5 + u};
  const Point2 o{0.0, 0.0}, e{1.0, 0.0}, f{1.0, 1.0}, g{0.0, 1.0}, h{0.0, 1.0 - u};
  return orient(c, a, b, none) == 0 && orient(a, b, d, none) == 1 && orient(b, a, d, none) == -1 &&
         in_circle_or_zero(o, e, f, g, none) == 0 && in_circle_or_zero(o, e, f, h, none) == 1 &&
         dot(e, g, o, none) == 0;
}

}  // namespace

std::string self_test() {
  if (!products_are_rounded()) return "products and sums are contracted (fused multiply-add)";
  if (!rounds_to_nearest_even()) return "arithmetic does not round to nearest even";
  if (!keeps_subnormals()) return "subnormal numbers are flushed to zero";
  if (!products_are_error_free()) return "error-free transformations fail";
  if (!predicates_are_exact()) return "exact predicates fail";
  return {};
}

}  // namespace alphamesh
