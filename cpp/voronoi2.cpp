#include "voronoi2.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "disjoint_sets.hpp"
#include "power2.hpp"

namespace alphamesh {
namespace {

using Id = std::int32_t;

// Whether the two triangles of an edge have all their corners on one circle; with weights,
// whether one circle is orthogonal to all of theirs.
bool cocircular(const ComplexView2& view, Id s, Id t) {
  const Id* a = view.triangles + 3 * static_cast<std::size_t>(s);
  const Id* b = view.triangles + 3 * static_cast<std::size_t>(t);
  int k = 0;  // the corner of t that s does not have
  while (b[k] == a[0] || b[k] == a[1] || b[k] == a[2]) ++k;
  if (view.weights != nullptr) {
    auto ball = [&](Id row) { return Weighted<Point2>{view.point(row), view.weight(row)}; };
    return in_power_circle_or_zero(ball(a[0]), ball(a[1]), ball(a[2]), ball(b[k]), Lattice()) == 0;
  }
  return in_circle_or_zero(view.point(a[0]), view.point(a[1]), view.point(a[2]), view.point(b[k]),
                           Lattice()) == 0;
}

using Pairs = std::vector<std::pair<Id, Id>>;

std::vector<Pairs> cocircular_neighbors(const ComplexView2& view, Job& job) {
  const Parts parts(view.edge_count, job);
  std::vector<Pairs> found(parts.count());
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t e = parts.begin(part); e < parts.end(part); ++e) {
      const Id s = view.edge_triangles[2 * e], t = view.edge_triangles[2 * e + 1];
      if (s >= 0 && t >= 0 && cocircular(view, s, t)) found[part].emplace_back(s, t);
    }
  });
  return found;
}

}  // namespace

VoronoiVertices2 voronoi_vertices2(const ComplexView2& view, Job& job) {
  VoronoiVertices2 out{circumcentres2(view, job), Buffer<Id>(view.triangle_count)};
  DisjointSets sets(view.triangle_count);
  for (const Pairs& pairs : cocircular_neighbors(view, job)) {
    for (const auto& [s, t] : pairs) {
      const Id a = sets.root(s), b = sets.root(t);
      sets.join(std::max(a, b), std::min(a, b));
    }
  }
  for (std::size_t t = 0; t < view.triangle_count; ++t) {
    out.group[t] = sets.root(static_cast<Id>(t));
    out.position[t] = out.position[static_cast<std::size_t>(out.group[t])];
  }
  return out;
}

}  // namespace alphamesh
