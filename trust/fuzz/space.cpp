#include "space.hpp"

#include "compact3.hpp"
#include "delaunay2.hpp"
#include "delaunay3.hpp"
#include "incidence3.hpp"
#include "output3.hpp"
#include "persistence3.hpp"
#include "proof.hpp"
#include "regular3.hpp"
#include "sheet.hpp"
#include "solid.hpp"
#include "span3.hpp"
#include "union.hpp"

namespace trust {
namespace {

using alphamesh::Buffer;
using alphamesh::Job;

constexpr double kError = 2e-13, kWeightedError = 5e-13;

struct Built {
  std::size_t n = 0;
  int dimension = -1, exponent = 0;
  Buffer<Id> representative;
  alphamesh::Filtration3 f;
  alphamesh::VertexRows vertices;  // with weights
};

alphamesh::Filtration3 filtration(const alphamesh::SpatialOrder3& order, int* dimension, Job& job) {
  const std::vector<Id> span = alphamesh::spanning_points(order, job);
  *dimension = static_cast<int>(span.size()) - 1;
  if (*dimension == 3) {
    alphamesh::Mesh3 mesh = alphamesh::delaunay3(order, span, job);
    return alphamesh::filtration3(order, alphamesh::compact3(order, std::move(mesh), job), job);
  }
  auto sheet = alphamesh::sheet_of(order, span, job);
  alphamesh::Mesh2 mesh = alphamesh::delaunay2(sheet, job);
  return alphamesh::in_space(alphamesh::filtration2(sheet, mesh, job));
}

Built build(const Cloud& cloud, Job& job) {
  Built out;
  out.n = cloud.n;
  const double* weights = cloud.weights.empty() ? nullptr : cloud.weights.data();
  auto order = alphamesh::spatial_order3(cloud.coordinates.data(), cloud.n, job, weights);
  out.exponent = order.exponent;
  if (weights == nullptr) {
    out.f = filtration(order, &out.dimension, job);
  } else {
    const Id* merged = order.representative.size() == 0 ? nullptr : order.representative.data();
    auto regular = alphamesh::regular_filtration3(order, {weights, merged, cloud.n}, job);
    out.dimension = regular.dimension;
    out.f = std::move(regular.simplices);
    out.vertices = std::move(regular.vertices);
  }
  out.representative = std::move(order.representative);
  return out;
}

// When each row joins the complex.
std::vector<double> births_of(const Built& built) {
  return trust::births_of(built.n, built.representative, built.vertices.vertices,
                          built.vertices.radii);
}

class Space {
 public:
  Space(const Cloud& cloud, const std::vector<double>& queries, Built& built, Job& job)
      : cloud_(cloud),
        queries_(queries),
        built_(built),
        f_(built.f),
        job_(job),
        g_(cloud, queries),
        tetrahedra_(rows_of<4>(f_.tetrahedra.data(), f_.tetrahedron_radii.size())),
        triangles_(rows_of<3>(f_.triangles.data(), f_.triangle_radii.size())),
        edges_(rows_of<2>(f_.edges.data(), f_.edge_radii.size())) {}

  void prove_filtration();
  void prove_persistence();
  void prove_same_in_reverse();
  void prove_triangulation_alone();
  // Only where coordinates need no scaling.
  void prove_union();
  void prove_solid();

 private:
  void prove_dimension();
  void prove_mesh();
  void prove_hidden(Id h);
  void look_flat();
  Id cell_apex(Id triangle, Id cell) const {
    return apex_of(tetrahedra_[static_cast<std::size_t>(cell)],
                   triangles_[static_cast<std::size_t>(triangle)]);
  }

