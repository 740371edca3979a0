// What a tile's share is made of, in the plane and in space.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "disjoint_sets.hpp"
#include "memory.hpp"

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

// The points of a tile, ascending by row, and for each the lowest row of an equal one; the
// rows that stand for themselves are its vertices.
template <class Row>
struct TilePoints {
  Columns<Row> rows, representative, vertices;
  Columns<double> points;
};

// `real` points; `representative` may be null, if all are distinct.
template <class Row, std::size_t D>
TilePoints<Row> tile_points(const double* v, std::size_t real, const Row* rows,
                            const std::int32_t* representative, const TileBox<D>& box) {
  std::vector<std::uint8_t> inside(real);
  std::size_t count = 0;
  for (std::size_t i = 0; i < real; ++i) count += inside[i] = box.holds(v + D * i);
  TilePoints<Row> out{{1, count}, {1, count}, {1, count}, {D, count}};
  std::size_t to = 0;
  for (std::size_t i = 0; i < real; ++i) {
    if (inside[i] == 0) continue;
    const Row lowest = representative == nullptr ? rows[i] : rows[representative[i]];
    out.rows.column(0)[to] = rows[i];
    out.representative.column(0)[to] = lowest;
    if (lowest == rows[i]) out.vertices.column(0)[out.vertices.count++] = lowest;
    for (std::size_t k = 0; k < D; ++k) out.points.column(k)[to] = v[D * i + k];
    ++to;
  }
  out.rows.count = out.representative.count = out.points.count = count;
  return out;
}

inline void join(DisjointSets& sets, std::int32_t i, std::int32_t j) {
  const std::int32_t a = sets.root(i), b = sets.root(j);
  if (a != b) sets.join(std::max(a, b), std::min(a, b));  // roots come first
}

}  // namespace alphamesh
