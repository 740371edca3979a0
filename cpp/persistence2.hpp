// Persistent homology of a plane alpha filtration over Z/2, by union-find alone.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"
#include "rings2.hpp"

namespace alphamesh {

// Each pair is (creator, destroyer): a vertex and the edge that joins its component to an
// older one; an edge and the triangle that fills its loop. The vertex of `root` creates
// the component that stays.
struct Pairs2 {
  Buffer<std::int32_t> components;  // (k, 2): vertex row, edge
  Buffer<std::int32_t> loops;       // (k, 2): edge, triangle
};

// Components by Kruskal's order of the edges, loops by the same on the dual graph backwards
// (Delfinado & Edelsbrunner 1995; Edelsbrunner & Harer 2010, ch. VII): removing simplices
// from the whole plane, the triangles and the outside grow together across edges. Simplices
// of equal value are ordered by dimension, then by row. `births` are the values of the points,
// null if all are born at once.
Pairs2 persistence2(const ComplexView2& view, const double* births, const double* triangle_radii,
                    const double* edge_radii, Job& job);

}  // namespace alphamesh