  const Cloud& cloud_;
  const std::vector<double>& queries_;
  Built& built_;
  alphamesh::Filtration3& f_;
  Job& job_;
  Geometry g_;
  std::vector<Row<4>> tetrahedra_;
  std::vector<Row<3>> triangles_;
  std::vector<Row<2>> edges_;
  std::vector<Id> places_, vertices_;  // without duplicates; those that are not hidden
  Buffer<Id> tetrahedron_triangles_;
};

// Points on a plane are looked at along an axis that it does not hold.
void Space::look_flat() {
  const Row<3>& t = triangles_[0];
  std::size_t dropped = 0;
  for (; dropped < 3; ++dropped) {
    g_.look_along(dropped);
    if (g_.turn(t[0], t[1], t[2]) != 0) break;
  }
  require(dropped < 3, "no triangle is flat");
  for (Id v : places_) require(g_.side(t[0], t[1], t[2], v) == 0, "all on a plane");
}

void Space::prove_dimension() {
  const int expected = vertices_.empty()       ? -1
                       : !tetrahedra_.empty()  ? 3
                       : !triangles_.empty()   ? 2
                       : vertices_.size() >= 2 ? 1
                                               : 0;
  require(built_.dimension == expected, "the dimension is that of the simplices");
}

// Tetrahedra are the canonical Delaunay triangulation: locally, and within a convex hull.
void Space::prove_mesh() {
  numbered<4>(tetrahedra_, vertices_);
  const auto triangle_number = numbered<3>(triangles_, vertices_);
  const auto edge_number = numbered<2>(edges_, vertices_);
  require(vertices_.size() + triangles_.size() == edges_.size() + tetrahedra_.size() + 1,
          "a ball by Euler");
  const auto cells = cofaces_of<4>(tetrahedra_, triangle_number, true);
  cofaces_of<3>(triangles_, edge_number, true);
  for (const Row<4>& t : tetrahedra_) {
    require(g_.side(t[0], t[1], t[2], t[3]) != 0, "no tetrahedron is flat");
  }
  for (std::size_t f = 0; f < triangles_.size(); ++f) {
    const auto [a, b, c] = triangles_[f];
    require(cells[f].size() <= 2, "at most two tetrahedra at a triangle");
    std::set<Id> said{f_.triangle_tetrahedra[2 * f], f_.triangle_tetrahedra[2 * f + 1]}, found;
    said.erase(-1);
    for (const auto& coface : cells[f]) found.insert(coface.first);
    require(said == found, "triangle_tetrahedra are the cofaces");
    const Id d = cell_apex(static_cast<Id>(f), cells[f][0].first);
    const int side = g_.side(a, b, c, d);
    if (cells[f].size() == 1) {
      for (Id v : places_) require(g_.side(a, b, c, v) * side >= 0, "all within the hull");
      continue;
    }
    const Id e = cell_apex(static_cast<Id>(f), cells[f][1].first);
    require(g_.side(a, b, c, e) == -side, "tetrahedra on both sides of a triangle");
    const int s =
        side > 0 ? g_.in_sphere_or_out(a, b, c, d, e) : g_.in_sphere_or_out(b, a, c, d, e);
    require(s < 0, "locally Delaunay, ties broken");
  }
  for (const Id h : places_) {
    if (!std::binary_search(vertices_.begin(), vertices_.end(), h)) prove_hidden(h);
  }
}

void Space::prove_hidden(Id h) {
  for (const Row<4>& row : tetrahedra_) {
    auto [a, b, c, d] = row;
    if (g_.side(a, b, c, d) < 0) std::swap(a, b);
    if (g_.side(h, b, c, d) < 0 || g_.side(a, h, c, d) < 0 || g_.side(a, b, h, d) < 0 ||
        g_.side(a, b, c, h) < 0) {
      continue;
    }
    require(g_.in_sphere_or_out(a, b, c, d, h) < 0, "hidden points are lifted above a tetrahedron");
    return;
  }
  require(false, "hidden points lie in a tetrahedron");
}

void Space::prove_filtration() {
  places_ = vertices_ = proved_places(g_, cloud_.n, built_.representative);
  if (g_.weighted()) {
    vertices_ = proved_vertices(g_, cloud_.n, places_, built_.representative,
                                built_.vertices.vertices, built_.vertices.hidden);
    prove_vertex_values(g_, vertices_, built_.vertices.radii, edges_, f_.edge_radii.data());
  }
  prove_dimension();
  if (!tetrahedra_.empty()) {
    prove_mesh();
  } else {
    if (!triangles_.empty()) look_flat();
    prove_triangulation(g_, places_, vertices_, triangles_, edges_);
  }
  const double error = g_.weighted() ? kWeightedError : kError;
  for (std::size_t t = 0; t < tetrahedra_.size(); ++t) {
    prove_value(g_, tetrahedra_[t].data(), 4, {f_.tetrahedron_radii[t]}, error);
  }
  std::map<Row<2>, std::vector<Id>> around;
  for (std::size_t f = 0; f < triangles_.size(); ++f) {
    const auto [a, b, c] = triangles_[f];
    Claim claim;
    claim.value = f_.triangle_radii[f];
    for (std::size_t k = 0; k < 2; ++k) {
      const Id t = f_.triangle_tetrahedra[2 * f + k];
      if (t < 0) continue;
      claim.inside |= g_.in_smallest(triangles_[f].data(), 3, cell_apex(static_cast<Id>(f), t)) > 0;
      claim.least = std::min(claim.least, f_.tetrahedron_radii[static_cast<std::size_t>(t)]);
    }
    prove_value(g_, triangles_[f].data(), 3, claim, error);
    for (std::size_t k = 0; k < 3; ++k)
      around[without<3>(triangles_[f], k)].push_back(static_cast<Id>(f));
  }
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto [a, b] = edges_[e];
    Claim claim;
    claim.value = f_.edge_radii[e];
    for (Id f : around[edges_[e]]) {
      const Row<3>& t = triangles_[static_cast<std::size_t>(f)];
      const Id c = t[0] != a ? t[0] : (t[1] != b ? t[1] : t[2]);
      claim.inside |= g_.in_smallest(edges_[e].data(), 2, c) > 0;
      claim.least = std::min(claim.least, f_.triangle_radii[static_cast<std::size_t>(f)]);
    }
    prove_value(g_, edges_[e].data(), 2, claim, error);
  }
}

void Space::prove_persistence() {
  const alphamesh::ComplexView3 complex{
      cloud_.n,          f_.tetrahedra.data(),          tetrahedra_.size(), f_.triangles.data(),
      triangles_.size(), f_.triangle_tetrahedra.data(), f_.edges.data(),    edges_.size()};
  const Buffer<Id> triangle_edges = alphamesh::triangle_edges3(complex, job_);
  for (std::size_t i = 0; i < 3 * triangles_.size(); ++i) {
    require(
        edges_[static_cast<std::size_t>(triangle_edges[i])] == without<3>(triangles_[i / 3], i % 3),
        "edges lie opposite to the vertices of triangles");
  }
  tetrahedron_triangles_ = alphamesh::tetrahedron_triangles3(complex, job_);
  for (std::size_t i = 0; i < 4 * tetrahedra_.size(); ++i) {
    require(triangles_[static_cast<std::size_t>(tetrahedron_triangles_[i])] ==
                without<4>(tetrahedra_[i / 4], i % 4),
            "triangles lie opposite to the vertices of tetrahedra");
  }
  const std::vector<double> births = births_of(built_);
  const auto pairs =
      alphamesh::persistence3({cloud_.n, g_.weighted() ? births.data() : nullptr, f_.edges.data(),
                               f_.edge_radii.data(), edges_.size(), triangle_edges.data(),
                               f_.triangle_tetrahedra.data(), f_.triangle_radii.data(),
                               triangles_.size(), f_.tetrahedron_radii.data(), tetrahedra_.size()},
                              job_);
  std::vector<double> values;
  for (Id v : vertices_) values.push_back(births[static_cast<std::size_t>(v)]);
  std::vector<Id> number(cloud_.n, -1);
  for (std::size_t i = 0; i < vertices_.size(); ++i) number[vertices_[i]] = static_cast<Id>(i);
  const auto expected =
      reduced({{vertices_.data(), values.data(), vertices_.size()},
               {f_.edges.data(), f_.edge_radii.data(), edges_.size()},
               {f_.triangles.data(), f_.triangle_radii.data(), triangles_.size()},
               {f_.tetrahedra.data(), f_.tetrahedron_radii.data(), tetrahedra_.size()}});
  require(
      sorted_pairs(pairs.components.data(), pairs.components.size() / 2, &number) == expected[0],
      "components are paired as the matrix says");
  require(sorted_pairs(pairs.loops.data(), pairs.loops.size() / 2) == expected[1],
          "loops are paired as the matrix says");
  require(sorted_pairs(pairs.voids.data(), pairs.voids.size() / 2) == expected[2],
          "voids are paired as the matrix says");
}

void Space::prove_same_in_reverse() {
  const Cloud turned = reversed(cloud_);
  Job job(1);
  const Built other = build(turned, job);
  const char* claim = "the same for any order of the points and any number of threads";
  require(by_place<4>(cloud_, f_.tetrahedra, f_.tetrahedron_radii) ==
              by_place<4>(turned, other.f.tetrahedra, other.f.tetrahedron_radii),
          claim);
  require(by_place<3>(cloud_, f_.triangles, f_.triangle_radii) ==
              by_place<3>(turned, other.f.triangles, other.f.triangle_radii),
          claim);
  require(by_place<2>(cloud_, f_.edges, f_.edge_radii) ==
              by_place<2>(turned, other.f.edges, other.f.edge_radii),
          claim);
  require(by_place<1>(cloud_, built_.vertices.vertices, built_.vertices.radii) ==
              by_place<1>(turned, other.vertices.vertices, other.vertices.radii),
          claim);
}

void Space::prove_triangulation_alone() {
  if (tetrahedra_.empty()) return;
  const auto order = alphamesh::spatial_order3(cloud_.coordinates.data(), cloud_.n, job_);
  const auto span = alphamesh::spanning_points(order, job_);
  auto mesh = alphamesh::rows3(order, alphamesh::delaunay3(order, span, job_), job_);
  const auto rows = rows_of<4>(mesh.vertex.data(), mesh.count);
  std::map<Row<3>, std::vector<Id>> around;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < 4; ++k)
      around[without<4>(rows[i], k)].push_back(static_cast<Id>(i));
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& both = around[without<4>(rows[i], k)];
      const Id beyond = both.size() < 2 ? -1 : both[0] == static_cast<Id>(i) ? both[1] : both[0];
      require(mesh.neighbor[4 * i + k] == beyond, "neighbours lie opposite");
    }
  }
  auto sorted = rows, expected = tetrahedra_;
  std::sort(sorted.begin(), sorted.end());
  std::sort(expected.begin(), expected.end());
  require(sorted == expected, "the triangulation is that of the filtration");
}

