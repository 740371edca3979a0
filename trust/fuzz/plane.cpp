#include "plane.hpp"

#include <cstring>

#include "delaunay2.hpp"
#include "distance.hpp"
#include "hull2.hpp"
#include "locate2.hpp"
#include "nearest2.hpp"
#include "outline2.hpp"
#include "output2.hpp"
#include "parts.hpp"
#include "persistence2.hpp"
#include "proof.hpp"
#include "regular2.hpp"
#include "restricted2.hpp"
#include "union.hpp"
#include "voronoi2.hpp"

namespace trust {
namespace {

using alphamesh::Buffer;
using alphamesh::ComplexView2;
using alphamesh::Job;
using alphamesh::Point2;

constexpr double kError = 1e-14;

struct Built {
  std::size_t n = 0;
  int dimension = -1, exponent = 0;
  Buffer<Id> representative;
  alphamesh::Filtration2 f;
  Buffer<Id> vertices, hidden;  // with weights
  Buffer<double> vertex_radii;
};

Built build(const Cloud& cloud, Job& job) {
  Built out;
  out.n = cloud.n;
  const double* weights = cloud.weights.empty() ? nullptr : cloud.weights.data();
  auto order = alphamesh::spatial_order2(cloud.coordinates.data(), cloud.n, job, weights);
  out.exponent = order.exponent;
  if (weights == nullptr) {
    alphamesh::Mesh2 mesh = alphamesh::delaunay2(order, job);
    out.f = alphamesh::filtration2(order, mesh, job);
    out.representative = std::move(order.representative);
    return out;
  }
  out.representative = std::move(order.representative);
  const Id* merged = out.representative.size() == 0 ? nullptr : out.representative.data();
  auto regular = alphamesh::regular_filtration2(std::move(order), {weights, merged, cloud.n}, job);
  out.dimension = regular.dimension;
  out.f = std::move(regular.simplices);
  out.vertices = std::move(regular.vertices);
  out.vertex_radii = std::move(regular.vertex_radii);
  out.hidden = std::move(regular.hidden);
  return out;
}

// When each row joins the complex.
std::vector<double> births_of(const Built& built) {
  return trust::births_of(built.n, built.representative, built.vertices, built.vertex_radii);
}

class Plane {
 public:
  Plane(const Cloud& cloud, const std::vector<double>& queries, Built& built, Job& job)
      : cloud_(cloud),
        queries_(queries),
        built_(built),
        f_(built.f),
        job_(job),
        g_(cloud, queries),
        triangles_(rows_of<3>(f_.triangles.data(), f_.triangle_radii.size())),
        edges_(rows_of<2>(f_.edges.data(), f_.edge_radii.size())) {
    view_ = {cloud.coordinates.data(), cloud.n,       f_.triangles.data(),     triangles_.size(),
             f_.edges.data(),          edges_.size(), f_.edge_triangles.data()};
    if (g_.weighted()) view_.weights = cloud.weights.data();
  }

  void prove_filtration();
  void prove_persistence();
  void prove_same_in_reverse();
  void prove_triangulation_alone();
  void prove_hull();
  // Only where coordinates need no scaling.
  void prove_union();
  void prove_cells();
  void prove_outlines();
  void prove_location();
  void prove_nearest();
  void prove_voronoi();

 private:
  Id apex(Id edge, Id triangle) const {
    const Row<3>& t = triangles_[static_cast<std::size_t>(triangle)];
    const Row<2>& e = edges_[static_cast<std::size_t>(edge)];
    return t[0] != e[0] ? t[0] : (t[1] != e[1] ? t[1] : t[2]);
  }
  std::vector<char> within(const Buffer<double>& values) const {
    std::vector<char> in;
    for (std::size_t i = 0; i < values.size(); ++i) in.push_back(values[i] <= radius_);
    return in;
  }

