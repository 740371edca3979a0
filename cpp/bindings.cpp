// The seam to Python: arrays in, arrays out. All that knows of Python stands here.
#include "bindings.hpp"

#include <nanobind/stl/string.h>

#include <cstdint>

#include "delaunay2.hpp"
#include "output2.hpp"
#include "persistence2.hpp"
#include "selftest.hpp"
#include "spatial_sort.hpp"

using namespace alphamesh;

namespace {

void check_size(std::size_t n) {
  if (n > kMaxPoints2) throw TooManyPoints("at most 2^27 points");
}

nb::object representative_of(SpatialOrder2& order) {
  return order.representative.size() == 0 ? nb::none() : array(std::move(order.representative));
}

nb::tuple alpha2(const Points2& points, int threads, const nb::object& progress) {
  const std::size_t n = points.shape(0);
  check_size(n);
  Job job(useful_threads(threads, n));
  SpatialOrder2 order;
  Filtration2 f;
  run_watched(job, n, progress, [&] {
    order = spatial_order2(points.data(), n, job);
    Mesh2 mesh = delaunay2(order, job);
    f = filtration2(order, mesh, job);
  });
  return nb::make_tuple(representative_of(order), array(std::move(f.triangles), 3),
                        array(std::move(f.triangle_radii)), array(std::move(f.edges), 2),
                        array(std::move(f.edge_radii)), array(std::move(f.edge_triangles), 2));
}

nb::object triangle_edges2_py(const Points2& points, const Ids& triangles, const Ids& edges,
                              const Ids& edge_triangles, int threads) {
  const ComplexView2 view = view_of(points, triangles, edges, edge_triangles);
  Job job(useful_threads(threads, view.n));
  Buffer<std::int32_t> out;
  run_watched(job, view.n, nb::none(), [&] { out = triangle_edges2(view, job); });
  return array(std::move(out), 3);
}

nb::tuple rings2_py(const Points2& points, const Ids& triangles, const Ids& edges,
                    const Ids& edge_triangles, int threads) {
  const ComplexView2 view = view_of(points, triangles, edges, edge_triangles);
  Job job(useful_threads(threads, view.n));
  Rings2 rings;
  run_watched(job, view.n, nb::none(),
              [&] { rings = rings2(view, triangle_edges2(view, job), job); });
  return nb::make_tuple(array(std::move(rings.offset)), array(std::move(rings.edge)),
                        array(std::move(rings.triangle)));
}

nb::tuple persistence2_py(const Points2& points, const Ids& triangles, const Values& triangle_radii,
                          const Ids& edges, const Values& edge_radii, const Ids& edge_triangles,
                          const Values& births, int threads, const nb::object& progress) {
  const ComplexView2 view = view_of(points, triangles, edges, edge_triangles);
  Job job(useful_threads(threads, view.n));
  Pairs2 pairs;
  run_watched(job, view.n, progress, [&] {
    pairs =
        persistence2(view, births_or_null(births), triangle_radii.data(), edge_radii.data(), job);
  });
  return nb::make_tuple(array(std::move(pairs.components), 2), array(std::move(pairs.loops), 2));
}

nb::tuple delaunay2_py(const Points2& points, int threads, const nb::object& progress) {
  const std::size_t n = points.shape(0);
  check_size(n);
  Job job(useful_threads(threads, n));
  SpatialOrder2 order;
  Triangulation2 t;
  run_watched(job, n, progress, [&] {
    order = spatial_order2(points.data(), n, job);
    Mesh2 mesh = delaunay2(order, job);
    t = triangulation2(order, mesh, job);
  });
  return nb::make_tuple(representative_of(order), array(std::move(t.triangles), 3),
                        array(std::move(t.neighbors), 3), array(std::move(t.edges), 2));
}

Point2 point(const double* xy) { return {xy[0], xy[1]}; }

// Calls sign() on each tuple of K points, brought into the range of exact products.
template <std::size_t K, class Sign>
nb::object signs(const Tuples2<K>& tuples, Sign&& sign) {
  const std::size_t n = tuples.shape(0);
  Buffer<std::int8_t> out(n);
  {
    const nb::gil_scoped_release released;
    Job job(1);
    double scaled[2 * K];
    for (std::size_t i = 0; i < n; ++i) {
      const double* t = tuples.data() + 2 * K * i;
      const int exponent = range_exponent<Plane>(t, K, job);
      if (exponent != 0) {
        const PowerOfTwo factor(exponent);
        for (std::size_t k = 0; k < 2 * K; ++k) scaled[k] = factor * t[k];
        t = scaled;
      }
      out[i] = static_cast<std::int8_t>(sign(t));
    }
  }
  return array(std::move(out));
}

nb::object orient2(const Tuples2<3>& tuples) {
  return signs<3>(tuples, [](const double* t) {
    return orient(point(t), point(t + 2), point(t + 4), Lattice());
  });
}

nb::object dot2(const Tuples2<3>& tuples) {
  return signs<3>(
      tuples, [](const double* t) { return dot(point(t), point(t + 2), point(t + 4), Lattice()); });
}

nb::object incircle2(const Tuples2<4>& tuples, bool perturb) {
  return signs<4>(tuples, [perturb](const double* t) {
    const Point2 a = point(t), b = point(t + 2), c = point(t + 4), d = point(t + 6);
    const int s = in_circle_or_zero(a, b, c, d, Lattice());
    return s != 0 || !perturb ? s : in_circle_perturbed(a, b, c, d, Lattice());
  });
}

}  // namespace

NB_MODULE(_core, m) {
  nb::exception<BadCoordinates>(m, "BadCoordinates", PyExc_ValueError);
  nb::exception<TooManyPoints>(m, "TooManyPoints", PyExc_ValueError);
  m.def("alpha2", &alpha2, nb::arg("points"), nb::arg("threads"), nb::arg("progress").none());
  m.def("delaunay2", &delaunay2_py, nb::arg("points"), nb::arg("threads"),
        nb::arg("progress").none());
  m.def("triangle_edges2", &triangle_edges2_py, nb::arg("points"), nb::arg("triangles"),
        nb::arg("edges"), nb::arg("edge_triangles"), nb::arg("threads"));
  m.def("rings2", &rings2_py, nb::arg("points"), nb::arg("triangles"), nb::arg("edges"),
        nb::arg("edge_triangles"), nb::arg("threads"));
  m.def("persistence2", &persistence2_py, nb::arg("points"), nb::arg("triangles"),
        nb::arg("triangle_radii"), nb::arg("edges"), nb::arg("edge_radii"),
        nb::arg("edge_triangles"), nb::arg("births"), nb::arg("threads"),
        nb::arg("progress").none());
  m.def("orient2", &orient2, nb::arg("points"));
  m.def("dot2", &dot2, nb::arg("points"));
  m.def("incircle2", &incircle2, nb::arg("points"), nb::arg("perturb"));
  bind_incidence3(m);
  bind_outlines2(m);
  bind_periodic(m);
  bind_persistence3(m);
  bind_regular2(m);
  bind_regular3(m);
  bind_space3(m);
  bind_surface3(m);
  bind_tiles(m);
  bind_unions(m);
  bind_voronoi2(m);
  m.def("trim_memory", &trim_memory);
  m.def("self_test", &self_test);
}
