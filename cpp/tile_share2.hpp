// The simplices of a planar alpha complex that one tile owns, and how they hang together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "delaunay2.hpp"
#include "memory.hpp"
#include "parallel.hpp"
#include "power2.hpp"
#include "spatial_sort.hpp"
#include "tile.hpp"
#include "vertex_rows.hpp"

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
  Buffer<double> vertex_radii;  // with weights: of each point of the input, infinity if it is no
                                // vertex of the tile up to the radius
};

// Role and weight of each of n points of the input.
struct TileWeights {
  const Role* role;
  const double* weight;
  std::size_t n;
};

// `v` are the points that `order` and `mesh` were made of, `rows` their rows in the whole
// cloud, ascending. Simplices of a value above `radius` are not kept. Values and attachment
// are those of filtration2().
template <class Row>
TileShare2<Row> tile_share2(const double* v, const Row* rows, const SpatialOrder2& order,
                            Mesh2& mesh, const TileBox<2>& box, double radius, Job& job);

// The same of a weighted cloud: of the mesh of regular2(), and with its values.
template <class Row>
TileShare2<Row> tile_share2(const double* v, const Row* rows,
                            const SpatialOrder<WeightedPlane>& order, Mesh2& mesh,
                            const TileBox<2>& box, double radius, const TileWeights& weights,
                            Job& job);

}  // namespace alphamesh
