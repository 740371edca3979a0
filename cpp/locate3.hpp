// Point location in space: which of some labelled tetrahedra hold a point.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"

namespace alphamesh {

// A finished triangulation, back from the caller, with a label for each tetrahedron.
struct LabelledSpace3 {
  const double* points;
  std::size_t n;
  const std::int32_t* tetrahedra;  // (T, 4), ascending
  std::size_t tetrahedron_count;
  const std::int32_t* triangle_tetrahedra;    // (F, 2), -1 where there is none
  const std::int32_t* tetrahedron_triangles;  // (T, 4): the triangle opposite to each vertex
  const std::int32_t* label;                  // (T,), below zero for none
};

struct Located3 {
  // (q,) the lowest label, not below zero, of the closed tetrahedra that hold the query;
  // -1 if there is none.
  Buffer<std::int32_t> label;
  // (q,) 1 inside of the union of the labelled tetrahedra, 0 on its boundary, -1 outside.
  Buffer<std::int8_t> side;
};

// Throws BadCoordinates, also where points and queries are too far apart in scale.
Located3 locate3(const LabelledSpace3& space, const double* queries, std::size_t q, Job& job);

}  // namespace alphamesh
