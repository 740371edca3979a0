// Python functions for weighted clouds in space.
#include <cstdint>

#include "bindings.hpp"
#include "regular3.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {
namespace {

using Points3 = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

nb::tuple regular3_py(const Points3& points, const Values& weights, int threads,
                      const nb::object& progress) {
  const std::size_t n = points.shape(0);
  if (n > kMaxPoints3) throw TooManyPoints("at most 2^26 points");
  if (weights.shape(0) != n) throw std::invalid_argument("one weight for each point");
  Job job(useful_threads(threads, n));
  SpatialOrder3 order;
  RegularFiltration3 r;
  run_watched(job, n, progress, [&] {
    order = spatial_order3(points.data(), n, job, weights.data());
    const std::int32_t* representative =
        order.representative.size() == 0 ? nullptr : order.representative.data();
    r = regular_filtration3(order, {weights.data(), representative, n}, job);
  });
  Filtration3& f = r.simplices;
  const nb::object representative =
      order.representative.size() == 0 ? nb::none() : array(std::move(order.representative));
  return nb::make_tuple(r.dimension, representative, array(std::move(r.vertices.hidden)),
                        array(std::move(f.tetrahedra), 4), array(std::move(f.tetrahedron_radii)),
                        array(std::move(f.triangles), 3), array(std::move(f.triangle_radii)),
                        array(std::move(f.triangle_tetrahedra), 2), array(std::move(f.edges), 2),
                        array(std::move(f.edge_radii)), array(std::move(r.vertices.vertices)),
                        array(std::move(r.vertices.radii)));
}

}  // namespace

void bind_regular3(nb::module_& m) {
  m.def("regular3", &regular3_py, nb::arg("points"), nb::arg("weights"), nb::arg("threads"),
        nb::arg("progress").none());
}

}  // namespace alphamesh
