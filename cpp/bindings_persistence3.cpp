// Python functions for the topology of complexes in space.
#include <cstdint>

#include "bindings.hpp"
#include "persistence3.hpp"

namespace alphamesh {
namespace {

nb::tuple persistence3_py(std::size_t n, const Ids& edges, const Values& edge_radii,
                          const Ids& triangle_edges, const Values& triangle_radii,
                          const Ids& triangle_tetrahedra, const Values& tetrahedron_radii,
                          int threads, const nb::object& progress) {
  const FiltrationView3 view{n,
                             edges.data(),
                             edge_radii.data(),
                             edges.shape(0),
                             triangle_edges.data(),
                             triangle_tetrahedra.data(),
                             triangle_radii.data(),
                             triangle_edges.shape(0),
                             tetrahedron_radii.data(),
                             tetrahedron_radii.shape(0)};
  Job job(useful_threads(threads, n));
  Pairs3 pairs;
  run_watched(job, n, progress, [&] { pairs = persistence3(view, job); });
  return nb::make_tuple(array(std::move(pairs.components), 2), array(std::move(pairs.loops), 2),
                        array(std::move(pairs.voids), 2));
}

}  // namespace

void bind_persistence3(nb::module_& m) {
  m.def("persistence3", &persistence3_py, nb::arg("n"), nb::arg("edges"), nb::arg("edge_radii"),
        nb::arg("triangle_edges"), nb::arg("triangle_radii"), nb::arg("triangle_tetrahedra"),
        nb::arg("tetrahedron_radii"), nb::arg("threads"), nb::arg("progress").none());
}

}  // namespace alphamesh
