// The seam to Python for sets of triangles: their parts, outlines and nearest edges.
#include "bindings.hpp"
#include "nearest2.hpp"
#include "outline2.hpp"
#include "parts.hpp"

namespace alphamesh {
namespace {

using Flags1 = nb::ndarray<const bool, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Ids1 = nb::ndarray<const std::int32_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Quads = nb::ndarray<const double, nb::shape<-1, 4>, nb::c_contig, nb::device::cpu>;

template <class T>
nb::object quads_array(Buffer<T>&& buffer) {
  static_assert(sizeof(T) == 4 * sizeof(double));
  auto* owner = new Buffer<T>(std::move(buffer));
  nb::capsule capsule(owner, [](void* p) noexcept { delete static_cast<Buffer<T>*>(p); });
  const std::size_t shape[2] = {owner->size(), 4};
  return nb::cast(
      nb::ndarray<nb::numpy, double>(reinterpret_cast<double*>(owner->data()), 2, shape, capsule));
}

// Below this, one thread is done before a second one has started.
int threads_for_edges(int threads, std::size_t edges) { return edges < 300000 ? 1 : threads; }

nb::object parts2_py(const Points2& points, const Ids& triangles, const Ids& edges,
                     const Ids& edge_triangles, const Flags1& inside) {
  const ComplexView2 view = view_of(points, triangles, edges, edge_triangles);
  Job job(1);
  Buffer<std::int32_t> out;
  run_watched(job, view.n, nb::none(), [&] {
    out = parts(view.triangle_count, view.edge_triangles, view.edge_count, inside.data(), nullptr,
                job);
  });
  return array(std::move(out));
}

nb::tuple outlines2_py(const Points2& points, const Ids& triangles, const Ids& edges,
                       const Ids& edge_triangles, const Ids1& region, int threads) {
  const ComplexView2 view = view_of(points, triangles, edges, edge_triangles);
  Job job(threads_for_edges(threads, view.edge_count));
  Outlines2 out;
  run_watched(job, view.n, nb::none(), [&] { out = outlines2(view, region.data(), job); });
  return nb::make_tuple(array(std::move(out.offset)), array(std::move(out.row)),
                        array(std::move(out.edge)), array(std::move(out.region)),
                        array(std::move(out.hole)));
}

nb::tuple segment_tree2_py(const Points2& points, const Ids& edges, int threads) {
  const std::size_t k = edges.shape(0);
  Job job(threads_for_edges(threads, k));
  SegmentTree2 tree;
  run_watched(job, k, nb::none(),
              [&] { tree = segment_tree2(points.data(), edges.data(), k, job); });
  return nb::make_tuple(quads_array(std::move(tree.items)), array(std::move(tree.place)),
                        quads_array(std::move(tree.boxes)));
}

nb::tuple nearest2_py(const Quads& segments, const Ids1& place, const Quads& boxes,
                      const Points2& queries, int threads, const nb::object& progress) {
  if (segments.shape(0) == 0 || place.shape(0) != segments.shape(0) ||
      boxes.shape(0) != box_count(segments.shape(0))) {
    throw std::invalid_argument("not the arrays of one tree of segments");
  }
  const SegmentTreeView2 tree{reinterpret_cast<const Segment2*>(segments.data()), place.data(),
                              segments.shape(0), reinterpret_cast<const Box2*>(boxes.data())};
  const std::size_t q = queries.shape(0);
  Job job(useful_threads(threads, q));
  Nearest2 out;
  run_watched(job, q, progress, [&] { out = nearest2(tree, queries.data(), q, job); });
  return nb::make_tuple(array(std::move(out.place)), points_array(std::move(out.point)),
                        array(std::move(out.distance)));
}

}  // namespace

void bind_outlines2(nb::module_& m) {
  m.def("parts2", &parts2_py, nb::arg("points"), nb::arg("triangles"), nb::arg("edges"),
        nb::arg("edge_triangles"), nb::arg("inside"));
  m.def("outlines2", &outlines2_py, nb::arg("points"), nb::arg("triangles"), nb::arg("edges"),
        nb::arg("edge_triangles"), nb::arg("region"), nb::arg("threads"));
  m.def("segment_tree2", &segment_tree2_py, nb::arg("points"), nb::arg("edges"),
        nb::arg("threads"));
  m.def("nearest2", &nearest2_py, nb::arg("segments"), nb::arg("place"), nb::arg("boxes"),
        nb::arg("queries"), nb::arg("threads"), nb::arg("progress").none());
}

}  // namespace alphamesh
