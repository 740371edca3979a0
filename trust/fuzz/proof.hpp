// What holds of every alpha filtration, in the plane and in space: proved, or abort.
#pragma once

#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "exact.hpp"
#include "homology.hpp"

namespace trust {

template <std::size_t K>
using Row = std::array<Id, K>;

template <std::size_t K>
std::vector<Row<K>> rows_of(const Id* rows, std::size_t count) {
  std::vector<Row<K>> out(count);
  for (std::size_t i = 0; i < K * count; ++i) out[i / K][i % K] = rows[i];
  return out;
}

// The rows that stand for themselves, checked: the lowest of equal coordinates.
inline std::vector<Id> proved_vertices(const Geometry& g, std::size_t n, const Id* representative,
                                       std::size_t size) {
  require(size == 0 || size == n, "one representative for each point");
  std::map<Vector<double>, Id> first;
  std::vector<Id> vertices;
  for (Id i = 0; i < static_cast<Id>(n); ++i) {
    Vector<double> p = g.plain(i);
    for (double& v : p) v += 0.0;  // no negative zeros
    const auto [at, is_new] = first.emplace(p, i);
    require((size == 0 ? i : representative[i]) == at->second, "the lowest equal row represents");
    if (is_new) vertices.push_back(i);
  }
  return vertices;
}

template <std::size_t K>
std::map<Row<K>, Id> numbered(const std::vector<Row<K>>& rows, const std::vector<Id>& vertices) {
  std::map<Row<K>, Id> number;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < K; ++k) {
      require(k == 0 || rows[i][k - 1] < rows[i][k], "rows of vertices ascend");
      require(std::binary_search(vertices.begin(), vertices.end(), rows[i][k]),
              "vertices stand for themselves");
    }
    require(number.emplace(rows[i], static_cast<Id>(i)).second, "each simplex comes once");
  }
  return number;
}

template <std::size_t K>
Row<K - 1> without(const Row<K>& row, std::size_t left) {
  Row<K - 1> out;
  for (std::size_t k = 0, m = 0; k < K; ++k) {
    if (k != left) out[m++] = row[k];
  }
  return out;
}

// For each face its cofaces: number and the place of the vertex that it lacks. Every face is
// one of `faces`, and has one coface at least.
template <std::size_t K>
std::vector<std::vector<std::pair<Id, std::size_t>>> cofaces_of(
    const std::vector<Row<K>>& cells, const std::map<Row<K - 1>, Id>& faces, bool all) {
  std::vector<std::vector<std::pair<Id, std::size_t>>> cofaces(faces.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::size_t k = 0; k < K; ++k) {
      const auto found = faces.find(without<K>(cells[i], k));
      require(found != faces.end(), "every face is there");
      cofaces[static_cast<std::size_t>(found->second)].push_back({static_cast<Id>(i), k});
    }
  }
  for (const auto& c : cofaces) require(!all || !c.empty(), "every face has a coface");
  return cofaces;
}

// A value is the circumradius if no coface's vertex is inside of the smallest sphere, else the
// least of the cofaces'. On the sphere, both are the same but for rounding.
struct Claim {
  double value = 0.0;
  double least = HUGE_VAL;          // of the cofaces
  bool inside = false, on = false;  // some apex is, of the smallest sphere
};

inline bool measurable(double value) { return value > 0x1p-1000 && value < 0x1p1000; }

inline void prove_value(const Geometry& g, const Id* row, std::size_t k, const Claim& claim,
                        double error) {
  require(claim.value >= 0.0, "values are not negative");
  require(claim.value <= claim.least, "values never decrease from face to coface");
  if (claim.inside) {
    require(claim.value == claim.least, "not Gabriel: the value of a coface");
  } else if (measurable(claim.value)) {
    require(g.is_circumradius(row, k, claim.value, error), "Gabriel: the circumradius");
  }
}

// Which value is the radius: one of all, or zero.
inline double chosen_radius(const std::vector<double>& values, std::size_t choice) {
  return values.empty() ? 0.0 : values[choice % values.size()];
}

// In the plane or on a sheet: triangles are the canonical Delaunay triangulation.
inline void prove_triangulation(const Geometry& g, const std::vector<Id>& vertices,
                                const std::vector<Row<3>>& triangles,
                                const std::vector<Row<2>>& edges) {
  const auto edge_number = numbered<2>(edges, vertices);
  numbered<3>(triangles, vertices);
  if (triangles.empty()) {
    require(edges.size() + 1 == vertices.size() || vertices.empty(), "a path");
    for (std::size_t i = 2; i < vertices.size(); ++i) {
      require(g.on_line(vertices[0], vertices[1], vertices[i]), "no triangle: all on a line");
    }
    std::vector<Id> along = vertices;
    std::sort(along.begin(), along.end(), [&](Id a, Id b) { return g.before(a, b); });
    for (std::size_t i = 1; i < along.size(); ++i) {
      const Row<2> step{std::min(along[i - 1], along[i]), std::max(along[i - 1], along[i])};
      require(edge_number.count(step) == 1, "edges join neighbours on the line");
    }
    return;
  }
  require(vertices.size() + triangles.size() == edges.size() + 1, "a disc by Euler");
  const auto cofaces = cofaces_of<3>(triangles, edge_number, true);
  for (const Row<3>& t : triangles) require(g.turn(t[0], t[1], t[2]) != 0, "no triangle is flat");
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges[e];
    require(cofaces[e].size() <= 2, "at most two triangles at an edge");
    const auto apex = [&](std::size_t i) {
      return triangles[static_cast<std::size_t>(cofaces[e][i].first)][cofaces[e][i].second];
    };
    const Id c = apex(0);
    const int left = g.turn(a, b, c);
    if (cofaces[e].size() == 1) {
      for (Id v : vertices) require(g.turn(a, b, v) * left >= 0, "all within the hull");
      continue;
    }
    const Id d = apex(1);
    require(g.turn(a, b, d) == -left, "triangles on both sides of an edge");
    const int s = left > 0 ? g.in_circle_or_out(a, b, c, d) : g.in_circle_or_out(b, a, c, d);
    require(s < 0, "locally Delaunay, ties broken");
  }
}

}  // namespace trust
