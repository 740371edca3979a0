#include "rings2.hpp"

#include <algorithm>
#include <cmath>

namespace alphamesh {
namespace {

using Id = std::int32_t;

// The position in the row `t` of the vertex that the edge (u, v) lacks, all ascending.
std::size_t opposite(const Id* t, Id u, Id v) { return t[0] != u ? 0 : (t[1] != v ? 1 : 2); }

// Around vertex k of triangle t: the edge at which the triangle begins, counter-clockwise,
// and the one at which it ends.
struct Corner {
  Id entry, exit;
};

Corner corner(const Id* triangle_edges, std::size_t t, std::size_t k, bool turned) {
  const Id* e = triangle_edges + 3 * t;
  const Id after = e[(k + 2) % 3], before = e[(k + 1) % 3];  // towards vertex k + 1, k + 2
  return turned ? Corner{before, after} : Corner{after, before};
}

// Rows ascend, so that a triangle may run clockwise: 1 if so.
Buffer<std::uint8_t> turned_triangles(const ComplexView2& view, Job& job) {
  Buffer<std::uint8_t> turned(view.triangle_count);
  const Parts parts(view.triangle_count, job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t t = parts.begin(part); t < parts.end(part); ++t) {
      const Id* v = view.triangles + 3 * t;
      turned[t] = orient(view.point(v[0]), view.point(v[1]), view.point(v[2]), Lattice()) < 0;
    }
  });
  return turned;
}

// For each vertex a triangle to begin with: on the hull the one that nothing precedes.
Buffer<Id> first_triangles(const ComplexView2& view, const Id* triangle_edges,
                           const Buffer<std::uint8_t>& turned) {
  Buffer<Id> first(view.n);
  std::fill(first.begin(), first.end(), -1);
  for (std::size_t t = 0; t < view.triangle_count; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      Id& f = first[static_cast<std::size_t>(view.triangles[3 * t + k])];
      const Corner c = corner(triangle_edges, t, k, turned[t] != 0);
      if (f < 0 || view.across(c.entry, static_cast<Id>(t)) < 0) f = static_cast<Id>(t);
    }
  }
  return first;
}

// Rows in the order in which edges, sorted in space, name them; merged ones come last.
Buffer<Id> spatial_order_of_rows(const ComplexView2& view) {
  Buffer<Id> order(view.n);
  Buffer<std::uint8_t> seen(view.n);
  std::fill(seen.begin(), seen.end(), std::uint8_t{0});
  std::size_t count = 0;
  for (std::size_t i = 0; i < 2 * view.edge_count; ++i) {
    const auto v = static_cast<std::size_t>(view.edges[i]);
    if (seen[v] != 0) continue;
    seen[v] = 1;
    order[count++] = view.edges[i];
  }
  for (std::size_t v = 0; v < view.n; ++v) {
    if (seen[v] == 0) order[count++] = static_cast<Id>(v);
  }
  return order;
}

void fill_paths(const ComplexView2& view, Rings2& rings) {
  Buffer<std::int64_t> next(view.n);
  std::copy(rings.offset.begin(), rings.offset.end() - 1, next.begin());
  for (std::size_t e = 0; e < view.edge_count; ++e) {
    for (std::size_t k = 0; k < 2; ++k) {
      const auto at =
          static_cast<std::size_t>(next[static_cast<std::size_t>(view.edges[2 * e + k])]++);
      rings.edge[at] = static_cast<Id>(e);
      rings.triangle[at] = -1;
    }
  }
}

}  // namespace

Buffer<std::int32_t> triangle_edges2(const ComplexView2& view, Job& job) {
  Buffer<Id> out(3 * view.triangle_count);
  const Parts parts(view.edge_count, job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t e = parts.begin(part); e < parts.end(part); ++e) {
      for (std::size_t k = 0; k < 2; ++k) {
        const Id t = view.edge_triangles[2 * e + k];
        if (t < 0) continue;
        const Id* row = view.triangles + 3 * static_cast<std::size_t>(t);
        out[3 * static_cast<std::size_t>(t) +
            opposite(row, view.edges[2 * e], view.edges[2 * e + 1])] = static_cast<Id>(e);
      }
    }
  });
  return out;
}

