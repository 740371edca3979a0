// Holds the predicates of the core against whole numbers on cases that are degenerate, or
// were before some coordinates were moved by an ulp or a few.
//
//   predicates CASES SEED     prints one line for each predicate, as JSON
#include <array>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "counting.hpp"
#include "predicates2.hpp"
#include "predicates3.hpp"
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

struct Case {
  std::array<double, 15> at{};  // coordinates, point after point
  int points = 0, dimension = 0;

  double& of(int point, int axis) { return at[static_cast<std::size_t>(point * dimension + axis)]; }
  double of(int point, int axis) const {
    return at[static_cast<std::size_t>(point * dimension + axis)];
  }
};

// Moves some coordinates by up to three ulps, then everything by a power of two.
void disturb(Case& c) {
  const int size = c.points * c.dimension;
  if (whole(0, 3) != 0) {
    for (int k = static_cast<int>(whole(1, 3)); k > 0; --k) {
      double& v = c.at[static_cast<std::size_t>(whole(0, size - 1))];
      for (std::int64_t steps = whole(1, 3); steps > 0; --steps) {
        v = std::nextafter(v, whole(0, 1) != 0 ? HUGE_VAL : -HUGE_VAL);
      }
      if (std::fabs(v) < 0x1p-60) v = 0.0;  // an ulp from zero is another matter
    }
  }
  const int exponent = static_cast<int>(whole(-20, 20));
  for (int i = 0; i < size; ++i) {
    double& v = c.at[static_cast<std::size_t>(i)];
    v = std::ldexp(v, exponent);
  }
}

// The largest power of two that divides all coordinates; nothing known as often as not.
double unit_of(const Case& c) {
  if (whole(0, 1) == 0) return 0.0;
  int least = 2000;
  for (int i = 0; i < c.points * c.dimension; ++i) {
    double v = std::fabs(c.at[static_cast<std::size_t>(i)]);
    if (v == 0.0) continue;
    int e;
    auto mantissa = static_cast<std::uint64_t>(std::ldexp(std::frexp(v, &e), 53));
    e -= 53;
    while ((mantissa & 1) == 0) mantissa >>= 1, ++e;
    least = e < least ? e : least;
  }
  return least == 2000 ? 0.0 : std::ldexp(1.0, least);
}

// ------------------------------------------------------------------ degenerate cases

Case flat(int points, int dimension) {  // on a line or a plane, far from or near to zero
  Case c;
  c.points = points;
  c.dimension = dimension;
  const int bits = static_cast<int>(whole(4, 24)), steps = static_cast<int>(whole(2, 24));
  double start[3], across[2][3];
  for (int a = 0; a < dimension; ++a) {
    start[a] = whole(0, 2) == 0 ? 0.0 : signed_bits(static_cast<int>(whole(3, 48)));
    for (auto& direction : across) direction[a] = signed_bits(bits);
  }
  for (int p = 0; p < points; ++p) {
    const double s = signed_bits(steps), t = dimension == 3 ? signed_bits(steps) : 0.0;
    for (int a = 0; a < dimension; ++a) c.of(p, a) = start[a] + s * across[0][a] + t * across[1][a];
  }
  return c;
}

// Whole vectors of one length, in the plane and in space.
std::vector<std::array<double, 3>> vectors_of(int dimension) {
  std::vector<std::array<double, 3>> found;
  const int n = dimension == 2 ? 1105 * 29 : 3 * 5 * 7 * 11;  // 64 and some hundred
  const int most = static_cast<int>(std::sqrt(static_cast<double>(n)));
  for (int x = -most; x <= most; ++x) {
    for (int y = -most; y <= most; ++y) {
      for (int z = dimension == 2 ? 0 : -most; z <= (dimension == 2 ? 0 : most); ++z) {
        if (x * x + y * y + z * z == n) {
          found.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
        }
      }
    }
  }
  return found;
}

Case round(int points, int dimension) {  // on a circle or a sphere
  static const std::vector<std::array<double, 3>> vectors[2] = {vectors_of(2), vectors_of(3)};
  const auto& known = vectors[dimension - 2];
  Case c;
  c.points = points;
  c.dimension = dimension;
  const double scale = std::fabs(signed_bits(static_cast<int>(whole(1, 30)))) + 1.0;
  double centre[3];
  for (double& x : centre) x = whole(0, 2) == 0 ? 0.0 : signed_bits(static_cast<int>(whole(3, 44)));
  for (int p = 0; p < points; ++p) {
    const auto& v = known[static_cast<std::size_t>(whole(0, static_cast<int>(known.size()) - 1))];
    for (int a = 0; a < dimension; ++a) {
      c.of(p, a) = centre[a] + scale * v[static_cast<std::size_t>(a)];
    }
  }
  return c;
}

