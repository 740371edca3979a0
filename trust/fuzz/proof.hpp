// What holds of every alpha filtration, in the plane and in space: proved, or abort.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "exact.hpp"
#include "homology.hpp"
#include "memory.hpp"

namespace trust {

template <std::size_t K>
using Row = std::array<Id, K>;

template <std::size_t K>
std::vector<Row<K>> rows_of(const Id* rows, std::size_t count) {
  std::vector<Row<K>> out(count);
  for (std::size_t i = 0; i < K * count; ++i) out[i / K][i % K] = rows[i];
  return out;
}

// The rows that stand for themselves, checked: the lowest of the heaviest at their place.
inline std::vector<Id> proved_places(const Geometry& g, std::size_t n,
                                     const alphamesh::Buffer<Id>& representative) {
  require(representative.size() == 0 || representative.size() == n, "one for each point");
  std::map<Vector<long double>, Id> best;
  const auto place = [&](Id i) {
    Vector<long double> p = g.plain(i);
    for (long double& v : p) v += 0.0L;  // no negative zeros
    return p;
  };
  for (Id i = 0; i < static_cast<Id>(n); ++i) {
    const auto [at, is_new] = best.emplace(place(i), i);
    if (!is_new && g.weight(i) > g.weight(at->second)) at->second = i;
  }
  std::vector<Id> places;
  for (Id i = 0; i < static_cast<Id>(n); ++i) {
    const Id stands = best[place(i)];
    require((representative.size() == 0 ? i : representative[i]) == stands,
            "the lowest of the heaviest equal rows represents");
    if (stands == i) places.push_back(i);
  }
  return places;
}

// The rows of a weighted cloud that have simplices: the others are said to be hidden.
inline std::vector<Id> proved_vertices(const Geometry& g, std::size_t n,
                                       const std::vector<Id>& places,
                                       const alphamesh::Buffer<Id>& representative,
                                       const alphamesh::Buffer<Id>& rows,
                                       const alphamesh::Buffer<Id>& hidden) {
  const std::vector<Id> vertices(rows.data(), rows.data() + rows.size());
  require(std::is_sorted(vertices.begin(), vertices.end()), "vertices ascend");
  require(std::includes(places.begin(), places.end(), vertices.begin(), vertices.end()),
          "vertices stand for themselves");
  std::vector<Id> expected;
  for (Id i = 0; i < static_cast<Id>(n); ++i) {
    const Id stands = representative.size() == 0 ? i : representative[i];
    const bool vertex = std::binary_search(vertices.begin(), vertices.end(), i);
    if (!vertex && (stands == i || g.weight(i) < g.weight(stands))) expected.push_back(i);
  }
  require(expected == std::vector<Id>(hidden.data(), hidden.data() + hidden.size()),
          "hidden rows are told");
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

inline bool measurable(double value) {
  return std::fabs(value) > 0x1p-1000 && std::fabs(value) < 0x1p1000;
}

inline void prove_value(const Geometry& g, const Id* row, std::size_t k, const Claim& claim,
                        double error) {
  require(claim.value >= 0.0 || g.weighted(), "values are not negative");
  require(claim.value <= claim.least, "values never decrease from face to coface");
  if (claim.inside) {
    require(claim.value == claim.least, "not Gabriel: the value of a coface");
  } else if (measurable(claim.value)) {
    require(g.is_value(row, k, claim.value, error), "Gabriel: its own value");
  }
}

// Of a weighted cloud.
inline void prove_vertex_values(const Geometry& g, const std::vector<Id>& vertices,
                                const alphamesh::Buffer<double>& radii,
                                const std::vector<Row<2>>& edges, const double* edge_radii) {
  require(radii.size() == vertices.size(), "a value for each vertex");
  std::map<Id, Claim> claims;
  for (std::size_t i = 0; i < vertices.size(); ++i) claims[vertices[i]].value = radii[i];
  for (std::size_t e = 0; e < edges.size(); ++e) {
    for (std::size_t k = 0; k < 2; ++k) {
      Claim& claim = claims[edges[e][k]];
      claim.least = std::min(claim.least, edge_radii[e]);
      claim.inside |= g.in_smallest(&edges[e][k], 1, edges[e][1 - k]) > 0;
    }
  }
  for (const auto& [v, claim] : claims) prove_value(g, &v, 1, claim, 1e-15);
}

// When each row joins the complex, never if it is hidden. Without weights, there are no rows
// of vertices: all that stand for themselves are there from the beginning.
inline std::vector<double> births_of(std::size_t n, const alphamesh::Buffer<Id>& representative,
                                     const alphamesh::Buffer<Id>& vertices,
                                     const alphamesh::Buffer<double>& radii) {
  std::vector<double> births(n, HUGE_VAL);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    births[static_cast<std::size_t>(vertices[i])] = radii[i];
  }
  for (std::size_t i = 0; i < n && vertices.size() == 0; ++i) {
    const bool own = representative.size() == 0 || representative[i] == static_cast<Id>(i);
    if (own) births[i] = 0.0;
  }
  return births;
}

// Simplices by coordinates, so that they do not depend on the numbers of rows.
template <std::size_t K>
std::map<std::set<Vector<double>>, double> by_place(const Cloud& cloud,
                                                    const alphamesh::Buffer<Id>& rows,
                                                    const alphamesh::Buffer<double>& values) {
  std::map<std::set<Vector<double>>, double> out;
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::set<Vector<double>> corners;
    for (std::size_t k = 0; k < K; ++k) {
      Vector<double> p{};
      const double* row = cloud.row(static_cast<std::size_t>(rows[K * i + k]));
      for (std::size_t a = 0; a < cloud.dimension; ++a) p[a] = row[a] + 0.0;
      corners.insert(p);
    }
    out.emplace(corners, values[i]);
  }
  return out;
}