void Space::prove_union() {
  std::vector<double> radii(f_.triangle_radii.data(),
                            f_.triangle_radii.data() + f_.triangle_radii.size());
  radii.insert(radii.end(), f_.edge_radii.data(), f_.edge_radii.data() + f_.edge_radii.size());
  radii.insert(radii.end(), f_.tetrahedron_radii.data(),
               f_.tetrahedron_radii.data() + f_.tetrahedron_radii.size());
  std::sort(radii.begin(), radii.end());
  const double radius = chosen_radius(radii, cloud_.choice);
  if (vertices_.empty() || !in_range(cloud_, radius)) return;
  const std::vector<double> births = births_of(built_);
  const Measured found = union_of({cloud_, births, nullptr, &f_}, radius, job_);
  trust::prove_union(cloud_, radius, found);
  if (!cloud_.again) return;
  const Cloud turned = reversed(cloud_);
  const Built other = build(turned, job_);
  const std::vector<double> others = births_of(other);
  prove_same_union(found, union_of({turned, others, nullptr, &other.f}, radius, job_));
}

void Space::prove_solid() {
  trust::prove_solid({cloud_, queries_, f_, tetrahedra_, triangles_, tetrahedron_triangles_, g_},
                     job_);
}

}  // namespace

void prove_space(const Cloud& cloud, const std::vector<double>& queries) {
  Job job(cloud.threads);
  const alphamesh::Recycling recycling;
  Built built = build(cloud, job);
  Space space(cloud, queries, built, job);
  space.prove_filtration();
  space.prove_persistence();
  if (cloud.again) space.prove_same_in_reverse();
  if (cloud.weights.empty()) space.prove_triangulation_alone();
  if (built.exponent != 0) return;
  space.prove_union();
  if (built.dimension != 3) return;
  space.prove_solid();
}

}  // namespace trust
