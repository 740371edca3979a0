// The weighted alpha filtration of a cloud in space.
#pragma once

#include <cstddef>
#include <cstdint>

#include "output3.hpp"
#include "parallel.hpp"
#include "regular2.hpp"
#include "spatial_sort.hpp"
#include "vertex_rows.hpp"

namespace alphamesh {

// Simplices enter with the power value of their orthocentre, |z - p|^2 - w, if no other point has
// a smaller power there (Gabriel), else with their first coface (Edelsbrunner 1995). Radii are
// signed roots of power values.
struct RegularFiltration3 {
  int dimension = -1;
  Filtration3 simplices;
  VertexRows vertices;
};

// `order` has weights.
RegularFiltration3 regular_filtration3(const SpatialOrder3& order, const WeightedRows& rows,
                                       Job& job);

}  // namespace alphamesh