  const Cloud& cloud_;
  const std::vector<double>& queries_;
  Built& built_;
  alphamesh::Filtration2& f_;
  Job& job_;
  Geometry g_;
  std::vector<Row<3>> triangles_;
  std::vector<Row<2>> edges_;
  std::vector<Id> vertices_;
  ComplexView2 view_{};
  double radius_ = 0.0;
};

void Plane::prove_filtration() {
  const auto places = proved_places(g_, cloud_.n, built_.representative);
  vertices_ = places;
  if (g_.weighted()) {
    vertices_ = proved_vertices(g_, cloud_.n, places, built_.representative, built_.vertices,
                                built_.hidden);
    prove_vertex_values(g_, vertices_, built_.vertex_radii, edges_, f_.edge_radii.data());
    const int expected = !triangles_.empty() ? 2 : !edges_.empty() ? 1 : vertices_.empty() ? -1 : 0;
    require(built_.dimension == expected, "the dimension is that of the simplices");
  }
  prove_triangulation(g_, places, vertices_, triangles_, edges_);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    prove_value(g_, triangles_[t].data(), 3, {f_.triangle_radii[t]}, kError);
  }
  for (Id e = 0; e < static_cast<Id>(edges_.size()); ++e) {
    Claim claim;
    claim.value = f_.edge_radii[static_cast<std::size_t>(e)];
    const Row<2>& ends = edges_[static_cast<std::size_t>(e)];
    const Id* cofaces = f_.edge_triangles.data() + 2 * e;
    require(cofaces[0] >= 0 || cofaces[1] < 0, "a missing coface comes last");
    for (int k = 0; k < 2 && cofaces[k] >= 0; ++k) {
      const Id c = apex(e, cofaces[k]);
      claim.inside |= g_.in_smallest(ends.data(), 2, c) > 0;
      claim.least = std::min(claim.least, f_.triangle_radii[static_cast<std::size_t>(cofaces[k])]);
    }
    prove_value(g_, ends.data(), 2, claim, kError);
  }
  std::map<Row<2>, std::set<Id>> around;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k)
      around[without<3>(triangles_[t], k)].insert(static_cast<Id>(t));
  }
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    std::set<Id> said{f_.edge_triangles[2 * e], f_.edge_triangles[2 * e + 1]};
    said.erase(-1);
    require(said == around[edges_[e]], "edge_triangles are the cofaces");
  }
  std::vector<double> values(f_.edge_radii.begin(), f_.edge_radii.end());
  values.insert(values.end(), f_.triangle_radii.begin(), f_.triangle_radii.end());
  std::sort(values.begin(), values.end());
  radius_ = chosen_radius(values, cloud_.choice);
}

void Plane::prove_persistence() {
  const std::vector<double> births = births_of(built_);
  const auto pairs = alphamesh::persistence2(view_, g_.weighted() ? births.data() : nullptr,
                                             f_.triangle_radii.data(), f_.edge_radii.data(), job_);
  std::vector<double> values;
  for (Id v : vertices_) values.push_back(births[static_cast<std::size_t>(v)]);
  std::vector<Id> number(cloud_.n, -1);
  for (std::size_t i = 0; i < vertices_.size(); ++i) number[vertices_[i]] = static_cast<Id>(i);
  const auto expected =
      reduced({{vertices_.data(), values.data(), vertices_.size()},
               {f_.edges.data(), f_.edge_radii.data(), edges_.size()},
               {f_.triangles.data(), f_.triangle_radii.data(), triangles_.size()}});
  require(
      sorted_pairs(pairs.components.data(), pairs.components.size() / 2, &number) == expected[0],
      "components are paired as the matrix says");
  require(sorted_pairs(pairs.loops.data(), pairs.loops.size() / 2) == expected[1],
          "loops are paired as the matrix says");
}

void Plane::prove_same_in_reverse() {
  const Cloud turned = reversed(cloud_);
  Job job(1);
  const Built other = build(turned, job);
  const char* claim = "the same for any order of the points and any number of threads";
  require(by_place<3>(cloud_, f_.triangles, f_.triangle_radii) ==
              by_place<3>(turned, other.f.triangles, other.f.triangle_radii),
          claim);
  require(by_place<2>(cloud_, f_.edges, f_.edge_radii) ==
              by_place<2>(turned, other.f.edges, other.f.edge_radii),
          claim);
  require(by_place<1>(cloud_, built_.vertices, built_.vertex_radii) ==
              by_place<1>(turned, other.vertices, other.vertex_radii),
          claim);
}

