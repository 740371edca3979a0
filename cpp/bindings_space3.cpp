// Python functions for clouds in space.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "bindings.hpp"
#include "compact3.hpp"
#include "delaunay2.hpp"
#include "delaunay3.hpp"
#include "output2.hpp"
#include "output3.hpp"
#include "predicates3.hpp"
#include "sheet.hpp"
#include "span3.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {
namespace {

using Points3 = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
template <std::size_t K>
using Tuples3 = nb::ndarray<const double, nb::shape<-1, K, 3>, nb::c_contig, nb::device::cpu>;

void check_size(std::size_t n) {
  if (n > kMaxPoints3) throw TooManyPoints("at most 2^26 points");
}

nb::object representative_of(SpatialOrder3& order) {
  return order.representative.size() == 0 ? nb::none() : array(std::move(order.representative));
}

Filtration3 flat_filtration(const SpatialOrder3& order, const std::vector<std::int32_t>& span,
                            Job& job) {
  SpatialOrder<Sheet> sheet = sheet_of(order, span, job);
  Mesh2 mesh = delaunay2(sheet, job);
  return in_space(filtration2(sheet, mesh, job));
}

// The dimension of the cloud, and the simplices that it has: of a cloud in a plane the
// triangles without tetrahedra, on a line the edges.
nb::tuple alpha3(const Points3& points, int threads, const nb::object& progress) {
  const std::size_t n = points.shape(0);
  check_size(n);
  Job job(useful_threads(threads, n));
  SpatialOrder3 order;
  Filtration3 f;
  int dimension = -1;
  run_watched(job, n, progress, [&] {
    order = spatial_order3(points.data(), n, job);
    const std::vector<std::int32_t> span = spanning_points(order, job);
    dimension = static_cast<int>(span.size()) - 1;
    if (dimension == 3) {
      Mesh3 mesh = delaunay3(order, span, job);
      Compact3 compact = compact3(order, std::move(mesh), job);
      f = filtration3(order, std::move(compact), job);
    } else {
      f = flat_filtration(order, span, job);
    }
  });
  return nb::make_tuple(dimension, representative_of(order), array(std::move(f.tetrahedra), 4),
                        array(std::move(f.tetrahedron_radii)), array(std::move(f.triangles), 3),
                        array(std::move(f.triangle_radii)),
                        array(std::move(f.triangle_tetrahedra), 2), array(std::move(f.edges), 2),
                        array(std::move(f.edge_radii)));
}

// The dimension of the cloud, and its tetrahedra and their neighbours opposite to each
// vertex, -1 beyond the hull; empty arrays unless it is 3.
nb::tuple delaunay3_py(const Points3& points, int threads, const nb::object& progress) {
  const std::size_t n = points.shape(0);
  check_size(n);
  Job job(useful_threads(threads, n));
  SpatialOrder3 order;
  Compact3 compact;
  int dimension = -1;
  run_watched(job, n, progress, [&] {
    order = spatial_order3(points.data(), n, job);
    const std::vector<std::int32_t> span = spanning_points(order, job);
    dimension = static_cast<int>(span.size()) - 1;
    if (dimension != 3) return;
    compact = rows3(order, delaunay3(order, span, job), job);
  });
  return nb::make_tuple(dimension, representative_of(order), array(std::move(compact.vertex), 4),
                        array(std::move(compact.neighbor), 4));
}

// Calls sign() on each tuple of K points, brought into the range of exact products.
template <std::size_t K, class Sign>
nb::object signs(const Tuples3<K>& tuples, Sign&& sign) {
  const std::size_t n = tuples.shape(0);
  Buffer<std::int8_t> out(n);
  {
    const nb::gil_scoped_release released;
    Job job(1);
    for (std::size_t i = 0; i < n; ++i) {
      const double* t = tuples.data() + 3 * K * i;
      const PowerOfTwo factor(range_exponent<Space>(t, K, job));
      Point3 p[K];
      for (std::size_t k = 0; k < K; ++k) {
        p[k] = {factor * t[3 * k], factor * t[3 * k + 1], factor * t[3 * k + 2]};
      }
      out[i] = static_cast<std::int8_t>(sign(p));
    }
  }
  return array(std::move(out));
}

nb::object orient3_py(const Tuples3<4>& tuples) {
  return signs<4>(tuples,
                  [](const Point3* p) { return orient3(p[0], p[1], p[2], p[3], Lattice3()); });
}

nb::object insphere3_py(const Tuples3<5>& tuples, bool perturb) {
  return signs<5>(tuples, [perturb](const Point3* p) {
    const int s = in_sphere_exact(p[0], p[1], p[2], p[3], p[4], Lattice3());
    if (s != 0 || !perturb) return s;
    return in_sphere_perturbed(p[0], p[1], p[2], p[3], p[4], Lattice3()) ? 1 : -1;
  });
}

}  // namespace

void bind_space3(nb::module_& m) {
  m.def("alpha3", &alpha3, nb::arg("points"), nb::arg("threads"), nb::arg("progress").none());
  m.def("delaunay3", &delaunay3_py, nb::arg("points"), nb::arg("threads"),
        nb::arg("progress").none());
  m.def("orient3", &orient3_py, nb::arg("points"));
  m.def("insphere3", &insphere3_py, nb::arg("points"), nb::arg("perturb"));
}

}  // namespace alphamesh
