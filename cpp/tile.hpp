// What a tile's share is made of, in the plane and in space.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "disjoint_sets.hpp"
#include "memory.hpp"
#include "parallel.hpp"

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
    for (std::size_t k = 0; k < D; ++k)
      close = close | (p[k] <= near_low[k]) | (p[k] >= near_high[k]);
    return close;
  }
};

// Which points are vertices up to a radius. Without weights all that stand for themselves are,
// from zero on; with weights, `value` tells for each point since when, infinity or NaN if never.
struct TileVertices {
  const std::int32_t* representative;  // null if all points are distinct
  const double* value;                 // null without weights
  double radius;

  bool has(std::size_t i) const {
    if (value != nullptr) return value[i] <= radius;
    return 0.0 <= radius &&
           (representative == nullptr || representative[i] == static_cast<std::int32_t>(i));
  }
};

// The points of a tile, ascending by row, and for each the row that stands for it; those that
// are vertices, and with weights their values.
template <class Row>
struct TilePoints {
  Columns<Row> rows, representative, vertices;
  Columns<double> points, vertex_radii;
};

// `real` points.
template <class Row, std::size_t D>
TilePoints<Row> tile_points(const double* v, std::size_t real, const Row* rows,
                            const TileVertices& vertices, const TileBox<D>& box) {
  std::vector<std::uint8_t> inside(real);
  std::size_t count = 0;
  for (std::size_t i = 0; i < real; ++i) count += inside[i] = box.holds(v + D * i);
  const std::size_t valued = vertices.value == nullptr ? 0 : count;
  TilePoints<Row> out{{1, count}, {1, count}, {1, count}, {D, count}, {1, valued}};
  std::size_t to = 0;
  for (std::size_t i = 0; i < real; ++i) {
    if (inside[i] == 0) continue;
    const std::int32_t* stands = vertices.representative;
    out.rows.column(0)[to] = rows[i];
    out.representative.column(0)[to] = stands == nullptr ? rows[i] : rows[stands[i]];
    for (std::size_t k = 0; k < D; ++k) out.points.column(k)[to] = v[D * i + k];
    ++to;
    if (!vertices.has(i)) continue;
    if (valued != 0) out.vertex_radii.column(0)[out.vertices.count] = vertices.value[i];
    out.vertices.column(0)[out.vertices.count++] = rows[i];
  }
  out.rows.count = out.representative.count = out.points.count = count;
  out.vertex_radii.count = valued == 0 ? 0 : out.vertices.count;
  return out;
}

inline void join(DisjointSets& sets, std::int32_t i, std::int32_t j) {
  const std::int32_t a = sets.root(i), b = sets.root(j);
  if (a != b) sets.join(std::max(a, b), std::min(a, b));  // roots come first
}

// Numbers the parts that known points are in, and names those that other tiles may know.
template <class Row, class Known, class Shared>
TileBorder<Row> label_components(DisjointSets& sets, const Row* row, std::size_t n, Known&& known,
                                 Shared&& shared, const Job& job) {
  TileBorder<Row> border;
  Buffer<std::int32_t> label(n);
  for (std::size_t i = 0; i < n; ++i) {
    if ((i & 0xffff) == 0) job.poll();
    if (!known(i)) continue;
    const auto root = static_cast<std::size_t>(sets.root(static_cast<std::int32_t>(i)));
    label[i] = root == i ? border.count++ : label[root];
    if (!shared(i)) continue;
    border.keys.push_back(row[i]);
    border.labels.push_back(label[i]);
  }
  return border;
}

}  // namespace alphamesh
