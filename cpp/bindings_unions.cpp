// The seam to Python for the measures of unions of discs and of balls.
#include <nanobind/stl/optional.h>

#include <optional>

#include "bindings.hpp"
#include "union2.hpp"
#include "union3.hpp"

namespace alphamesh {
namespace {

using Points3 = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using MaybeValues = std::optional<Values>;
using Labels = nb::ndarray<const std::int32_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

const double* data_or_null(const MaybeValues& values) {
  return values.has_value() ? values->data() : nullptr;
}

nb::tuple union2_py(const Ids& edges, const Ids& edge_triangles, const Ids& triangles,
                    const Ids& triangle_edges, const nb::tuple& has, const Labels& hole,
                    std::size_t hole_count, const Points2& points, const MaybeValues& weights,
                    double power, int threads, const nb::object& progress) {
  const auto vertex = nb::cast<Flags>(has[0]), edge = nb::cast<Flags>(has[1]),
             triangle = nb::cast<Flags>(has[2]);
  const DiscsView view{points.data(),
                       data_or_null(weights),
                       points.shape(0),
                       power,
                       vertex.data(),
                       edges.data(),
                       edge.data(),
                       edge_triangles.data(),
                       edges.shape(0),
                       triangles.data(),
                       triangle_edges.data(),
                       triangle.data(),
                       hole.data(),
                       triangles.shape(0),
                       hole_count};
  Job job(useful_threads(threads, view.n));
  UnionOfDiscs2 out;
  run_watched(job, view.triangle_count, progress, [&] { out = union2(view, job); });
  return nb::make_tuple(out.area, array(std::move(out.areas)), array(std::move(out.perimeters)),
                        array(std::move(out.hole_areas)), array(std::move(out.hole_perimeters)));
}

nb::tuple union3_py(const Ids& edges, const Ids& triangles, const Ids& triangle_edges,
                    const Ids& triangle_tetrahedra, const Ids& tetrahedra,
                    const Ids& tetrahedron_triangles, const nb::tuple& has, const Labels& hollow,
                    std::size_t void_count, const Points3& points, const MaybeValues& weights,
                    double power, int threads, const nb::object& progress) {
  const auto vertex = nb::cast<Flags>(has[0]), edge = nb::cast<Flags>(has[1]),
             triangle = nb::cast<Flags>(has[2]), tetrahedron = nb::cast<Flags>(has[3]);
  const BallsView view{points.data(),
                       data_or_null(weights),
                       points.shape(0),
                       power,
                       vertex.data(),
                       edges.data(),
                       edge.data(),
                       edges.shape(0),
                       triangles.data(),
                       triangle_edges.data(),
                       triangle_tetrahedra.data(),
                       triangle.data(),
                       triangles.shape(0),
                       tetrahedra.data(),
                       tetrahedron_triangles.data(),
                       tetrahedron.data(),
                       hollow.data(),
                       tetrahedra.shape(0),
                       void_count};
  Job job(useful_threads(threads, view.n));
  UnionOfBalls3 out;
  run_watched(job, view.tetrahedron_count, progress, [&] { out = union3(view, job); });
  return nb::make_tuple(out.volume, array(std::move(out.volumes)),
                        array(std::move(out.surface_areas)), array(std::move(out.void_volumes)),
                        array(std::move(out.void_areas)));
}

}  // namespace

void bind_unions(nb::module_& m) {
  m.def("union2", &union2_py, nb::arg("edges"), nb::arg("edge_triangles"), nb::arg("triangles"),
        nb::arg("triangle_edges"), nb::arg("has"), nb::arg("hole"), nb::arg("hole_count"),
        nb::arg("points"), nb::arg("weights").none(), nb::arg("power"), nb::arg("threads"),
        nb::arg("progress").none());
  m.def("union3", &union3_py, nb::arg("edges"), nb::arg("triangles"), nb::arg("triangle_edges"),
        nb::arg("triangle_tetrahedra"), nb::arg("tetrahedra"), nb::arg("tetrahedron_triangles"),
        nb::arg("has"), nb::arg("hollow"), nb::arg("void_count"), nb::arg("points"),
        nb::arg("weights").none(), nb::arg("power"), nb::arg("threads"),
        nb::arg("progress").none());
}

}  // namespace alphamesh