Case right(int dimension) {  // a, b, c with a right angle at c
  Case c;
  c.points = 3;
  c.dimension = dimension;
  double u[3], v[3], corner[3];
  for (int a = 0; a < 3; ++a) {
    u[a] = signed_bits(static_cast<int>(whole(2, 20)));
    corner[a] = signed_bits(static_cast<int>(whole(3, 48)));
  }
  if (dimension == 2) u[2] = 0.0;
  const double w[3] = {dimension == 2 ? 0.0 : signed_bits(9), dimension == 2 ? 0.0 : signed_bits(9),
                       1.0};
  v[0] = u[1] * w[2] - u[2] * w[1];  // across u
  v[1] = u[2] * w[0] - u[0] * w[2];
  v[2] = u[0] * w[1] - u[1] * w[0];
  for (int a = 0; a < dimension; ++a) {
    c.of(0, a) = corner[a] + u[a];
    c.of(1, a) = corner[a] + v[a];
    c.of(2, a) = corner[a];
  }
  return c;
}

Case great_circle() {  // the first three on a great circle of a sphere through all four
  Case c;
  c.points = 4;
  c.dimension = 3;
  static const std::vector<std::array<double, 3>> known = vectors_of(3);
  const double scale = std::fabs(signed_bits(static_cast<int>(whole(1, 30)))) + 1.0;
  double centre[3];
  for (double& x : centre) x = whole(0, 2) == 0 ? 0.0 : signed_bits(static_cast<int>(whole(3, 44)));
  auto pick = [&] {
    return known[static_cast<std::size_t>(whole(0, static_cast<int>(known.size()) - 1))];
  };
  const auto u = pick(), w = pick(), apex = pick();
  const std::array<double, 3> minus{-u[0], -u[1], -u[2]};  // u, -u and anything: a great circle
  const std::array<double, 3> on[4] = {u, minus, w, apex};
  for (int p = 0; p < 4; ++p) {
    for (int a = 0; a < 3; ++a) c.of(p, a) = centre[a] + scale * on[p][static_cast<std::size_t>(a)];
  }
  return c;
}

Case scattered(int points, int dimension) {  // every coordinate of its own scale
  Case c;
  c.points = points;
  c.dimension = dimension;
  for (int p = 0; p < points; ++p) {
    for (int a = 0; a < dimension; ++a) {
      c.of(p, a) = std::ldexp(signed_bits(52), -static_cast<int>(whole(0, 100)));
    }
  }
  return c;
}

// ------------------------------------------------------------------ whole numbers

constexpr int kShift = 260;  // all coordinates are multiples of 2^-kShift

using Vector = std::array<Wide, 3>;

