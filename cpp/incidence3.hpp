// Faces of a filtration in space: which triangles bound a tetrahedron, which edges a triangle.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"

namespace alphamesh {

// What output3.hpp made, as it comes back from the caller. Rows ascend.
struct ComplexView3 {
  std::size_t n;                   // points
  const std::int32_t* tetrahedra;  // (T, 4)
  std::size_t tetrahedron_count;
  const std::int32_t* triangles;  // (F, 3)
  std::size_t triangle_count;
  const std::int32_t* triangle_tetrahedra;  // (F, 2)
  const std::int32_t* edges;                // (E, 2)
  std::size_t edge_count;
};

// (T, 4): the triangle opposite to each vertex of a row.
Buffer<std::int32_t> tetrahedron_triangles3(const ComplexView3& view, Job& job);

// (F, 3): the edge opposite to each vertex of a row; -1 where there is no such edge.
Buffer<std::int32_t> triangle_edges3(const ComplexView3& view, Job& job);

}  // namespace alphamesh
