// Python functions for periodic boxes.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "bindings.hpp"
#include "periodic_check.hpp"
#include "periodic_values.hpp"
#include "quotient.hpp"
#include "reach.hpp"
#include "site_mesh.hpp"
#include "sites.hpp"
#include "spatial_sort.hpp"
#include "windings.hpp"

namespace alphamesh {
namespace {

// Where all is degenerate, exact arithmetic takes a hundred times as long as the filters: such
// work is worth watching long before it is large.
constexpr std::size_t kPatience = 16;

using Rows3 = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Offsets = nb::ndarray<const std::int8_t, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Numbers = nb::ndarray<const std::int32_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

// The cells that have one of the first `base` sites, and how far the spheres of all these
// reach; see reach.hpp.
struct Star {
  Buffer<std::int32_t> cells;
  Reach reach;
};

template <int D>
Star star_of(const Sites& sites, const Span& span, std::size_t base, double heaviest, Job& job) {
  SiteMesh<D> mesh(sites, span);
  mesh.insert_all(job);
  std::vector<std::size_t> found;
  Star star;
  for (std::size_t c = 0; c < mesh.slots(); ++c) {
    const auto* v = mesh.cell(c).vertex;
    if (v[0] < 0) continue;
    const bool touches = std::any_of(
        v, v + D + 1, [&](std::int32_t i) { return static_cast<std::size_t>(i) < base; });
    if (!touches) continue;
    if (mesh.finite(c)) {
      found.push_back(c);
    } else {
      star.reach.open = true;
    }
  }
  star.cells = Buffer<std::int32_t>((D + 1) * found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto* v = mesh.cell(found[i]).vertex;
    std::copy(v, v + D + 1, &star.cells[(D + 1) * i]);
  }
  star.reach.add<D>(sites, star.cells.data(), found.size(), heaviest, job);
  return star;
}

nb::object three(const double* v) {
  Buffer<double> out(3);
  std::copy(v, v + 3, out.begin());
  return array(std::move(out));
}

// The dimension of the cloud; if it is not 0, tuples of sites; the box around the spheres of
// these cells, and whether the hull is met.
nb::tuple periodic_star(const Rows3& high, const Rows3& low, const Values& weights, double unit,
                        std::size_t base, const nb::object& progress) {
  const std::size_t n = high.shape(0);
  if (n > kMaxPoints3) throw TooManyPoints("at most 2^26 copies");
  Job job(1);
  Star star;
  int dimension = -1;
  run_watched(job, kPatience * n, progress, [&] {
    Sites sites(n);
    sites.set_unit(unit);
    double heaviest = -HUGE_VAL;
    for (std::size_t i = 0; i < n; ++i) {
      Dd position[3];
      for (std::size_t k = 0; k < 3; ++k) {
        position[k] = {high.data()[3 * i + k], low.data()[3 * i + k]};
      }
      sites.set(static_cast<std::int32_t>(i), position, weights.data()[i]);
      heaviest = std::max(heaviest, weights.data()[i]);
    }
    const Span span = span_of(sites, job);
    dimension = span.dimension;
    if (dimension == 1) star = star_of<1>(sites, span, base, heaviest, job);
    if (dimension == 2) star = star_of<2>(sites, span, base, heaviest, job);
    if (dimension == 3) star = star_of<3>(sites, span, base, heaviest, job);
  });
  const auto columns = static_cast<std::size_t>(std::max(1, dimension + 1));
  return nb::make_tuple(dimension, array(std::move(star.cells), columns), three(star.reach.lo),
                        three(star.reach.hi), star.reach.open);
}

PeriodicBox box_of(const Rows3& anchors, const Offsets& shifts, const nb::object& weights,
                   const Values& periods, int exponent) {
  if (periods.shape(0) != 3) throw nb::value_error("three periods");
  const double* w = weights.is_none() ? nullptr : nb::cast<Values>(weights).data();
  const double* side = periods.data();
  return {anchors.data(), shifts.data(), w, {side[0], side[1], side[2]}, exponent};
}

nb::object offsets_array(Buffer<std::int8_t>&& offsets, std::size_t vertices) {
  auto* owner = new Buffer<std::int8_t>(std::move(offsets));
  nb::capsule capsule(owner, [](void* p) noexcept { delete static_cast<Buffer<std::int8_t>*>(p); });
  const std::size_t shape[3] = {owner->size() / (3 * vertices), vertices, 3};
  return nb::cast(nb::ndarray<nb::numpy, std::int8_t>(owner->data(), 3, shape, capsule));
}

// Per dimension from 0 on: rows, offsets, faces, radii; then the cofaces of facets.
nb::tuple periodic_complex(const Numbers& rows, const Offsets& offsets, std::size_t base,
                           const Ids& cells, const Rows3& anchors, const Offsets& shifts,
                           const nb::object& weights, const Values& periods, int exponent,
                           int threads) {
  const std::size_t count = cells.shape(0), columns = cells.shape(1);
  if (columns < 2 || columns > 4) throw nb::value_error("cells of 2 to 4 vertices");
  const Copies copies{rows.data(), offsets.data(), base, anchors.shape(0)};
  const PeriodicBox box = box_of(anchors, shifts, weights, periods, exponent);
  Job job(useful_threads(threads, count));
  std::vector<Layer> layers;
  std::vector<Buffer<double>> radii;
  Buffer<std::int32_t> sides;
  run_watched(job, kPatience * count, nb::none(), [&] {
    if (columns == 2) layers = quotient<1>(copies, cells.data(), count, job);
    if (columns == 3) layers = quotient<2>(copies, cells.data(), count, job);
    if (columns == 4) layers = quotient<3>(copies, cells.data(), count, job);
    radii = periodic_radii(box, layers, job);
    sides = cofaces(layers.back(), columns, layers[columns - 2].count);
  });
  nb::list out;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    out.append(nb::make_tuple(array(std::move(layers[k].row), k + 1),
                              offsets_array(std::move(layers[k].offset), k + 1),
                              array(std::move(layers[k].face), k + 1), array(std::move(radii[k]))));
  }
  return nb::make_tuple(out, array(std::move(sides), 2));
}

// Per facet, see check_facets().
nb::object periodic_check(const Ids& cells, const Offsets& offsets, const Ids& faces,
                          const Ids& facet_cells, const Rows3& anchors, const Offsets& shifts,
                          const nb::object& weights, const Values& periods, int threads) {
  const std::size_t count = cells.shape(0), columns = cells.shape(1);
  const PeriodicCells view{cells.data(), offsets.data(),     faces.data(),
                           count,        facet_cells.data(), facet_cells.shape(0)};
  const PeriodicBox box = box_of(anchors, shifts, weights, periods, 0);
  Job job(useful_threads(threads, count));
  Buffer<std::int8_t> out;
  run_watched(job, kPatience * count, nb::none(), [&] {
    if (columns == 2) out = check_facets<1>(box, view, job);
    if (columns == 3) out = check_facets<2>(box, view, job);
    if (columns == 4) out = check_facets<3>(box, view, job);
  });
  return array(std::move(out));
}

// The part of each cell, -1 for none, and the rank of each part.
nb::tuple periodic_parts(const Offsets& second, const Ids& faces, const Ids& facet_cells,
                         const Flags& inside, const Flags& wall) {
  const BoxCells cells{second.data(),  faces.data(),       faces.shape(0),
                       faces.shape(1), facet_cells.data(), facet_cells.shape(0)};
  Job job(1);
  WoundParts out;
  run_watched(job, cells.count, nb::none(),
              [&] { out = wound_parts(cells, inside.data(), wall.data(), job); });
  return nb::make_tuple(array(std::move(out.part)), array(std::move(out.rank)));
}

}  // namespace

void bind_periodic(nb::module_& m) {
  m.def("periodic_star", &periodic_star, nb::arg("high"), nb::arg("low"), nb::arg("weights"),
        nb::arg("unit"), nb::arg("base"), nb::arg("progress").none());
  m.def("periodic_complex", &periodic_complex, nb::arg("rows"), nb::arg("offsets"), nb::arg("base"),
        nb::arg("cells"), nb::arg("anchors"), nb::arg("shifts"), nb::arg("weights").none(),
        nb::arg("periods"), nb::arg("exponent"), nb::arg("threads"));
  m.def("periodic_check", &periodic_check, nb::arg("cells"), nb::arg("offsets"), nb::arg("faces"),
        nb::arg("facet_cells"), nb::arg("anchors"), nb::arg("shifts"), nb::arg("weights").none(),
        nb::arg("periods"), nb::arg("threads"));
  m.def("periodic_parts", &periodic_parts, nb::arg("second"), nb::arg("faces"),
        nb::arg("facet_cells"), nb::arg("inside"), nb::arg("wall"));
}

}  // namespace alphamesh
