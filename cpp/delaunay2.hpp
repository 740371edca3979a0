// The Delaunay triangulation of distinct points in a plane.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {

// A triangulation of the sphere: the triangles, and beyond each hull edge a ghost
// triangle whose last vertex is the point at infinity. n points that span anything at
// all have exactly 2n - 2 triangles, ghosts included, even when they are collinear.
//
// Triangle t occupies eight numbers: its vertices counter-clockwise at 8t ... 8t + 2, and
// at 8t + 4 ... 8t + 6 the half-edges beyond its edges. Half-edge h = 8t + i runs from
// vertex i to vertex i + 1; its origin is slot[h] and its twin slot[h + 4]. The two spare
// numbers, 8t + 3 and 8t + 7, serve the output.
struct Mesh2 {
  static constexpr std::int32_t kInfinity = -1;

  Buffer<std::int32_t> slot;
  std::size_t triangles = 0;  // ghosts included
  std::int32_t ghost = -1;    // half-edge 8t of some ghost

  static std::int32_t base(std::int32_t h) { return h & ~7; }
  // Without a branch, as which of the three it is cannot be predicted.
  static std::int32_t next(std::int32_t h) { return h + 1 - 3 * ((h >> 1) & 1); }
  static std::int32_t prev(std::int32_t h) { return h - 1 + 3 * (~(h | (h >> 1)) & 1); }

  std::int32_t origin(std::int32_t h) const { return slot[static_cast<std::size_t>(h)]; }
  std::int32_t twin(std::int32_t h) const { return slot[static_cast<std::size_t>(h) + 4]; }
  // Ghosts follow the hull counter-clockwise.
  std::int32_t ghost_after(std::int32_t g) const { return base(twin(g + 2)); }
  bool is_ghost(std::int32_t h) const {
    return slot[static_cast<std::size_t>(h | 7) - 5] == kInfinity;
  }
};

// Divide and conquer (Guibas & Stolfi 1985) along the cuts of the Morton order (after
// Dwyer 1987), on triangles with ghosts (Shewchuk 1996). The result is the unique
// triangulation that the symbolic perturbation of in_circle() defines. S is Plane, or Sheet
// for a plane in space.
template <class S>
Mesh2 delaunay2(SpatialOrder<S>& order, Job& job);

}  // namespace alphamesh