Rings2 rings2(const ComplexView2& view, const Buffer<std::int32_t>& triangle_edges, Job& job) {
  Rings2 rings;
  rings.offset = Buffer<std::int64_t>(view.n + 1);
  rings.edge = Buffer<Id>(2 * view.edge_count);
  rings.triangle = Buffer<Id>(2 * view.edge_count);
  std::fill(rings.offset.begin(), rings.offset.end(), 0);
  for (std::size_t i = 0; i < 2 * view.edge_count; ++i) {
    ++rings.offset[static_cast<std::size_t>(view.edges[i]) + 1];
  }
  for (std::size_t v = 0; v < view.n; ++v) rings.offset[v + 1] += rings.offset[v];
  rings.order = spatial_order_of_rows(view);
  if (view.triangle_count == 0) {
    fill_paths(view, rings);
    return rings;
  }
  const Buffer<std::uint8_t> turned = turned_triangles(view, job);
  const Buffer<Id> first = first_triangles(view, triangle_edges.data(), turned);
  const Parts parts(view.n, job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      const auto v = static_cast<std::size_t>(rings.order[i]);
      auto at = static_cast<std::size_t>(rings.offset[v]);
      const auto end = static_cast<std::size_t>(rings.offset[v + 1]);
      for (Id t = first[v]; at < end;) {
        const Id* row = view.triangles + 3 * static_cast<std::size_t>(t);
        const std::size_t k =
            row[0] == static_cast<Id>(v) ? 0 : (row[1] == static_cast<Id>(v) ? 1 : 2);
        const Corner c = corner(triangle_edges.data(), static_cast<std::size_t>(t), k,
                                turned[static_cast<std::size_t>(t)] != 0);
        rings.edge[at] = c.entry;
        rings.triangle[at++] = t;
        t = view.across(c.exit, t);
        if (t < 0) {  // the hull: the last edge has nothing after it
          rings.edge[at] = c.exit;
          rings.triangle[at++] = -1;
          break;
        }
      }
    }
  });
  return rings;
}

Buffer<Point2> circumcentres2(const ComplexView2& view, Job& job) {
  Buffer<Point2> out(view.triangle_count);
  const Parts parts(view.triangle_count, job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t t = parts.begin(part); t < parts.end(part); ++t) {
      // From the vertex opposite to the longest side, where nothing cancels; first in
      // lexicographic order, so that the result depends on the points alone.
      struct Ball : Point2 {
        double w;
      };
      Ball p[3];
      for (std::size_t k = 0; k < 3; ++k) {
        const Id row = view.triangles[3 * t + k];
        p[k] = {view.point(row), view.weight(row)};
      }
      std::sort(p, p + 3);
      double side[3];
      for (int k = 0; k < 3; ++k) {
        const Point2 q = p[(k + 1) % 3], r = p[(k + 2) % 3];
        side[k] = (q.x - r.x) * (q.x - r.x) + (q.y - r.y) * (q.y - r.y);
      }
      const auto k = static_cast<std::size_t>(std::max_element(side, side + 3) - side);
      const Ball a = p[k], b = p[(k + 1) % 3], c = p[(k + 2) % 3];
      const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
      const double b2 = bx * bx + by * by + (a.w - b.w), c2 = cx * cx + cy * cy + (a.w - c.w);
      const double det = 2.0 * cross_accurate(a, b, c);
      out[t] = {a.x + (b2 * (cy / det) - c2 * (by / det)),
                a.y + (c2 * (bx / det) - b2 * (cx / det))};
    }
  });
  return out;
}

}  // namespace alphamesh
