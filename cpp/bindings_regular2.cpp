// Python functions for weighted clouds in the plane.
#include <cstdint>

#include "bindings.hpp"
#include "regular2.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {
namespace {

nb::tuple regular2_py(const Points2& points, const Values& weights, int threads,
                      const nb::object& progress) {
  const std::size_t n = points.shape(0);
  if (weights.shape(0) != n) throw nb::value_error("as many weights as points");
  if (n > kMaxPoints2) throw TooManyPoints("at most 2^27 points");
  Job job(useful_threads(threads, n));
  Buffer<std::int32_t> representative;
  RegularFiltration2 f;
  run_watched(job, n, progress, [&] {
    SpatialOrder2 order = spatial_order2(points.data(), n, job, weights.data());
    representative = std::move(order.representative);
    const std::int32_t* merged = representative.size() == 0 ? nullptr : representative.data();
    f = regular_filtration2(std::move(order), {weights.data(), merged, n}, job);
  });
  Filtration2& s = f.simplices;
  return nb::make_tuple(f.dimension,
                        representative.size() == 0 ? nb::none() : array(std::move(representative)),
                        array(std::move(f.hidden)), array(std::move(s.triangles), 3),
                        array(std::move(s.triangle_radii)), array(std::move(s.edges), 2),
                        array(std::move(s.edge_radii)), array(std::move(s.edge_triangles), 2),
                        array(std::move(f.vertices)), array(std::move(f.vertex_radii)));
}

}  // namespace

void bind_regular2(nb::module_& m) {
  m.def("regular2", &regular2_py, nb::arg("points"), nb::arg("weights"), nb::arg("threads"),
        nb::arg("progress").none());
}

}  // namespace alphamesh
