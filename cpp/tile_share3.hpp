// The simplices of an alpha complex in space that one tile owns, and how they hang together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "parallel.hpp"
#include "tile.hpp"

namespace alphamesh {

// The filtration of the points of a tile and its halo, and of a frame far around them: the
// points from `real` on. Rows of points in the whole cloud ascend.
template <class Row>
struct TileView3 {
  const double* points;
  const Row* rows;
  std::size_t n, real;
  const std::int32_t *edges, *triangles, *tetrahedra;
  const double *edge_radii, *triangle_radii, *tetrahedron_radii;
  std::size_t edge_count, triangle_count, tetrahedron_count;
  const std::int32_t* triangle_tetrahedra;
  const std::int32_t* representative;  // (n,)
  const double* vertex_radii;          // (n,) with weights, infinity for what is no vertex; or null

  TileVertices vertices(double radius) const { return {representative, vertex_radii, radius}; }
};

// See TileShare2.
template <class Row>
struct TileShare3 {
  Columns<Row> edges, triangles, tetrahedra;
  Columns<double> edge_radii, triangle_radii, tetrahedron_radii;
  Columns<std::int8_t> triangle_kinds;
  std::vector<std::int32_t> boundary;          // (b, 4), rows of the input: a triangle, counter-
                                               // clockwise from outside, and what is behind it
  std::vector<std::int32_t> boundary_regions;  // (b,)
  std::vector<double> region_sizes;
  TileBorder<Row> components, regions, fronts;
};

// Fronts are the parts of a small ball around a vertex of the tile that are not in the
// complex; those of two vertices are joined where a simplex of the complex that has both
// faces both (see tiles/fronts.py). Their keys are (a, b, c, side) for triangles and
// (a, b, -1, 0) for edges that are in no triangle.
template <class Row>
TileShare3<Row> tile_share3(const TileView3<Row>& view, const TileBox<3>& box, double radius,
                            Job& job);

}  // namespace alphamesh
