// The seam to Python for boundaries in space, and for queries about them.
#include "bindings.hpp"
#include "locate3.hpp"
#include "nearest3.hpp"
#include "surface3.hpp"

namespace alphamesh {
namespace {

using Points3 = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Ids1 = nb::ndarray<const std::int32_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

// Below this, one thread is done before a second one has started.
int threads_for_cells(int threads, std::size_t cells) { return cells < 50000 ? 1 : threads; }

nb::tuple surface3_py(const Points3& points, const Ids& tetrahedra, const Ids& triangles,
                      const Ids& triangle_tetrahedra, const Ids& tetrahedron_triangles,
                      const Flags& inside, int threads) {
  const std::size_t cells = tetrahedra.shape(0);
  if (inside.shape(0) != cells || tetrahedron_triangles.shape(0) != cells ||
      triangle_tetrahedra.shape(0) != triangles.shape(0)) {
    throw std::invalid_argument("not the arrays of one triangulation");
  }
  const Solid3 solid{points.data(),
                     points.shape(0),
                     tetrahedra.data(),
                     cells,
                     triangles.data(),
                     triangles.shape(0),
                     triangle_tetrahedra.data(),
                     tetrahedron_triangles.data(),
                     inside.data()};
  Job job(threads_for_cells(threads, cells));
  Surface3 out;
  run_watched(job, solid.triangle_count, nb::none(), [&] { out = surface3(solid, job); });
  return nb::make_tuple(array(std::move(out.triangle)), array(std::move(out.corner), 3),
                        array(std::move(out.across), 3), array(std::move(out.vertex), 3),
                        array(std::move(out.row)), array(std::move(out.shell)));
}

nb::object outer_shells3_py(const Ids1& shell, const Ids1& region, const Ids1& part) {
  const std::size_t k = shell.shape(0);
  if (region.shape(0) != k || part.shape(0) != k) {
    throw std::invalid_argument("not one shell, region and part for each facet");
  }
  Buffer<bool> outer;
  {
    const nb::gil_scoped_release released;
    outer = outer_shells3(shell.data(), region.data(), part.data(), k);
  }
  return array(std::move(outer));
}

nb::tuple locate3_py(const Points3& points, const Ids& tetrahedra, const Ids& triangle_tetrahedra,
                     const Ids& tetrahedron_triangles, const Ids1& label, const Points3& queries,
                     int threads) {
  const std::size_t cells = tetrahedra.shape(0), q = queries.shape(0);
  if (label.shape(0) != cells || tetrahedron_triangles.shape(0) != cells) {
    throw std::invalid_argument("not the arrays of one triangulation");
  }
  const LabelledSpace3 space{points.data(),
                             points.shape(0),
                             tetrahedra.data(),
                             cells,
                             triangle_tetrahedra.data(),
                             tetrahedron_triangles.data(),
                             label.data()};
  Job job(useful_threads(threads, q));
  Located3 out;
  run_watched(job, q, nb::none(), [&] { out = locate3(space, queries.data(), q, job); });
  return nb::make_tuple(array(std::move(out.label)), array(std::move(out.side)));
}

// Rows of numbers as NumPy sees them.
template <class T>
nb::object rows_array(Buffer<T>&& buffer) {
  constexpr std::size_t columns = sizeof(T) / sizeof(double);
  static_assert(columns * sizeof(double) == sizeof(T));
  auto* owner = new Buffer<T>(std::move(buffer));
  nb::capsule capsule(owner, [](void* p) noexcept { delete static_cast<Buffer<T>*>(p); });
  const std::size_t shape[2] = {owner->size(), columns};
  return nb::cast(
      nb::ndarray<nb::numpy, double>(reinterpret_cast<double*>(owner->data()), 2, shape, capsule));
}

using Corners3 = nb::ndarray<const double, nb::shape<-1, 9>, nb::c_contig, nb::device::cpu>;
using Boxes3 = nb::ndarray<const double, nb::shape<-1, 6>, nb::c_contig, nb::device::cpu>;

nb::tuple triangle_tree3_py(const Points3& points, const Ids& triangles, int threads) {
  const std::size_t k = triangles.shape(0);
  Job job(threads_for_cells(threads, k));
  TriangleTree3 tree;
  run_watched(job, k, nb::none(),
              [&] { tree = triangle_tree3(points.data(), triangles.data(), k, job); });
  return nb::make_tuple(rows_array(std::move(tree.items)), array(std::move(tree.place)),
                        rows_array(std::move(tree.boxes)));
}

nb::tuple nearest3_py(const Corners3& triangles, const Ids1& place, const Boxes3& boxes,
                      const Points3& queries, int threads) {
  if (triangles.shape(0) == 0 || place.shape(0) != triangles.shape(0) ||
      boxes.shape(0) != box_count(triangles.shape(0))) {
    throw std::invalid_argument("not the arrays of one tree of triangles");
  }
  const TriangleTreeView3 tree{reinterpret_cast<const Triangle3*>(triangles.data()), place.data(),
                               triangles.shape(0), reinterpret_cast<const Box3*>(boxes.data())};
  const std::size_t q = queries.shape(0);
  Job job(useful_threads(threads, q));
  Nearest3 out;
  run_watched(job, q, nb::none(), [&] { out = nearest3(tree, queries.data(), q, job); });
  return nb::make_tuple(array(std::move(out.place)), rows_array(std::move(out.point)),
                        array(std::move(out.distance)));
}

}  // namespace

void bind_surface3(nb::module_& m) {
  m.def("surface3", &surface3_py, nb::arg("points"), nb::arg("tetrahedra"), nb::arg("triangles"),
        nb::arg("triangle_tetrahedra"), nb::arg("tetrahedron_triangles"), nb::arg("inside"),
        nb::arg("threads"));
  m.def("outer_shells3", &outer_shells3_py, nb::arg("shell"), nb::arg("region"), nb::arg("part"));
  m.def("locate3", &locate3_py, nb::arg("points"), nb::arg("tetrahedra"),
        nb::arg("triangle_tetrahedra"), nb::arg("tetrahedron_triangles"), nb::arg("label"),
        nb::arg("queries"), nb::arg("threads"));
  m.def("triangle_tree3", &triangle_tree3_py, nb::arg("points"), nb::arg("triangles"),
        nb::arg("threads"));
  m.def("nearest3", &nearest3_py, nb::arg("triangles"), nb::arg("place"), nb::arg("boxes"),
        nb::arg("queries"), nb::arg("threads"));
}

}  // namespace alphamesh
