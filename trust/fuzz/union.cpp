#include "union.hpp"

#include <memory>

#include "incidence3.hpp"
#include "parts.hpp"
#include "rings2.hpp"
#include "union2.hpp"
#include "union3.hpp"

namespace trust {
namespace {

using alphamesh::Buffer;
using alphamesh::Job;

constexpr long double kPi = 3.14159265358979323846264338327950288L;

double power_of(double radius) { return radius * std::fabs(radius); }

long double square_of(const Cloud& cloud, std::size_t i, double radius) {
  const long double r = radius, weight = cloud.weights.empty() ? 0.0 : cloud.weights[i];
  return std::max(0.0L, r * std::fabs(r) + weight);
}

// The largest value at the radius or hardly above, as alphamesh.unions takes it: two values of
// which one is off by rounding may be in the wrong order.
double settled(const Cloud& cloud, std::vector<double> values, double radius) {
  long double heaviest = 0;
  for (double w : cloud.weights) heaviest = std::max<long double>(heaviest, w);
  std::sort(values.begin(), values.end());
  double last = radius;
  for (double v : values) {
    if (v <= last) continue;
    const long double scale = std::max<long double>(std::fabs(last), std::sqrt(heaviest));
    if (power_of(v) > power_of(last) + 2e-12L * scale * scale) break;
    last = v;
  }
  return last;
}

// An array of flags.
std::unique_ptr<bool[]> within(const double* values, std::size_t n, double radius) {
  auto out = std::make_unique<bool[]>(n);
  for (std::size_t i = 0; i < n; ++i) out[i] = values[i] <= radius;
  return out;
}

// The hole of each cell, -1 for none, and their number.
std::size_t enclosed(Buffer<Id>& part) {
  Id most = -1;
  for (Id& p : part) {
    p = std::max(-2 - p, -1);
    most = std::max(most, p);
  }
  return static_cast<std::size_t>(most + 1);
}

std::vector<double> list(const Buffer<double>& values) {
  return {values.data(), values.data() + values.size()};
}

std::vector<double> values_of(const Buffer<double>& a, const Buffer<double>& b) {
  std::vector<double> out = list(a);
  out.insert(out.end(), b.data(), b.data() + b.size());
  return out;
}

alphamesh::Centres centres_of(const Cloud& cloud, double radius) {
  const double* weights = cloud.weights.empty() ? nullptr : cloud.weights.data();
  return {cloud.coordinates.data(), nullptr, weights, nullptr, cloud.n, power_of(radius)};
}

Measured measured(const alphamesh::UnionMeasures& found) {
  return {found.content, list(found.contents), list(found.borders), list(found.hole_contents)};
}

Measured union_of_discs(const Filtered& x, double radius, Job& job) {
  const Cloud& cloud = x.cloud;
  const alphamesh::Filtration2& f = *x.plane;
  const std::size_t edges = f.edge_radii.size(), triangles = f.triangle_radii.size();
  const double* weights = cloud.weights.empty() ? nullptr : cloud.weights.data();
  const alphamesh::ComplexView2 complex{
      cloud.coordinates.data(), cloud.n, f.triangles.data(),      triangles,
      f.edges.data(),           edges,   f.edge_triangles.data(), weights};
  const Buffer<Id> triangle_edges = alphamesh::triangle_edges2(complex, job);
  const double last = settled(cloud, values_of(f.edge_radii, f.triangle_radii), radius);
  const auto vertex = within(x.births.data(), cloud.n, last);
  const auto edge = within(f.edge_radii.data(), edges, last);
  const auto triangle = within(f.triangle_radii.data(), triangles, last);
  auto hole =
      alphamesh::parts(triangles, f.edge_triangles.data(), edges, triangle.get(), edge.get(), job);
  const std::size_t holes = enclosed(hole);
  return measured(
      alphamesh::union2({centres_of(cloud, radius),
                         vertex.get(),
                         {f.edges.data(), nullptr, edge.get(), edges},
                         {f.triangles.data(), triangle_edges.data(), triangle.get(), triangles},
                         {},
                         f.edge_triangles.data(),
                         hole.data(),
                         holes},
                        job));
}

Measured union_of_balls(const Filtered& x, double radius, Job& job) {
  const Cloud& cloud = x.cloud;
  const alphamesh::Filtration3& f = *x.space;
  const std::size_t edges = f.edge_radii.size(), triangles = f.triangle_radii.size(),
                    tetrahedra = f.tetrahedron_radii.size();
  const alphamesh::ComplexView3 complex{
      cloud.n,   f.tetrahedra.data(),          tetrahedra,     f.triangles.data(),
      triangles, f.triangle_tetrahedra.data(), f.edges.data(), edges};
  const Buffer<Id> triangle_edges = alphamesh::triangle_edges3(complex, job);
  const Buffer<Id> tetrahedron_triangles = alphamesh::tetrahedron_triangles3(complex, job);
  std::vector<double> values = values_of(f.edge_radii, f.triangle_radii);
  const std::vector<double> more = list(f.tetrahedron_radii);
  values.insert(values.end(), more.begin(), more.end());
  const double last = settled(cloud, values, radius);
  const auto vertex = within(x.births.data(), cloud.n, last);
  const auto edge = within(f.edge_radii.data(), edges, last);
  const auto triangle = within(f.triangle_radii.data(), triangles, last);
  const auto tetrahedron = within(f.tetrahedron_radii.data(), tetrahedra, last);
  auto hollow = alphamesh::parts(tetrahedra, f.triangle_tetrahedra.data(), triangles,
                                 tetrahedron.get(), triangle.get(), job);
  const std::size_t voids = enclosed(hollow);
  return measured(alphamesh::union3(
      {centres_of(cloud, radius),
       vertex.get(),
       {f.edges.data(), nullptr, edge.get(), edges},
       {f.triangles.data(), triangle_edges.data(), triangle.get(), triangles},
       {f.tetrahedra.data(), tetrahedron_triangles.data(), tetrahedron.get(), tetrahedra},
       f.triangle_tetrahedra.data(),
       hollow.data(),
       voids},
      job));
}

struct Rounded {
  long double value, error;
};

// The area of a union of discs from the arcs that bound it (Green), each circle against all
// others: good to the root of the rounding, as arcs may end anywhere where circles touch.
Rounded area_by_arcs(const Cloud& cloud, double radius) {
  long double area = 0, error = 0;
  const std::size_t n = cloud.n;
  const auto place = [&](std::size_t i, std::size_t k) {
    return static_cast<long double>(cloud.row(i)[k]) - cloud.row(0)[k];
  };
  for (std::size_t i = 0; i < n; ++i) {
    const long double square = square_of(cloud, i, radius), r = std::sqrt(square);
    std::vector<std::pair<long double, long double>> covered;
    bool all = square == 0;
    for (std::size_t j = 0; j < n && !all; ++j) {
      const long double x = static_cast<long double>(cloud.row(j)[0]) - cloud.row(i)[0];
      const long double y = static_cast<long double>(cloud.row(j)[1]) - cloud.row(i)[1];
      const long double d = std::hypot(x, y), s = std::sqrt(square_of(cloud, j, radius));
      // What rounding does to the cosine of half an arc.
      const long double doubt = d > 0 ? 0x1p-58L * (square + s * s + d * d) / (2 * r * d) : 0;
      error += square * std::min(kPi, std::sqrt(2 * doubt));
      if (j == i || d >= r + s || d <= r - s) {
        all = j < i && d == 0 && r == s;  // the first of equal discs has their border
        continue;
      }
      if (d <= s - r) {
        all = true;
        continue;
      }
      const long double cosine = (square + d * d - s * s) / (2 * r * d);
      const long double half = std::acos(std::max(-1.0L, std::min(1.0L, cosine)));
      long double from = std::atan2(y, x) - half;
      while (from < -kPi) from += 2 * kPi;
      const long double to = from + 2 * half;
      covered.push_back({from, std::min(to, kPi)});
      if (to > kPi) covered.push_back({-kPi, to - 2 * kPi});
    }
    if (all) continue;
    covered.push_back({kPi, kPi});
    std::sort(covered.begin(), covered.end());
    long double at = -kPi;
    for (const auto& [from, to] : covered) {
      if (from > at) {
        area += 0.5L * (square * (from - at) + r * place(i, 0) * (std::sin(from) - std::sin(at)) -
                        r * place(i, 1) * (std::cos(from) - std::cos(at)));
      }
      at = std::max(at, to);
    }
  }
  return {area, error};
}

}  // namespace

Measured union_of(const Filtered& filtered, double radius, Job& job) {
  return filtered.plane != nullptr ? union_of_discs(filtered, radius, job)
                                   : union_of_balls(filtered, radius, job);
}

bool in_range(const Cloud& cloud, double radius) {
  const auto fits = [](double v) { return v == 0 || (v > 0x1p-100 && v < 0x1p100); };
  for (double v : cloud.coordinates) {
    if (!fits(std::fabs(v))) return false;
  }
  for (double w : cloud.weights) {
    if (!fits(std::sqrt(std::fabs(w)))) return false;
  }
  return fits(std::fabs(radius));
}

void prove_union(const Cloud& cloud, double radius, const Measured& measured) {
  long double sum = 0, largest = 0, squares = 0, extent = 0;
  for (std::size_t i = 0; i < cloud.n; ++i) {
    const long double square = square_of(cloud, i, radius);
    const long double ball =
        cloud.dimension == 2 ? kPi * square : 4 / 3.0L * kPi * square * std::sqrt(square);
    largest = std::max(largest, ball);
    sum += ball;
    squares += square;
    for (std::size_t k = 0; k < cloud.dimension; ++k) {
      extent = std::max(extent, std::fabs(static_cast<long double>(cloud.row(i)[k])));
    }
  }
  const long double total = measured.total, slack = 1e-10L * sum;
  require(total >= largest - slack, "a union holds the largest ball");
  require(total <= sum + slack, "a union is not more than all balls");
  long double parts = 0;
  for (double p : measured.parts) {
    require(p >= -slack && p <= largest + slack, "a part is within its ball");
    parts += p;
  }
  require(std::fabs(parts - total) <= slack, "parts add up to the whole");
  for (double v : measured.borders) require(v >= 0 && std::isfinite(v), "borders have a size");
  for (double v : measured.holes) require(!std::isnan(v), "holes have a size");
  if (cloud.dimension != 2) return;
  const Rounded area = area_by_arcs(cloud, radius);
  const long double far = 1e-15L * extent * std::sqrt(squares * cloud.n);
  require(std::fabs(area.value - total) <= area.error + far + slack, "the area that arcs bound");
}

void prove_same_union(const Measured& one, const Measured& reversed) {
  const double slack = 1e-10 * std::fabs(one.total);
  require(std::fabs(one.total - reversed.total) <= slack, "the same union in reverse");
  require(one.holes.size() == reversed.holes.size(), "as many holes in reverse");
}

}  // namespace trust
