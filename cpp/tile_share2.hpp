// The simplices of a planar alpha complex that one tile owns, and how they hang together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "delaunay2.hpp"
#include "memory.hpp"
#include "parallel.hpp"
#include "spatial_sort.hpp"
#include "tile.hpp"

namespace alphamesh {

// Row is the type of rows of the whole cloud. A simplex belongs to the tile of its
// lexicographically first vertex; its rows ascend.
template <class Row>
struct TileShare2 {
  Columns<Row> edges, triangles;
  Columns<double> edge_radii, triangle_radii;
  Columns<std::int8_t> edge_kinds;             // SimplexKind: 1, and one more for each coface
  std::vector<std::int32_t> boundary;          // (b, 3), rows of the tile's input: an edge with its
                                               // triangle on the left, and the third corner
  std::vector<std::int32_t> boundary_regions;  // (b,)
  std::vector<double> region_sizes;
  TileBorder<Row> components, regions;
};

// `v` are the points that `order` and `mesh` were made of, `rows` their rows in the whole
// cloud, ascending. Simplices of a value above `radius` are not kept. Values and attachment
// are those of filtration2().
template <class Row>
TileShare2<Row> tile_share2(const double* v, const Row* rows, const SpatialOrder2& order,
                            Mesh2& mesh, const TileBox<2>& box, double radius, Job& job);

}  // namespace alphamesh
