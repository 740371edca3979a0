// The regular (weighted Delaunay) triangulation of distinct points in a plane, its
// filtration, and that of points on a line.
#pragma once

#include <cstddef>
#include <cstdint>

#include "delaunay2.hpp"
#include "memory.hpp"
#include "output2.hpp"
#include "parallel.hpp"
#include "power2.hpp"
#include "spatial_sort.hpp"
#include "vertex_rows.hpp"

namespace alphamesh {

// The weighted alpha filtration (Edelsbrunner 1995): a simplex enters with the power value
// of its orthocentre, |z - p|^2 - w, if no other point has a smaller power distance there
// (Gabriel), else with its first coface. All radii are signed roots of power values.
struct RegularFiltration2 {
  int dimension = -1;
  Filtration2 simplices;
  Buffer<std::int32_t> vertices;  // (V,), ascending
  Buffer<double> vertex_radii;    // (V,)
  Buffer<std::int32_t> hidden;    // (h,), ascending: points with an empty power cell
};

// A weighted cloud as it came: n rows. `representative` is null if all points are distinct.
struct WeightedRows {
  const double* weight;
  const std::int32_t* representative;
  std::size_t n;
};

// `order` has weights. S is Plane, or Sheet for a plane or line in space.
template <class S>
RegularFiltration2 regular_filtration2(SpatialOrder<S>&& order, const WeightedRows& rows, Job& job);

// The triangulation itself: Bowyer 1981 and Watson 1981 with power tests, in rounds along the
// curve as in delaunay3(), in parallel likewise. Points above the lower hull of the lifted
// cloud, |p|^2 - w, are in no triangle: hidden. Lifted points in one plane are told apart as
// by in_circle(), so that the result is unique; the order of its triangles, too, depends on
// the cloud alone. S is WeightedPlane or WeightedSheet.
template <class S>
Mesh2 regular2(const SpatialOrder<S>& order, Job& job);

// What each of n rows of the input is in that triangulation; attached if a neighbour takes its
// point into its own cell.
template <class S>
Buffer<Role> roles_of(const SpatialOrder<S>& order, const Mesh2& mesh, std::size_t n, Job& job);

}  // namespace alphamesh
