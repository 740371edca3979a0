#include "persistence2.hpp"

#include "pairing.hpp"

namespace alphamesh {

Pairs2 persistence2(const ComplexView2& view, const double* births, const double* triangle_radii,
                    const double* edge_radii, Job& job) {
  const Buffer<std::uint64_t> order = ascending(edge_radii, view.edge_count, job);
  job.advance(0.3);
  Pairs2 out;
  job.run(2, [&](std::size_t task) {
    if (task == 0) {
      out.components = pair_components(view.n, births, view.edges, order, job);
    } else {
      out.loops =
          pair_hollows(view.edge_triangles, order, triangle_radii, view.triangle_count, job);
    }
    job.advance(0.35);
  });
  return out;
}

}  // namespace alphamesh
