// The Delaunay triangulation of distinct points in space.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "memory.hpp"
#include "parallel.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {

// Tetrahedra with ghosts: beyond each facet of the hull lies one whose last vertex is the
// point at infinity, which is number n.
//
// Vertices are positively oriented, see orient3(). neighbor[i] = 4t + j is the facet on
// the other side of the facet opposite to vertex i, opposite to vertex j of t.
struct Tetrahedron {
  std::int32_t vertex[4];
  std::int32_t neighbor[4];
};

struct Mesh3 {
  Buffer<Tetrahedron> slot;
  std::size_t slots = 0;      // in use or free; free ones have vertex[0] = -1
  std::int32_t infinity = 0;  // = number of points
};

// Bowyer 1981 and Watson 1981, in a biased randomized insertion order (Amenta, Choi &
// Rote 2003) along a Hilbert curve. The result, up to the numbers of the slots, is the
// unique triangulation that in_sphere() defines.
//
// Threads work on parts of the curve (after Marot, Pellerin & Remacle 2019): each owns the
// points of its part, and replaces only tetrahedra whose finite vertices it all owns. Such
// a tetrahedron shares three vertices with each neighbour, at least two of them finite, so
// that no other thread can touch a neighbour either: nothing is shared, nothing is locked.
// Points whose cavity reaches further wait until the others are done.
//
// `span` comes from spanning_points(): four of them.
Mesh3 delaunay3(const SpatialOrder3& order, const std::vector<std::int32_t>& span, Job& job);

// The regular triangulation of weighted points, in the same way; its power tests see the points
// lifted to |p|^2 - weight. Points without a tetrahedron are hidden: some never enter, some are
// swallowed by the cavity of a heavier one. What is hidden by some points is hidden by more, so
// that neither order nor threads matter here either.
Mesh3 regular3(const SpatialOrder3& order, const std::vector<std::int32_t>& span, Job& job);

}  // namespace alphamesh
