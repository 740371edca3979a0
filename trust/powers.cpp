// Holds the predicates of weighted points in space against whole numbers, on cases that are
// tied, or were before some numbers were moved by an ulp or a few.
//
//   powers CASES SEED     prints one line for each predicate, as JSON
#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "cloud3.hpp"
#include "counting.hpp"
#include "power3.hpp"
#include "wide.hpp"

using namespace alphamesh;
using trust::Wide;

namespace {

std::mt19937_64 random_bits;

std::int64_t whole(std::int64_t low, std::int64_t high) {
  return std::uniform_int_distribution<std::int64_t>(low, high)(random_bits);
}
double signed_bits(int bits) {
  const std::int64_t most = (std::int64_t{1} << bits) - 1;
  return static_cast<double>(whole(-most, most));
}

constexpr int kPoints = 5;

struct Case {
  Weighted3 at[kPoints];
  double unit = 0.0;
};

void nudge(double& v) {
  for (std::int64_t steps = whole(1, 3); steps > 0; --steps) {
    v = std::nextafter(v, whole(0, 1) != 0 ? HUGE_VAL : -HUGE_VAL);
  }
  if (std::fabs(v) < 0x1p-60) v = 0.0;  // an ulp from zero is another matter
}

// Five points of the same power at a place z, which lies in the affine hull of the first
// `hull`; nearly so where that has too many digits, or where numbers were moved.
Case tied(int hull) {
  Case c;
  const int bits = static_cast<int>(whole(2, 40)), steps = static_cast<int>(whole(1, 6));
  const bool flat = whole(0, 7) == 0;
  for (Weighted3& p : c.at) {
    p = {{signed_bits(bits), signed_bits(bits), flat ? 0.0 : signed_bits(bits)}, 0.0};
  }
  Point3 z = c.at[0];
  for (int k = 1; k < hull; ++k) {
    const double share = signed_bits(steps);
    z = {z.x + share * (c.at[k].x - c.at[0].x), z.y + share * (c.at[k].y - c.at[0].y),
         z.z + share * (c.at[k].z - c.at[0].z)};
  }
  const double power = whole(0, 1) == 0 ? 0.0 : signed_bits(bits);
  for (Weighted3& p : c.at) p.weight = dot(p - z, p - z) - power;
  if (whole(0, 3) != 0) {
    for (int k = static_cast<int>(whole(1, 3)); k > 0; --k) {
      Weighted3& p = c.at[whole(0, kPoints - 1)];
      double* const number[4] = {&p.x, &p.y, &p.z, &p.weight};
      nudge(*number[whole(0, 3)]);
    }
  }
  return c;
}

Case scattered() {  // every number of its own scale
  Case c;
  for (Weighted3& p : c.at) {
    for (double* v : {&p.x, &p.y, &p.z, &p.weight}) {
      *v = std::ldexp(signed_bits(52), -static_cast<int>(whole(0, 100)));
    }
  }
  return c;
}

int last_bit(double v) {
  if (v == 0.0) return 2000;
  int e;
  auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::fabs(v), &e), 53));
  e -= 53;
  while ((mantissa & 1) == 0) mantissa >>= 1, ++e;
  return e;
}

// Multiplies all by a power of two; as often as not the lattice of the cloud is known.
void finish(Case& c) {
  const int exponent = static_cast<int>(whole(-20, 20));
  int least = 2000;
  for (Weighted3& p : c.at) {
    p = {{std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)},
         std::ldexp(p.weight, 2 * exponent)};
    for (const double v : {p.x, p.y, p.z}) least = std::min(least, last_bit(v));
    const int bit = last_bit(p.weight);
    least = std::min(least, bit >> 1);
  }
  c.unit = whole(0, 1) == 0 || least > 900 ? 0.0 : std::ldexp(1.0, least);
}

// ------------------------------------------------------------------ whole numbers

constexpr int kShift = 260;  // all coordinates are multiples of 2^-kShift, weights of its square

using Vector = std::array<Wide, 3>;

