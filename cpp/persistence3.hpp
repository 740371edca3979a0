// Persistent homology of an alpha filtration in space over Z/2.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"

namespace alphamesh {

// What output3.hpp and incidence3.hpp made, as it comes back from the caller.
struct FiltrationView3 {
  std::size_t n;              // points
  const double* births;       // their values; null if all are born at once
  const std::int32_t* edges;  // (E, 2) rows of points, ascending
  const double* edge_radii;
  std::size_t edge_count;
  const std::int32_t* triangle_edges;       // (F, 3)
  const std::int32_t* triangle_tetrahedra;  // (F, 2), -1 where there is none
  const double* triangle_radii;
  std::size_t triangle_count;
  const double* tetrahedron_radii;
  std::size_t tetrahedron_count;
};

// Each pair is (creator, destroyer).
struct Pairs3 {
  Buffer<std::int32_t> components;  // (k, 2): vertex row, edge
  Buffer<std::int32_t> loops;       // (k, 2): edge, triangle; ascending by edge in the filtration
  Buffer<std::int32_t> voids;       // (k, 2): triangle, tetrahedron
};

// Components and voids by union-find (Delfinado & Edelsbrunner 1995). That leaves the edges
// that join nothing and the triangles that close off nothing: they are paired by reducing
// the boundary matrix of those triangles, restricted to those edges ("clearing" of Chen &
// Kerber 2011 from both sides; Bauer, Kerber & Reininghaus 2014). Nine of ten columns need
// no addition. On a plane, loops are paired by union-find, too. Simplices of equal value
// are ordered by dimension, then by row.
Pairs3 persistence3(const FiltrationView3& view, Job& job);

}  // namespace alphamesh
