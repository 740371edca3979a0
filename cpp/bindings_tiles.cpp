// Python functions for tiles of clouds larger than memory.
#include "bindings.hpp"
#include "regular2.hpp"
#include "spread.hpp"
#include "tile_share2.hpp"
#include "tile_share3.hpp"

namespace alphamesh {
namespace {

using Table = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Bytes = nb::ndarray<const std::uint8_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Numbers = nb::ndarray<const std::int64_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
template <class Row>
using Rows = nb::ndarray<const Row, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

// Columns that are contiguous each, as tables on disk want them.
template <class T>
nb::object columns_array(Columns<T>&& columns) {
  const std::size_t width = columns.width, count = columns.count;
  const auto apart = static_cast<std::int64_t>(columns.room);
  auto* owner = new Buffer<T>(std::move(columns.values));
  nb::capsule capsule(owner, [](void* p) noexcept { delete static_cast<Buffer<T>*>(p); });
  const std::size_t shape[2] = {count, width};
  const std::int64_t strides[2] = {1, apart};
  return nb::cast(
      nb::ndarray<nb::numpy, T>(owner->data(), width == 1 ? 1 : 2, shape, capsule, strides));
}

template <class T>
nb::object list_array(std::vector<T>&& list, std::size_t columns, std::size_t dimensions = 2) {
  auto* owner = new std::vector<T>(std::move(list));
  nb::capsule capsule(owner, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  const std::size_t shape[2] = {owner->size() / columns, columns};
  return nb::cast(nb::ndarray<nb::numpy, T>(owner->data(), dimensions, shape, capsule));
}

template <class T>
nb::object list_array(std::vector<T>&& list) {
  return list_array(std::move(list), 1, 1);
}

template <class Row>
nb::tuple border(TileBorder<Row>&& found, std::size_t width) {
  return nb::make_tuple(found.count, list_array(std::move(found.keys), width),
                        list_array(std::move(found.labels)));
}

template <class Row>
nb::tuple points_tuple(TilePoints<Row>&& own) {
  return nb::make_tuple(columns_array(std::move(own.rows)), columns_array(std::move(own.points)),
                        columns_array(std::move(own.representative)));
}

template <std::size_t D>
TileBox<D> box_of(const Table& bounds) {
  if (bounds.shape(0) != 4 || bounds.shape(1) != D) {
    throw std::invalid_argument("bounds: not four corners");
  }
  TileBox<D> box;
  double* const to[4] = {box.low, box.high, box.near_low, box.near_high};
  for (std::size_t i = 0; i < 4; ++i) std::copy_n(bounds.data() + D * i, D, to[i]);
  return box;
}

// Values of vertices, none without weights.
template <class Row>
nb::object vertex_radii(TilePoints<Row>& own, bool weighted) {
  if (!weighted) return nb::none();
  return columns_array(std::move(own.vertex_radii));
}

// A number for each of n points, or null.
const double* optional_values(const nb::object& values, std::size_t n) {
  if (values.is_none()) return nullptr;
  const auto array = nb::cast<Values>(values);
  if (array.shape(0) != n) throw std::invalid_argument("not one value for each point");
  return array.data();
}

template <class Row>
nb::tuple tile2(const Points2& points, const nb::object& weights, const Rows<Row>& rows,
                const Table& bounds, double radius, int threads, const nb::object& progress) {
  const std::size_t n = points.shape(0);
  if (n > kMaxPoints2) throw TooManyPoints("at most 2^27 points");
  if (rows.shape(0) != n) throw std::invalid_argument("rows: not one for each point");
  const double *v = points.data(), *w = optional_values(weights, n);
  const TileBox<2> box = box_of<2>(bounds);
  Job job(useful_threads(threads, n));
  TilePoints<Row> own;
  TileShare2<Row> share;
  auto keep = [&](const Buffer<std::int32_t>& merged) {
    const TileVertices vertices{merged.data(), w == nullptr ? nullptr : share.vertex_radii.data(),
                                radius};
    own = tile_points(v, n, rows.data(), vertices, box);
  };
  run_watched(job, n, progress, [&] {
    SpatialOrder2 order = spatial_order2(v, n, job, w);
    if (w == nullptr) {
      Mesh2 mesh = delaunay2(order, job);
      share = tile_share2(v, rows.data(), order, mesh, box, radius, job);
      keep(order.representative);
    } else {
      const auto heavy = weighted(std::move(order), job);
      Mesh2 mesh = regular2(heavy, job);
      const Buffer<Role> role = roles_of(heavy, mesh, n, job);
      share = tile_share2(v, rows.data(), heavy, mesh, box, radius, {role.data(), w, n}, job);
      keep(heavy.representative);
    }
  });
  return nb::make_tuple(
      points_tuple(std::move(own)), columns_array(std::move(own.vertices)),
      vertex_radii(own, w != nullptr), columns_array(std::move(share.edges)),
      columns_array(std::move(share.edge_radii)), columns_array(std::move(share.edge_kinds)),
      columns_array(std::move(share.triangles)), columns_array(std::move(share.triangle_radii)),
      list_array(std::move(share.boundary), 3), list_array(std::move(share.boundary_regions)),
      list_array(std::move(share.region_sizes)), border(std::move(share.components), 1),
      border(std::move(share.regions), 3));
}

using Points3 = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Ids1 = nb::ndarray<const std::int32_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

template <class Row>
nb::tuple tile_share3_py(const Points3& points, std::size_t real, const Rows<Row>& rows,
                         const Ids1& representative, const nb::object& vertex_values,
                         const Ids& edges, const Values& edge_radii, const Ids& triangles,
                         const Values& triangle_radii, const Ids& triangle_tetrahedra,
                         const Ids& tetrahedra, const Values& tetrahedron_radii,
                         const Table& bounds, double radius, const nb::object& progress) {
  const std::size_t n = points.shape(0);
  if (rows.shape(0) != n || representative.shape(0) != n || real > n) {
    throw std::invalid_argument("rows: not one for each point");
  }
  const TileView3<Row> view{points.data(),
                            rows.data(),
                            n,
                            real,
                            edges.data(),
                            triangles.data(),
                            tetrahedra.data(),
                            edge_radii.data(),
                            triangle_radii.data(),
                            tetrahedron_radii.data(),
                            edges.shape(0),
                            triangles.shape(0),
                            tetrahedra.shape(0),
                            triangle_tetrahedra.data(),
                            representative.data(),
                            optional_values(vertex_values, n)};
  const TileBox<3> box = box_of<3>(bounds);
  Job job(1);
  TilePoints<Row> own;
  TileShare3<Row> share;
  run_watched(job, n, progress, [&] {
    share = tile_share3(view, box, radius, job);
    own = tile_points(points.data(), real, rows.data(), view.vertices(radius), box);
  });
  return nb::make_tuple(
      points_tuple(std::move(own)), columns_array(std::move(own.vertices)),
      vertex_radii(own, view.vertex_radii != nullptr), columns_array(std::move(share.edges)),
      columns_array(std::move(share.edge_radii)), columns_array(std::move(share.triangles)),
      columns_array(std::move(share.triangle_radii)),
      columns_array(std::move(share.triangle_kinds)), columns_array(std::move(share.tetrahedra)),
      columns_array(std::move(share.tetrahedron_radii)), list_array(std::move(share.boundary), 4),
      list_array(std::move(share.boundary_regions)), list_array(std::move(share.region_sizes)),
      border(std::move(share.components), 1), border(std::move(share.regions), 4),
      border(std::move(share.fronts), 4));
}

template <class Row>
void define_shares(nb::module_& m) {
  m.def("tile2", &tile2<Row>, nb::arg("points"), nb::arg("weights").none(),
        nb::arg("rows").noconvert(), nb::arg("bounds"), nb::arg("radius"), nb::arg("threads"),
        nb::arg("progress").none());
  m.def("tile_share3", &tile_share3_py<Row>, nb::arg("points"), nb::arg("real"),
        nb::arg("rows").noconvert(), nb::arg("representative"), nb::arg("vertex_radii").none(),
        nb::arg("edges"), nb::arg("edge_radii"), nb::arg("triangles"), nb::arg("triangle_radii"),
        nb::arg("triangle_tetrahedra"), nb::arg("tetrahedra"), nb::arg("tetrahedron_radii"),
        nb::arg("bounds"), nb::arg("radius"), nb::arg("progress").none());
}

nb::tuple spread_py(const Table& points, const Numbers& axes, const Values& low, const Values& high,
                    const Numbers& below, const Numbers& above, const nb::object& progress) {
  const std::size_t n = points.shape(0), dim = points.shape(1);
  const Cuts cuts{axes.data(), below.data(), above.data(), low.data(), high.data(), axes.shape(0)};
  Job job(1);
  Spread out;
  run_watched(job, n, progress, [&] { out = spread(points.data(), n, dim, cuts, job); });
  return nb::make_tuple(array(std::move(out.offsets)), array(std::move(out.rows)),
                        array(std::move(out.points), dim));
}

std::uint64_t checksum_py(const Bytes& bytes, std::uint64_t before) {
  const nb::gil_scoped_release released;
  return checksum(bytes.data(), bytes.shape(0), before);
}

// Bytes of any content, from the memory that kernels recycle.
nb::object memory(std::size_t size) { return array(Buffer<std::uint8_t>(size)); }

}  // namespace

void bind_tiles(nb::module_& m) {
  define_shares<std::int32_t>(m);
  define_shares<std::int64_t>(m);
  m.def("spread", &spread_py, nb::arg("points"), nb::arg("axes"), nb::arg("low"), nb::arg("high"),
        nb::arg("below"), nb::arg("above"), nb::arg("progress").none());
  m.def("checksum", &checksum_py, nb::arg("content"), nb::arg("before"));
  m.def("memory", &memory, nb::arg("size"));
  // While an object of this class lives, memory of kernels is kept for the next one.
  nb::class_<Recycling>(m, "Recycling").def(nb::init<>());
}

}  // namespace alphamesh
