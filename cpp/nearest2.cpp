#include "nearest2.hpp"

#include <algorithm>
#include <cmath>

#include "spatial_sort.hpp"

namespace alphamesh {
namespace {

Box2 joined(const Box2& a, const Box2& b) {
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}

Box2 box_of(const Segment2& s) { return joined({s.a, s.a}, {s.b, s.b}); }

Point2 middle(const Segment2& s) { return {0.5 * s.a.x + 0.5 * s.b.x, 0.5 * s.a.y + 0.5 * s.b.y}; }

double squared(Point2 p, Point2 q) {
  const double x = p.x - q.x, y = p.y - q.y;
  return x * x + y * y;
}

inline double squared(const Point2& p, const Box2& b) {
  const double x = std::max(0.0, std::max(b.low.x - p.x, p.x - b.high.x));
  const double y = std::max(0.0, std::max(b.low.y - p.y, p.y - b.high.y));
  return x * x + y * y;
}

// Whether the end `at` is the nearest point of its segment, where u + v is (p - at) . d
// and d leads to the other end; exact.
bool at_end(Point2 p, Point2 at, Point2 other, double u, double v) {
  const double along = u + v;
  if (std::fabs(along) > 0x1p-48 * (std::fabs(u) + std::fabs(v))) return along <= 0.0;
  return (u == 0.0 && v == 0.0) || dot(p, other, at, Lattice()) <= 0;
}

// Seen from the nearer end, so that long segments are no less accurate than short ones.
double squared(const Point2& p, const Segment2& s) {
  const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y;
  const double ax = p.x - s.a.x, ay = p.y - s.a.y, bx = p.x - s.b.x, by = p.y - s.b.y;
  if (at_end(p, s.a, s.b, ax * dx, ay * dy)) return ax * ax + ay * ay;
  if (at_end(p, s.b, s.a, -bx * dx, -by * dy)) return bx * bx + by * by;
  const bool from_a = std::fabs(ax) + std::fabs(ay) < std::fabs(bx) + std::fabs(by);
  const double u = dx * (from_a ? ay : by), v = dy * (from_a ? ax : bx);
  double cross = u - v;
  if (std::fabs(cross) < 0x1p-24 * (std::fabs(u) + std::fabs(v))) {
    cross = cross_accurate(s.a, s.b, p);
  }
  return cross / (dx * dx + dy * dy) * cross;
}

Point2 nearest_on(const Segment2& s, Point2 p, double& distance) {
  const bool at_a = dot(p, s.b, s.a, Lattice()) <= 0;
  if (at_a || dot(p, s.a, s.b, Lattice()) <= 0) {
    const Point2 end = at_a ? s.a : s.b;
    distance = std::hypot(p.x - end.x, p.y - end.y);
    return end;
  }
  const double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y, length_sq = dx * dx + dy * dy;
  distance = std::fabs(cross_accurate(s.a, s.b, p)) / std::sqrt(length_sq);
  if (distance == 0.0) return p;
  const Point2 end = squared(p, s.a) < squared(p, s.b) ? s.a : s.b;
  const double share = ((p.x - end.x) * dx + (p.y - end.y) * dy) / length_sq;
  return {end.x + share * dx, end.y + share * dy};
}

std::array<double, 2> place(Point2 p) { return {p.x, p.y}; }

struct Segments {
  using Point = Point2;
  using Item = Segment2;
  using Box = Box2;

  static Box box_of(const Item& item) { return alphamesh::box_of(item); }
  static Box joined(const Box& a, const Box& b) { return alphamesh::joined(a, b); }
  template <class T>
  static double squared(const Point& p, const T& what) {
    return alphamesh::squared(p, what);
  }
  static bool near(const Point&, const Item&, double) { return true; }
  static Point nearest_on(const Item& item, const Point& p, double& distance) {
    return alphamesh::nearest_on(item, p, distance);
  }
};

}  // namespace

SegmentTree2 segment_tree2(const double* points, const std::int32_t* edges, std::size_t k,
                           Job& job) {
  auto segment = [&](std::size_t i) {
    const std::int32_t a = edges[2 * i], b = edges[2 * i + 1];
    return Segment2{{points[2 * a], points[2 * a + 1]}, {points[2 * b], points[2 * b + 1]}};
  };
  const auto order =
      along_curve<Plane>(k, [&](std::size_t i) { return place(middle(segment(i))); }, job);
  return box_tree<Segments>(k, order, segment, job);
}

Nearest2 nearest2(const SegmentTreeView2& tree, const double* queries, std::size_t q, Job& job) {
  auto query = [&](std::size_t i) { return Point2{queries[2 * i], queries[2 * i + 1]}; };
  const auto order = along_curve<Plane>(q, [&](std::size_t i) { return place(query(i)); }, job);
  return nearest_items<Segments>(tree, q, order, query, 1024, job);
}

}  // namespace alphamesh