Vector step(const Weighted3& to, const Weighted3& from) {
  return {Wide::of(to.x, kShift) - Wide::of(from.x, kShift),
          Wide::of(to.y, kShift) - Wide::of(from.y, kShift),
          Wide::of(to.z, kShift) - Wide::of(from.z, kShift)};
}
Wide dot_of(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross_of(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Wide det(const Vector& a, const Vector& b, const Vector& c) { return dot_of(a, cross_of(b, c)); }
Wide lift(const Weighted3& to, const Weighted3& from) {
  const Vector d = step(to, from);
  return dot_of(d, d) - Wide::of(to.weight, 2 * kShift) + Wide::of(from.weight, 2 * kShift);
}

Wide in_sphere_of(const Weighted3* p) {
  Vector v[4];
  Wide h[4];
  for (int k = 0; k < 4; ++k) {
    v[k] = step(p[k], p[4]);
    h[k] = lift(p[k], p[4]);
  }
  return h[0] * det(v[1], v[2], v[3]) - h[1] * det(v[0], v[2], v[3]) +
         h[2] * det(v[0], v[1], v[3]) - h[3] * det(v[0], v[1], v[2]);
}

// Where the orthocentre, seen from the facet i, j, m, lies in the direction of its normal.
Wide facet_side_of(const Weighted3* p, int k) {
  const int i = (k + 1) % 4, j = (k + 2) % 4, m = (k + 3) % 4;
  const Vector u = step(p[j], p[i]), v = step(p[m], p[i]), w = step(p[k], p[i]);
  const Wide hu = lift(p[j], p[i]), hv = lift(p[m], p[i]), hw = lift(p[k], p[i]);
  const Vector uv = cross_of(u, v), vw = cross_of(v, w), wu = cross_of(w, u);
  Vector centre;
  for (std::size_t a = 0; a < 3; ++a) centre[a] = hu * vw[a] + hv * wu[a] + hw * uv[a];
  return dot_of(centre, uv);
}

// The triangle's orthocentre is alpha u + beta v: beta by Cramer's rule.
Wide edge_side_of(const Weighted3* p) {
  const Vector u = step(p[1], p[0]), v = step(p[2], p[0]);
  return lift(p[2], p[0]) * dot_of(u, u) - lift(p[1], p[0]) * dot_of(u, v);
}

// ------------------------------------------------------------------ the campaign

struct Tally {
  std::uint64_t cases = 0, wrong = 0, zero = 0, beyond_filter = 0, beyond_double = 0;
};

template <class Ours, class Theirs>
void campaign(const char* name, std::uint64_t cases, int hull, Ours&& ours, Theirs&& theirs) {
  Tally tally;
  for (; tally.cases < cases; ++tally.cases) {
    Case c = whole(0, 9) == 0 ? scattered() : tied(hull);
    finish(c);
    counting::calls = counting::expansions = 0;
    const int exact = theirs(c.at).sign(), mine = ours(c, exact);
    tally.beyond_filter += counting::calls != 0;
    tally.beyond_double += counting::expansions != 0;
    tally.zero += exact == 0;
    if (mine == exact) continue;
    if (tally.wrong++ < 5) {
      std::fprintf(stderr, "%s: %d, not %d, unit %a:", name, mine, exact, c.unit);
      for (const Weighted3& p : c.at) {
        std::fprintf(stderr, "  %a %a %a %a", p.x, p.y, p.z, p.weight);
      }
      std::fprintf(stderr, "\n");
    }
  }
  std::printf("{\"predicate\": \"%s\", \"cases\": %" PRIu64 ", \"wrong\": %" PRIu64
              ", \"zero\": %" PRIu64 ", \"beyond_filter\": %" PRIu64
              ", \"beyond_double_double\": %" PRIu64 "}\n",
              name, tally.cases, tally.wrong, tally.zero, tally.beyond_filter, tally.beyond_double);
  std::fflush(stdout);
}

// As a worker decides: by the record of the first four points, then exactly. What remains is
// tied, and none of this campaign's business.
int by_record(const Case& c, int exact) {
  SpatialOrder3 order;
  order.size = kPoints;
  order.lattice = c.unit > 0.0 ? Lattice3(c.unit) : Lattice3();
  order.points = Buffer<Point3>(kPoints);
  order.weight = Buffer<double>(kPoints);
  for (std::size_t k = 0; k < kPoints; ++k) {
    order.points[k] = c.at[k];
    order.weight[k] = c.at[k].weight;
  }
  const WeightedCloud3 cloud(order);
  const Weighted3 origin = cloud.point(0);
  for (std::int32_t k = 1; k < 4; ++k) {  // no tetrahedron has a vertex twice
    if (cloud.place(k) == cloud.place(0)) return exact;
  }
  const PowerSphere record =
      sphere_of(origin, cloud.arm(1, origin), cloud.arm(2, origin), cloud.arm(3, origin));
  const Verdict verdict = test(record, cloud.point(4));
  if (verdict.value > verdict.bound) return 1;
  if (verdict.value < -verdict.bound) return -1;
  if (exact == 0) return 0;
  const std::int32_t v[4] = {0, 1, 2, 3};
  return cloud.in_sphere(v, 4, verdict) ? 1 : -1;
}

void weights(std::uint64_t n) {
  campaign("power_record", n, 4, by_record, in_sphere_of);
  campaign(
      "in_power_sphere", n, 4,
      [](const Case& c, int) {
        const Weighted3* p = c.at;
        return in_power_sphere_exact(p[0], p[1], p[2], p[3], p[4], Lattice3(c.unit));
      },
      in_sphere_of);
  campaign(
      "orthocentre_side", n, 3,
      [](const Case& c, int) { return orthocentre_side_exact(c.at, 3, Lattice3(c.unit)); },
      [](const Weighted3* p) { return facet_side_of(p, 3); });
  campaign(
      "orthocentre_side of triangles", n, 2,
      [](const Case& c, int) {
        return orthocentre_side_exact(c.at[0], c.at[1], c.at[2], Lattice3(c.unit));
      },
      edge_side_of);
  campaign(
      "orthocentre_side of edges", n, 1,
      [](const Case& c, int) { return orthocentre_side(c.at[0], c.at[1], Lattice3(c.unit)); },
      [](const Weighted3* p) { return lift(p[1], p[0]); });
}

}  // namespace

int main(int count, char** words) {
  const auto cases = std::strtoull(count > 1 ? words[1] : "100000", nullptr, 10);
  random_bits.seed(std::strtoull(count > 2 ? words[2] : "1", nullptr, 10));
  weights(cases);
}