Vector step(const Case& c, int to, int from) {
  Vector v;
  for (int a = 0; a < c.dimension; ++a) {
    v[static_cast<std::size_t>(a)] =
        Wide::of(c.of(to, a), kShift) - Wide::of(c.of(from, a), kShift);
  }
  return v;
}
Wide dot_of(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Wide det(const Vector& a, const Vector& b, const Vector& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}
Wide det(const Vector& a, const Vector& b) { return a[0] * b[1] - a[1] * b[0]; }

// The determinant of the lifted points by its last column, positive inside of the sphere
// of a tetrahedron that is positively oriented.
Wide in_sphere_of(const Case& c, int e) {
  Vector v[4];
  for (int p = 0; p < 4; ++p) v[p] = step(c, p, e);
  return dot_of(v[0], v[0]) * det(v[1], v[2], v[3]) - dot_of(v[1], v[1]) * det(v[0], v[2], v[3]) +
         dot_of(v[2], v[2]) * det(v[0], v[1], v[3]) - dot_of(v[3], v[3]) * det(v[0], v[1], v[2]);
}

// Times 2 volume^2: the barycentric coordinate of the circumcentre at vertex k.
Wide side_of(const Case& c, int k) {
  const int i = (k + 1) % 4, j = (k + 2) % 4, m = (k + 3) % 4;
  // Seen from i: the plane through i, j, m separates vertex k from the circumcentre or not.
  const Vector u = step(c, j, i), v = step(c, m, i), w = step(c, k, i);
  const Wide u2 = dot_of(u, u), v2 = dot_of(v, v), w2 = dot_of(w, w);
  auto cross = [](const Vector& a, const Vector& b) {
    return Vector{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const Vector uv = cross(u, v), vw = cross(v, w), wu = cross(w, u);
  Vector centre;  // times 2 det(u, v, w)
  for (std::size_t a = 0; a < 3; ++a) centre[a] = u2 * vw[a] + v2 * wu[a] + w2 * uv[a];
  // centre = det * (alpha u + beta v + gamma w) 2: gamma from the component along uv.
  return dot_of(centre, uv);
}

// ------------------------------------------------------------------ the campaign

struct Tally {
  std::uint64_t cases = 0, wrong = 0, zero = 0, beyond_filter = 0, beyond_double = 0;
};

template <class Make, class Ours, class Theirs>
void campaign(const char* name, std::uint64_t cases, Make&& make, Ours&& ours, Theirs&& theirs) {
  Tally tally;
  for (; tally.cases < cases; ++tally.cases) {
    Case c = make(static_cast<int>(whole(0, 9)));
    if (c.points == 0) continue;
    disturb(c);
    const double unit = unit_of(c);
    counting::calls = counting::expansions = 0;
    const int mine = ours(c, unit);
    tally.beyond_filter += counting::calls != 0;
    tally.beyond_double += counting::expansions != 0;
    const int exact = theirs(c);
    tally.zero += exact == 0;
    if (mine != exact) {
      if (tally.wrong++ < 5) {
        std::fprintf(stderr, "%s: %d, not %d, unit %a:", name, mine, exact, unit);
        for (int i = 0; i < c.points * c.dimension; ++i) {
          std::fprintf(stderr, " %a", c.at[static_cast<std::size_t>(i)]);
        }
        std::fprintf(stderr, "\n");
      }
    }
  }
  std::printf("{\"predicate\": \"%s\", \"cases\": %" PRIu64 ", \"wrong\": %" PRIu64
              ", \"zero\": %" PRIu64 ", \"beyond_filter\": %" PRIu64
              ", \"beyond_double_double\": %" PRIu64 "}\n",
              name, tally.cases, tally.wrong, tally.zero, tally.beyond_filter, tally.beyond_double);
  std::fflush(stdout);
}

Point2 point2(const Case& c, int p) { return {c.of(p, 0), c.of(p, 1)}; }
Point3 point3(const Case& c, int p) { return {c.of(p, 0), c.of(p, 1), c.of(p, 2)}; }

void plane(std::uint64_t n) {
  campaign(
      "orient", n, [](int k) { return k == 0 ? scattered(3, 2) : flat(3, 2); },
      [](const Case& c, double unit) {
        return orient(point2(c, 0), point2(c, 1), point2(c, 2), Lattice(unit));
      },
      [](const Case& c) { return det(step(c, 1, 0), step(c, 2, 0)).sign(); });
  campaign(
      "dot", n, [](int k) { return k == 0 ? scattered(3, 2) : right(2); },
      [](const Case& c, double unit) {
        return dot(point2(c, 0), point2(c, 1), point2(c, 2), Lattice(unit));
      },
      [](const Case& c) { return dot_of(step(c, 0, 2), step(c, 1, 2)).sign(); });
  campaign(
      "in_circle", n,
      [](int k) { return k == 0 ? scattered(4, 2) : (k == 1 ? flat(4, 2) : round(4, 2)); },
      [](const Case& c, double unit) {
        return in_circle_or_zero(point2(c, 0), point2(c, 1), point2(c, 2), point2(c, 3),
                                 Lattice(unit));
      },
      [](const Case& c) {
        const Vector u = step(c, 0, 3), v = step(c, 1, 3), w = step(c, 2, 3);
        return (dot_of(u, u) * det(v, w) - dot_of(v, v) * det(u, w) + dot_of(w, w) * det(u, v))
            .sign();
      });
}

void space(std::uint64_t n) {
  campaign(
      "orient3", n, [](int k) { return k == 0 ? scattered(4, 3) : flat(4, 3); },
      [](const Case& c, double unit) {
        return orient3(point3(c, 0), point3(c, 1), point3(c, 2), point3(c, 3), Lattice3(unit));
      },
      [](const Case& c) { return det(step(c, 1, 0), step(c, 2, 0), step(c, 3, 0)).sign(); });
  campaign(
      "dot3", n, [](int k) { return k == 0 ? scattered(3, 3) : right(3); },
      [](const Case& c, double unit) {
        return dot3(point3(c, 0), point3(c, 1), point3(c, 2), Lattice3(unit));
      },
      [](const Case& c) { return dot_of(step(c, 0, 2), step(c, 1, 2)).sign(); });
  // The sign of the determinant whatever the orientation, as the core defines it.
  campaign(
      "in_sphere", n,
      [](int k) { return k == 0 ? scattered(5, 3) : (k == 1 ? flat(5, 3) : round(5, 3)); },
      [](const Case& c, double unit) {
        return in_sphere_exact(point3(c, 0), point3(c, 1), point3(c, 2), point3(c, 3), point3(c, 4),
                               Lattice3(unit));
      },
      [](const Case& c) { return in_sphere_of(c, 4).sign(); });
  campaign(
      "circumcentre_side", n,
      [](int k) { return k == 0 ? scattered(4, 3) : (k == 1 ? round(4, 3) : great_circle()); },
      [](const Case& c, double unit) {
        const Point3 p[4] = {point3(c, 0), point3(c, 1), point3(c, 2), point3(c, 3)};
        return circumcentre_side_exact(p, 3, Lattice3(unit));
      },
      [](const Case& c) { return side_of(c, 3).sign(); });
}

}  // namespace

int main(int count, char** words) {
  const auto cases = std::strtoull(count > 1 ? words[1] : "100000", nullptr, 10);
  random_bits.seed(std::strtoull(count > 2 ? words[2] : "1", nullptr, 10));
  plane(cases);
  space(cases);
}
