// The seam to Python for what bounds what in space, and for connected parts.
#include "bindings.hpp"
#include "incidence3.hpp"
#include "parts.hpp"

namespace alphamesh {
namespace {

int useful_threads3(int threads, std::size_t triangles) { return triangles < 100000 ? 1 : threads; }

nb::object tetrahedron_triangles3_py(const Ids& tetrahedra, const Ids& triangles,
                                     const Ids& triangle_tetrahedra, int threads) {
  const std::size_t count = triangles.shape(0);
  const ComplexView3 view{0,
                          tetrahedra.data(),
                          tetrahedra.shape(0),
                          triangles.data(),
                          count,
                          triangle_tetrahedra.data(),
                          nullptr,
                          0};
  Job job(useful_threads3(threads, count));
  Buffer<std::int32_t> out;
  run_watched(job, count, nb::none(), [&] { out = tetrahedron_triangles3(view, job); });
  return array(std::move(out), 4);
}

nb::object triangle_edges3_py(std::size_t n, const Ids& triangles, const Ids& edges, int threads) {
  const std::size_t count = triangles.shape(0);
  const ComplexView3 view{
      n, nullptr, 0, triangles.data(), count, nullptr, edges.data(), edges.shape(0)};
  Job job(useful_threads3(threads, count));
  Buffer<std::int32_t> out;
  run_watched(job, count, nb::none(), [&] { out = triangle_edges3(view, job); });
  return array(std::move(out), 3);
}

nb::object parts3_py(const Ids& triangle_tetrahedra, const Flags& inside, const Flags& wall) {
  if (wall.shape(0) != triangle_tetrahedra.shape(0)) {
    throw std::invalid_argument("wall: not one truth value for each triangle");
  }
  const std::size_t count = triangle_tetrahedra.shape(0);
  Job job(1);
  Buffer<std::int32_t> out;
  run_watched(job, count, nb::none(), [&] {
    out =
        parts(inside.shape(0), triangle_tetrahedra.data(), count, inside.data(), wall.data(), job);
  });
  return array(std::move(out));
}

}  // namespace

void bind_incidence3(nb::module_& m) {
  m.def("tetrahedron_triangles3", &tetrahedron_triangles3_py, nb::arg("tetrahedra"),
        nb::arg("triangles"), nb::arg("triangle_tetrahedra"), nb::arg("threads"));
  m.def("triangle_edges3", &triangle_edges3_py, nb::arg("n"), nb::arg("triangles"),
        nb::arg("edges"), nb::arg("threads"));
  m.def("parts3", &parts3_py, nb::arg("triangle_tetrahedra"), nb::arg("inside"), nb::arg("wall"));
}

}  // namespace alphamesh
