// The boundary of some tetrahedra as a closed surface without singularities.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"

namespace alphamesh {

// A finished triangulation, back from the caller, and which of its tetrahedra are chosen.
struct Solid3 {
  const double* points;
  std::size_t n;
  const std::int32_t* tetrahedra;  // (T, 4), ascending
  std::size_t tetrahedron_count;
  const std::int32_t* triangles;  // (F, 3), ascending
  std::size_t triangle_count;
  const std::int32_t* triangle_tetrahedra;    // (F, 2), -1 where there is none
  const std::int32_t* tetrahedron_triangles;  // (T, 4): the triangle opposite to each vertex
  const bool* inside;                         // (T,)
};

// k facets, each a triangle with exactly one chosen tetrahedron.
struct Surface3 {
  Buffer<std::int32_t> triangle;  // (k,) its number, ascending
  Buffer<std::int32_t> corner;    // (k, 3) rows of points, seen from outside counter-clockwise
  Buffer<std::int32_t> across;    // (k, 3) the facet beyond the side opposite to each corner
  Buffer<std::int32_t> vertex;    // (k, 3) vertices: one for each fan of facets around a point
  Buffer<std::int32_t> row;       // (v,) row of points of each vertex, ascending
  Buffer<std::int32_t> shell;     // (k,) number of the connected component, by first facets
};

// Two facets meet at an edge if they bound the same wedge of chosen tetrahedra around it;
// but where two sheets are connected around both ends of the edge, so that they would
// share it, those meet that bound the same gap between them.
Surface3 surface3(const Solid3& solid, Job& job);

// Which shells enclose the region that they bound; the others are walls of its cavities.
// `shell`, `region` and `part` tell of each facet its shell, the region behind it and the
// part of the complement before it, all counted from 0; part 0 reaches to infinity.
Buffer<bool> outer_shells3(const std::int32_t* shell, const std::int32_t* region,
                           const std::int32_t* part, std::size_t k);

}  // namespace alphamesh