// Which value is the radius: one of all, or zero.
inline double chosen_radius(const std::vector<double>& values, std::size_t choice) {
  return values.empty() ? 0.0 : values[choice % values.size()];
}

// On a line: a path along the vertices; what lies between them is lifted above it.
inline void prove_path(const Geometry& g, const std::vector<Id>& places,
                       const std::vector<Id>& vertices, const std::vector<Row<2>>& edges) {
  require(edges.size() + 1 == vertices.size() || vertices.empty(), "a path");
  for (std::size_t i = 2; i < places.size(); ++i) {
    require(g.on_line(places[0], places[1], places[i]), "no triangle: all on a line");
  }
  const std::set<Row<2>> known(edges.begin(), edges.end());
  std::vector<Id> along = places;
  std::sort(along.begin(), along.end(), [&](Id a, Id b) { return g.before(a, b); });
  std::vector<Id> path, between;
  for (const Id i : along) {
    if (!std::binary_search(vertices.begin(), vertices.end(), i)) {
      between.push_back(i);
      continue;
    }
    require(!path.empty() || between.empty(), "the ends are not hidden");
    if (!path.empty()) {
      const Id last = path.back();
      require(known.count({std::min(last, i), std::max(last, i)}) == 1,
              "edges join neighbours on the line");
      for (const Id h : between) require(g.in_interval(last, i, h) < 0, "hidden on the line");
    }
    between.clear();
    path.push_back(i);
    const std::size_t k = path.size();
    require(k < 3 || g.in_interval(path[k - 3], i, path[k - 2]) >= 0, "no vertex is hidden");
  }
  require(between.empty(), "the ends are not hidden");
}

// In the plane or on a sheet: triangles are the canonical Delaunay triangulation.
inline void prove_triangulation(const Geometry& g, const std::vector<Id>& places,
                                const std::vector<Id>& vertices,
                                const std::vector<Row<3>>& triangles,
                                const std::vector<Row<2>>& edges) {
  const auto edge_number = numbered<2>(edges, vertices);
  numbered<3>(triangles, vertices);
  if (triangles.empty()) {
    prove_path(g, places, vertices, edges);
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
      for (Id v : places) require(g.turn(a, b, v) * left >= 0, "all within the hull");
      continue;
    }
    const Id d = apex(1);
    require(g.turn(a, b, d) == -left, "triangles on both sides of an edge");
    const int s = left > 0 ? g.in_circle_or_out(a, b, c, d) : g.in_circle_or_out(b, a, c, d);
    require(s < 0, "locally Delaunay, ties broken");
  }
  for (const Id h : places) {
    if (std::binary_search(vertices.begin(), vertices.end(), h)) continue;
    const auto holds = [&](const Row<3>& t) {
      const int turn = g.turn(t[0], t[1], t[2]);
      return g.turn(t[0], t[1], h) * turn >= 0 && g.turn(t[1], t[2], h) * turn >= 0 &&
             g.turn(t[2], t[0], h) * turn >= 0;
    };
    const auto at = std::find_if(triangles.begin(), triangles.end(), holds);
    require(at != triangles.end(), "hidden points lie in a triangle");
    const auto [a, b, c] = *at;
    const int s =
        g.turn(a, b, c) > 0 ? g.in_circle_or_out(a, b, c, h) : g.in_circle_or_out(b, a, c, h);
    require(s < 0, "hidden points are lifted above it");
  }
}

}  // namespace trust
