// The seam to Python for Voronoi cells, the convex hull and point location.
#include <cstdint>

#include "bindings.hpp"
#include "hull2.hpp"
#include "locate2.hpp"
#include "restricted2.hpp"
#include "spatial_sort.hpp"
#include "voronoi2.hpp"

namespace alphamesh {
namespace {

nb::tuple voronoi_vertices2_py(const Points2& points, const Ids& triangles, const Ids& edges,
                               const Ids& edge_triangles, const Values& weights, int threads) {
  const ComplexView2 view =
      weighted_view(view_of(points, triangles, edges, edge_triangles), weights);
  Job job(useful_threads(threads, view.n));
  VoronoiVertices2 out;
  run_watched(job, view.n, nb::none(), [&] { out = voronoi_vertices2(view, job); });
  return nb::make_tuple(points_array(std::move(out.position)), array(std::move(out.group)));
}

nb::object hull2_py(const Points2& points, bool collinear, int threads) {
  const std::size_t n = points.shape(0);
  if (n > kMaxPoints2) throw TooManyPoints("at most 2^27 points");
  Job job(useful_threads(threads, n));
  Buffer<std::int32_t> out;
  run_watched(job, n, nb::none(), [&] { out = hull2(points.data(), n, collinear, job); });
  return array(std::move(out));
}

nb::object locate2_py(const Points2& points, const Ids& triangles, const Ids& neighbors,
                      const Points2& queries, int threads) {
  const TriangulationView2 view{points.data(), points.shape(0), triangles.data(), neighbors.data(),
                                triangles.shape(0)};
  const std::size_t m = queries.shape(0);
  Job job(useful_threads(threads, m));
  Buffer<std::int32_t> out;
  run_watched(job, m, nb::none(), [&] { out = locate2(view, queries.data(), m, job); });
  return array(std::move(out));
}

nb::tuple restricted2_py(const Points2& points, const Ids& triangles, const Flags& has_triangle,
                         const Ids& edges, const Flags& has_edge, const Ids& edge_triangles,
                         const Flags& active, double radius, const Values& weights, int threads,
                         const nb::object& progress) {
  const ComplexView2 view =
      weighted_view(view_of(points, triangles, edges, edge_triangles), weights);
  Job job(useful_threads(threads, view.n));
  RestrictedCells2 c;
  run_watched(job, view.n, progress, [&] {
    c = restricted2(view, has_triangle.data(), has_edge.data(), active.data(), radius, job);
  });
  return nb::make_tuple(array(std::move(c.offset)), points_array(std::move(c.start)),
                        points_array(std::move(c.end)), array(std::move(c.neighbor)),
                        array(std::move(c.angles), 2), array(std::move(c.straight_area)),
                        array(std::move(c.segment_length)), array(std::move(c.arc_length)));
}

}  // namespace

void bind_voronoi2(nb::module_& m) {
  m.def("voronoi_vertices2", &voronoi_vertices2_py, nb::arg("points"), nb::arg("triangles"),
        nb::arg("edges"), nb::arg("edge_triangles"), nb::arg("weights"), nb::arg("threads"));
  m.def("hull2", &hull2_py, nb::arg("points"), nb::arg("collinear"), nb::arg("threads"));
  m.def("locate2", &locate2_py, nb::arg("points"), nb::arg("triangles"), nb::arg("neighbors"),
        nb::arg("queries"), nb::arg("threads"));
  m.def("restricted2", &restricted2_py, nb::arg("points"), nb::arg("triangles"),
        nb::arg("has_triangle"), nb::arg("edges"), nb::arg("has_edge"), nb::arg("edge_triangles"),
        nb::arg("active"), nb::arg("radius"), nb::arg("weights"), nb::arg("threads"),
        nb::arg("progress").none());
}

}  // namespace alphamesh
