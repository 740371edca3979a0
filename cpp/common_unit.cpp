#include "common_unit.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace alphamesh {
namespace {

// Exponent of the least significant bit that is set.
int unit_exponent(double v) {
  if (v == 0.0) return kNoUnit;
  int e;
  const double m = std::frexp(std::fabs(v), &e);  // v = m 2^e, m in [1/2, 1)
  auto digits = static_cast<std::uint64_t>(std::ldexp(m, kMantissa + 1));
  e -= kMantissa + 1;
  while ((digits & 1u) == 0) {
    digits >>= 1;
    ++e;
  }
  return e;
}

int common_unit(const double* v, std::size_t n, int enough) {
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer
  int unit = kNoUnit;
  double inverse = 0.0, limit = 0.0;
  for (std::size_t i = 0; i < n && unit > enough; ++i) {
    // Testing against the unit found so far is cheap, and true for nearly all.
    const double q = v[i] * inverse;
    const bool whole = (q + kRound) - kRound == q && (q != 0.0 || v[i] == 0.0);  // no underflow
    if (std::fabs(q) < limit && whole) continue;
    const int found = unit_exponent(v[i]);
    if (found >= unit) continue;
    unit = found;
    const bool usable = std::abs(unit) < 1000;
    inverse = usable ? std::ldexp(1.0, -unit) : 0.0;
    limit = usable ? 0x1p51 : 0.0;
  }
  return unit;
}

}  // namespace

int common_unit(const double* v, std::size_t n, int enough, Job& job) {
  const Parts parts(n, job);
  std::vector<int> found(parts.count());
  job.run(parts.count(), [&](std::size_t i) {
    found[i] = common_unit(v + parts.begin(i), parts.end(i) - parts.begin(i), enough);
  });
  return *std::min_element(found.begin(), found.end());
}

}  // namespace alphamesh
