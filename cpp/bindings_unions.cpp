// The seam to Python for the measures of unions of discs and of balls.
#include <nanobind/stl/optional.h>

#include <optional>
#include <vector>

#include "bindings.hpp"
#include "union2.hpp"
#include "union3.hpp"

namespace alphamesh {
namespace {

using Table = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using Rows = nb::ndarray<const std::int32_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

template <class Array>
auto data_or_null(const std::optional<Array>& array) {
  return array.has_value() ? array->data() : nullptr;
}

template <class Array>
std::vector<Array> all(const nb::tuple& arrays) {
  std::vector<Array> out;
  for (const nb::handle array : arrays) out.push_back(nb::cast<Array>(array));
  return out;
}

// `simplices` from edges on, `sides` from triangles on, `has` from vertices on.
template <UnionMeasures (*kMeasure)(const UnionView&, Job&)>
nb::tuple union_py(const Table& high, const std::optional<Table>& low,
                   const std::optional<Values>& weights, const std::optional<Rows>& row,
                   double power, const nb::tuple& simplices, const nb::tuple& sides,
                   const nb::tuple& has, const Ids& cofaces, const Rows& hole, std::size_t holes,
                   int threads, const nb::object& progress) {
  const auto corners = all<Ids>(simplices), faces = all<Ids>(sides);
  const auto there = all<Flags>(has);
  UnionView view{};
  Simplices* const layers[3] = {&view.edges, &view.triangles, &view.tetrahedra};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    *layers[k] = {corners[k].data(), k > 0 ? faces[k - 1].data() : nullptr, there[k + 1].data(),
                  corners[k].shape(0)};
  }
  view.has_vertex = there[0].data();
  view.centres = {high.data(),       data_or_null(low), data_or_null(weights),
                  data_or_null(row), there[0].shape(0), power};
  view.cofaces = cofaces.data();
  view.hole = hole.data();
  view.holes = holes;
  Job job(useful_threads(threads, view.centres.balls));
  UnionMeasures out;
  run_watched(job, hole.shape(0), progress, [&] { out = kMeasure(view, job); });
  return nb::make_tuple(out.content, array(std::move(out.contents)), array(std::move(out.borders)),
                        array(std::move(out.hole_contents)), array(std::move(out.hole_borders)));
}

template <class Function>
void define(nb::module_& m, const char* name, Function function) {
  m.def(name, function, nb::arg("high"), nb::arg("low").none(), nb::arg("weights").none(),
        nb::arg("row").none(), nb::arg("power"), nb::arg("simplices"), nb::arg("sides"),
        nb::arg("has"), nb::arg("cofaces"), nb::arg("hole"), nb::arg("holes"), nb::arg("threads"),
        nb::arg("progress").none());
}

}  // namespace

void bind_unions(nb::module_& m) {
  define(m, "union2", &union_py<union2>);
  define(m, "union3", &union_py<union3>);
}

}  // namespace alphamesh
