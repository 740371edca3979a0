// Python functions for topology: pairs in space, connected components anywhere.
#include <cstdint>

#include "bindings.hpp"
#include "pairing.hpp"
#include "persistence3.hpp"

namespace alphamesh {
namespace {

nb::tuple persistence3_py(std::size_t n, const Ids& edges, const Values& edge_radii,
                          const Ids& triangle_edges, const Values& triangle_radii,
                          const Ids& triangle_tetrahedra, const Values& tetrahedron_radii,
                          const Values& births, int threads, const nb::object& progress) {
  const FiltrationView3 view{n,
                             births_or_null(births),
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

std::size_t component_count(std::size_t n, const Ids& pairs) {
  Job job(1);
  std::size_t count = 0;
  run_watched(job, n, nb::none(),
              [&] { count = count_components(n, pairs.data(), pairs.shape(0), job); });
  return count;
}

}  // namespace

void bind_persistence3(nb::module_& m) {
  m.def("persistence3", &persistence3_py, nb::arg("n"), nb::arg("edges"), nb::arg("edge_radii"),
        nb::arg("triangle_edges"), nb::arg("triangle_radii"), nb::arg("triangle_tetrahedra"),
        nb::arg("tetrahedron_radii"), nb::arg("births"), nb::arg("threads"),
        nb::arg("progress").none());
  m.def("component_count", &component_count, nb::arg("n"), nb::arg("pairs"));
}

}  // namespace alphamesh
