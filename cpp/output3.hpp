// From compact tetrahedra to flat arrays in the numbers of the input's rows.
#pragma once

#include <cstddef>
#include <cstdint>

#include "compact3.hpp"
#include "memory.hpp"
#include "output2.hpp"
#include "parallel.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {

// Rows of vertex numbers ascend. The order of the rows depends on the cloud alone.
struct Filtration3 {
  Buffer<std::int32_t> tetrahedra;           // (T, 4)
  Buffer<double> tetrahedron_radii;          // (T,)
  Buffer<std::int32_t> triangles;            // (F, 3)
  Buffer<double> triangle_radii;             // (F,)
  Buffer<std::int32_t> triangle_tetrahedra;  // (F, 2), -1 where there is none
  Buffer<std::int32_t> edges;                // (E, 2)
  Buffer<double> edge_radii;                 // (E,)
};

// That of a cloud in a plane: triangles without tetrahedra.
Filtration3 in_space(Filtration2&& flat);

// The alpha filtration (Edelsbrunner & Muecke 1994), see Filtration2.
Filtration3 filtration3(const SpatialOrder3& order, Compact3&& mesh, Job& job);
// The same by a rule, see rules3.hpp.
template <class Rule>
Filtration3 filtration3(const SpatialOrder3& order, Compact3&& mesh, Rule& rule, Job& job);

}  // namespace alphamesh
