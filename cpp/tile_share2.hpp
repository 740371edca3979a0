// The simplices of a planar alpha complex that one tile owns, and how they hang together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "delaunay2.hpp"
#include "memory.hpp"
#include "parallel.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {

// Rows of a table, column by column: `room` apart, `count` in use.
template <class T>
struct Columns {
  Columns() = default;
  Columns(std::size_t columns, std::size_t rows)
      : values(columns * rows), width(columns), room(rows) {}
  T* column(std::size_t i) { return values.data() + i * room; }

  Buffer<T> values;
  std::size_t width = 1;
  std::size_t room = 0;
  std::size_t count = 0;
};

// Connected parts of what a tile knows, and those things that other tiles may know, too:
// their names, `width` rows of the cloud each, and their parts.
template <class Row>
struct TileBorder {
  std::int32_t count = 0;
  std::vector<Row> keys;
  std::vector<std::int32_t> labels;
};

// Points of the tile are those with low <= p < high; other tiles may know those with
// p <= near_low or p >= near_high.
template <std::size_t D>
struct TileBox {
  double low[D], high[D], near_low[D], near_high[D];

  bool holds(const double* p) const {
    bool in = true;
    for (std::size_t k = 0; k < D; ++k) in = in & (p[k] >= low[k]) & (p[k] < high[k]);
    return in;
  }
  bool near(const double* p) const {
    bool close = false;
    for (std::size_t k = 0; k < D; ++k) close = close | (p[k] <= near_low[k]) | (p[k] >= near_high[k]);
    return close;
  }
};

// Row is the type of rows of the whole cloud. A simplex belongs to the tile of its
// lexicographically first vertex; its rows ascend.
template <class Row>
struct TileShare2 {
  Columns<Row> vertices, edges, triangles;
  Columns<double> edge_radii, triangle_radii;
  Columns<std::int8_t> edge_kinds;      // SimplexKind: 1, and one more for each coface
  std::vector<std::int32_t> boundary;   // (b, 3), rows of the tile's input: an edge with its
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