void Plane::prove_union() {
  if (vertices_.empty() || !in_range(cloud_, radius_)) return;
  const std::vector<double> births = births_of(built_);
  const Measured found = union_of({cloud_, births, &f_, nullptr}, radius_, job_);
  trust::prove_union(cloud_, radius_, found);
  if (!cloud_.again) return;
  const Cloud turned = reversed(cloud_);
  const Built other = build(turned, job_);
  const std::vector<double> others = births_of(other);
  prove_same_union(found, union_of({turned, others, &other.f, nullptr}, radius_, job_));
}

void Plane::prove_triangulation_alone() {
  auto order = alphamesh::spatial_order2(cloud_.coordinates.data(), cloud_.n, job_);
  alphamesh::Mesh2 mesh = alphamesh::delaunay2(order, job_);
  const auto t = alphamesh::triangulation2(order, mesh, job_);
  require(rows_of<3>(t.triangles.data(), t.triangles.size() / 3) == triangles_,
          "the triangulation is that of the filtration");
  if (triangles_.empty()) {
    auto path = rows_of<2>(t.edges.data(), t.edges.size() / 2), edges = edges_;
    std::sort(path.begin(), path.end());
    std::sort(edges.begin(), edges.end());
    require(path == edges, "the path is that of the filtration");
  }
  std::map<Row<2>, std::vector<Id>> around;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      around[without<3>(triangles_[i], k)].push_back(static_cast<Id>(i));
  }
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& both = around[without<3>(triangles_[i], k)];
      const Id beyond = both.size() < 2 ? -1 : both[0] == static_cast<Id>(i) ? both[1] : both[0];
      require(t.neighbors[3 * i + k] == beyond, "neighbours lie opposite");
    }
  }
  prove_location();
}

void Plane::prove_hull() {
  const auto all = alphamesh::hull2(cloud_.coordinates.data(), cloud_.n, true, job_);
  const auto corners = alphamesh::hull2(cloud_.coordinates.data(), cloud_.n, false, job_);
  const std::set<Id> on(all.data(), all.data() + all.size());
  require(on.size() == all.size(), "each point of the hull once");
  if (triangles_.empty()) {
    require(all.size() == vertices_.size(), "all points of a line are on its hull");
    require(corners.size() == std::min<std::size_t>(2, vertices_.size()), "a line has two ends");
    return;
  }
  const std::size_t k = corners.size();
  require(k >= 3, "a hull has corners");
  for (std::size_t i = 0; i < k; ++i) {
    require(i == 0 || g_.before(corners[0], corners[i]), "the least corner comes first");
    const Id a = corners[i], b = corners[(i + 1) % k];
    require(on.count(a) == 1, "corners are on the hull");
    for (Id v : vertices_) {
      const int turn = g_.turn(a, b, v);
      require(turn >= 0, "the hull holds all points");
      const bool between = turn == 0 && v != a && v != b;
      require(!between || g_.angle(a, b, v) < 0, "points on the line of a side lie on it");
      require(!between || on.count(v) == 1, "points on the sides are found");
    }
  }
}

