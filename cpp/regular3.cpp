#include "regular3.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "compact3.hpp"
#include "delaunay3.hpp"
#include "regular2.hpp"
#include "rules3.hpp"
#include "sheet.hpp"
#include "span3.hpp"

namespace alphamesh {
namespace {

using Id = std::int32_t;

VertexRows vertices_of(const SpatialOrder3& order, const WeightedRule3& rule, const Filtration3& f,
                       const WeightedRows& rows, Job& job) {
  Buffer<Role> role(rows.n);
  std::fill(role.begin(), role.end(), Role::kNone);
  for (std::size_t v = 0; v < order.size; ++v) {
    role[static_cast<std::size_t>(order.row[v])] = rule.role(v);
  }
  const EdgeView edges{f.edges.data(), f.edge_radii.data(), f.edge_radii.size()};
  return vertex_rows(role.data(), rows.weight, rows.representative, rows.n, edges, job);
}

}  // namespace

RegularFiltration3 regular_filtration3(const SpatialOrder3& order, const WeightedRows& rows,
                                       Job& job) {
  RegularFiltration3 out;
  const std::vector<Id> span = spanning_points(order, job);
  out.dimension = static_cast<int>(span.size()) - 1;
  if (out.dimension < 3) {
    RegularFiltration2 flat = regular_filtration2(sheet_of(order, span, job), rows, job);
    out.simplices = in_space(std::move(flat.simplices));
    out.vertices = {std::move(flat.vertices), std::move(flat.vertex_radii), std::move(flat.hidden)};
    return out;
  }
  WeightedRule3 rule(order);
  Mesh3 mesh = regular3(order, span, job);
  out.simplices = filtration3(order, compact3(order, std::move(mesh), job), rule, job);
  out.vertices = vertices_of(order, rule, out.simplices, rows, job);
  return out;
}

}  // namespace alphamesh