void Plane::prove_cells() {
  const auto has_triangle = within(f_.triangle_radii), has_edge = within(f_.edge_radii);
  std::vector<char> active;
  for (double birth : births_of(built_)) {
    active.push_back(g_.weighted() ? birth <= radius_ : birth == 0.0);
  }
  const auto flags = [](const std::vector<char>& v) {
    return reinterpret_cast<const bool*>(v.data());
  };
  const auto cells = alphamesh::restricted2(view_, flags(has_triangle), flags(has_edge),
                                            flags(active), radius_, job_);
  std::set<Row<2>> expected, met;
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    if (has_edge[e] != 0) expected.insert(edges_[e]);
  }
  for (std::size_t v = 0; v < cloud_.n; ++v) {
    const auto begin = static_cast<std::size_t>(cells.offset[v]);
    const auto end = static_cast<std::size_t>(cells.offset[v + 1]);
    require((begin < end) == (active[v] != 0), "a cell for each distinct point");
    for (std::size_t i = begin; i < end; ++i) {
      const Id other = cells.neighbor[i], me = static_cast<Id>(v);
      if (other >= 0) {
        const Row<2> ends{std::min(me, other), std::max(me, other)};
        require(expected.count(ends) == 1, "cells touch only where the complex has the edge");
        met.insert(ends);
      } else {
        require(cells.angles[2 * i] <= cells.angles[2 * i + 1], "arcs run counter-clockwise");
      }
      const std::size_t next = i + 1 == end ? begin : i + 1;
      require(
          std::memcmp(&cells.end[i], &cells.start[next], sizeof(Point2)) == 0 || end - begin == 1,
          "borders are closed to the last bit");
    }
    require(!(cells.arc_length[v] < 0.0), "arcs have a length");
  }
  require(met == expected, "cells touch wherever the complex has the edge");
}

void Plane::prove_outlines() {
  const auto has = within(f_.triangle_radii);
  const auto region = alphamesh::parts(triangles_.size(), f_.edge_triangles.data(), edges_.size(),
                                       reinterpret_cast<const bool*>(has.data()), nullptr, job_);
  const auto lines = alphamesh::outlines2(view_, region.data(), job_);
  std::size_t borders = 0;
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const Id s = f_.edge_triangles[2 * e], t = f_.edge_triangles[2 * e + 1];
    const Id a = s < 0 ? -1 : region[s], b = t < 0 ? -1 : region[t];
    require(a < 0 || b < 0 || a == b, "regions that share an edge are one");
    borders += (a >= 0) != (b >= 0);
  }
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    require((region[t] >= 0) == (has[t] != 0), "regions are what is inside");
  }
  require(lines.row.size() == borders, "each border edge is in one ring");
  std::map<Id, int> outer;
  std::set<Id> seen;
  for (std::size_t ring = 0; ring + 1 < lines.offset.size(); ++ring) {
    const auto begin = static_cast<std::size_t>(lines.offset[ring]);
    const auto end = static_cast<std::size_t>(lines.offset[ring + 1]);
    require(end - begin >= 3, "rings have three corners or more");
    outer[lines.region[ring]] += lines.hole[ring] ? 0 : 1;
    std::set<Id> corners(lines.row.data() + begin, lines.row.data() + end);
    require(corners.size() == end - begin, "a ring passes no vertex twice");
    for (std::size_t i = begin; i < end; ++i) {
      const Id from = lines.row[i], to = lines.row[i + 1 == end ? begin : i + 1];
      const Id e = lines.edge[i];
      require(edges_[static_cast<std::size_t>(e)] == Row<2>{std::min(from, to), std::max(from, to)},
              "rings run along their edges");
      require(seen.insert(e).second, "each edge is in one ring");
      int left = 0;
      for (int k = 0; k < 2; ++k) {
        const Id t = f_.edge_triangles[2 * e + k];
        if (t >= 0 && region[t] == lines.region[ring]) left += g_.turn(from, to, apex(e, t));
      }
      require(left == 1, "the region is on the left of its rings");
    }
  }
  for (const auto& [r, count] : outer) require(r >= 0 && count == 1, "one outer ring a region");
}

void Plane::prove_location() {
  auto order = alphamesh::spatial_order2(cloud_.coordinates.data(), cloud_.n, job_);
  alphamesh::Mesh2 mesh = alphamesh::delaunay2(order, job_);
  const auto t = alphamesh::triangulation2(order, mesh, job_);
  const alphamesh::TriangulationView2 view{cloud_.coordinates.data(), cloud_.n, t.triangles.data(),
                                           t.neighbors.data(), triangles_.size()};
  const std::size_t m = queries_.size() / 2;
  Buffer<Id> found;
  try {
    found = alphamesh::locate2(view, queries_.data(), m, job_);
  } catch (const alphamesh::BadCoordinates&) {
    return;  // queries and points are too far apart in scale
  }
  for (std::size_t q = 0; q < m; ++q) {
    const Id query = static_cast<Id>(cloud_.n + q);
    Id lowest = -1;
    for (std::size_t i = 0; i < triangles_.size() && lowest < 0; ++i) {
      const auto [a, b, c] = triangles_[i];
      const int turn = g_.turn(a, b, c);
      if (g_.turn(a, b, query) * turn >= 0 && g_.turn(b, c, query) * turn >= 0 &&
          g_.turn(c, a, query) * turn >= 0) {
        lowest = static_cast<Id>(i);
      }
    }
    require(found[q] == lowest, "the lowest triangle that holds a point");
  }
}

void Plane::prove_nearest() {
  if (edges_.empty()) return;
  const auto tree =
      alphamesh::segment_tree2(cloud_.coordinates.data(), f_.edges.data(), edges_.size(), job_);
  require(tree.boxes.size() == alphamesh::box_count(edges_.size()), "boxes are counted");
  const std::size_t m = queries_.size() / 2;
  const auto found =
      alphamesh::nearest2({tree.items.data(), tree.place.data(), edges_.size(), tree.boxes.data()},
                          queries_.data(), m, job_);
  long double size = 0;
  for (double v : cloud_.coordinates) size = std::max<long double>(size, std::fabs(v));
  for (std::size_t q = 0; q < m; ++q) {
    const auto& p = g_.plain(static_cast<Id>(cloud_.n + q));
    long double least = HUGE_VALL;
    for (const auto& [a, b] : edges_) {
      least = std::min(least, distance(p, g_.plain(a), g_.plain(b)));
    }
    const auto [a, b] = edges_[static_cast<std::size_t>(found.place[q])];
    const long double slack = 1e-14L * size + 1e-300L;
    require(distance(p, g_.plain(a), g_.plain(b)) <= least + slack, "the nearest edge");
    require(std::fabs(found.distance[q] - least) <= slack, "the distance of the nearest edge");
  }
}

void Plane::prove_voronoi() {
  const auto vertices = alphamesh::voronoi_vertices2(view_, job_);
  std::vector<Id> group(triangles_.size());
  std::iota(group.begin(), group.end(), 0);
  for (bool changed = true; changed;) {  // the lowest of triangles on a common circle
    changed = false;
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const Id s = f_.edge_triangles[2 * e], t = f_.edge_triangles[2 * e + 1];
      if (s < 0 || t < 0 || group[s] == group[t]) continue;
      const Row<3>& row = triangles_[static_cast<std::size_t>(s)];
      if (g_.in_circle(row[0], row[1], row[2], apex(static_cast<Id>(e), t)) != 0) continue;
      group[s] = group[t] = std::min(group[s], group[t]);
      changed = true;
    }
  }
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    require(vertices.group[t] == group[t], "triangles of a circle have one Voronoi vertex");
    require(std::memcmp(&vertices.position[t], &vertices.position[group[t]], sizeof(Point2)) == 0,
            "which is in one place");
  }
}

}  // namespace

void prove_plane(const Cloud& cloud, const std::vector<double>& queries) {
  Job job(cloud.threads);
  const alphamesh::Recycling recycling;
  Built built = build(cloud, job);
  Plane plane(cloud, queries, built, job);
  plane.prove_filtration();
  plane.prove_persistence();
  if (cloud.again) plane.prove_same_in_reverse();
  if (cloud.weights.empty()) {
    plane.prove_triangulation_alone();
    plane.prove_hull();
  }
  if (built.exponent != 0) return;
  plane.prove_union();
  plane.prove_cells();
  plane.prove_outlines();
  plane.prove_voronoi();
  if (cloud.weights.empty()) plane.prove_nearest();
}

}  // namespace trust
