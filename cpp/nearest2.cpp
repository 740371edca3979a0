#include "nearest2.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "radix_sort.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {
namespace {

constexpr std::size_t kFan = 8;
constexpr std::size_t kMostLevels = 12;  // 8^12 segments
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Box2 joined(const Box2& a, const Box2& b) {
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}

Box2 box_of(const Segment2& s) { return joined({s.a, s.a}, {s.b, s.b}); }

Point2 middle(const Segment2& s) { return {0.5 * s.a.x + 0.5 * s.b.x, 0.5 * s.a.y + 0.5 * s.b.y}; }

// Where each level of boxes begins.
struct Levels {
  std::size_t first[kMostLevels + 1], count = 0;

  explicit Levels(std::size_t k) {
    first[0] = 0;
    do {
      k = (k + kFan - 1) / kFan;
      first[count + 1] = first[count] + k;
      ++count;
    } while (k > 1);
  }
  std::size_t size(std::size_t level) const { return first[level + 1] - first[level]; }
};

// The numbers 0 to n - 1 in Morton order of the points.
template <class PointOf>
Buffer<std::uint64_t> along_curve(std::size_t n, PointOf&& point_of, Job& job) {
  Buffer<std::uint64_t> words(n);
  if (n == 0) return words;
  Box2 box{point_of(0), point_of(0)};
  for (std::size_t i = 1; i < n; ++i) box = joined(box, {point_of(i), point_of(i)});
  constexpr double kCells = (1 << Plane::kBits) - 1;
  const double width = std::max(box.high.x - box.low.x, box.high.y - box.low.y);
  const double cells = width > 0.0 ? kCells / width : 0.0;
  const Parts parts(n, job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      const Point2 p = point_of(i);
      const std::uint32_t cell[2] = {
          static_cast<std::uint32_t>(std::min(kCells, (p.x - box.low.x) * cells)),
          static_cast<std::uint32_t>(std::min(kCells, (p.y - box.low.y) * cells))};
      words[i] = std::uint64_t{Plane::code(cell, Plane::kBits)} << 32 | i;
    }
  });
  radix_sort(words, 2 * Plane::kBits, job);
  return words;
}

double squared(Point2 p, Point2 q) {
  const double x = p.x - q.x, y = p.y - q.y;
  return x * x + y * y;
}

double squared(Point2 p, const Box2& b) {
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
double squared(Point2 p, const Segment2& s) {
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

// The best segment so far; of equally near ones, the first of the input.
struct Best {
  double sq = kInfinity;
  std::int32_t place = -1;
  std::size_t at = 0;
};

class Search {
 public:
  explicit Search(const SegmentTreeView2& tree) : tree_(tree), levels_(tree.size) {}

  // `guess` is a segment that may be near, to begin with.
  Best operator()(Point2 p, std::size_t guess) {
    Best best;
    try_segment(p, guess, best);
    open_.clear();
    open_.push_back({levels_.count - 1, 0, 0.0});
    while (!open_.empty()) {
      const Open node = open_.back();
      open_.pop_back();
      if (node.sq > best.sq) continue;
      const std::size_t begin = kFan * node.index;
      if (node.level == 0) {
        for (std::size_t i = begin; i < std::min(begin + kFan, tree_.size); ++i) {
          try_segment(p, i, best);
        }
      } else {
        push_children(p, node.level - 1, begin, best);
      }
    }
    return best;
  }

 private:
  struct Open {
    std::size_t level, index;
    double sq;
  };

  void try_segment(Point2 p, std::size_t i, Best& best) const {
    const double sq = squared(p, tree_.segments[i]);
    if (sq < best.sq || (sq == best.sq && tree_.place[i] < best.place)) {
      best = {sq, tree_.place[i], i};
    }
  }

  // The nearest child goes last, to be opened first.
  void push_children(Point2 p, std::size_t level, std::size_t begin, const Best& best) {
    const std::size_t bottom = open_.size();
    const std::size_t end = std::min(begin + kFan, levels_.size(level));
    for (std::size_t i = begin; i < end; ++i) {
      const double sq = squared(p, tree_.boxes[levels_.first[level] + i]);
      if (sq > best.sq) continue;
      open_.push_back({level, i, sq});
      for (std::size_t k = open_.size() - 1; k > bottom && open_[k - 1].sq < open_[k].sq; --k) {
        std::swap(open_[k - 1], open_[k]);
      }
    }
  }

  const SegmentTreeView2& tree_;
  Levels levels_;
  std::vector<Open> open_;
};

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

}  // namespace

std::size_t box_count2(std::size_t k) {
  const Levels levels(k);
  return levels.first[levels.count];
}

SegmentTree2 segment_tree2(const double* points, const std::int32_t* edges, std::size_t k,
                           Job& job) {
  auto segment = [&](std::size_t i) {
    const std::int32_t a = edges[2 * i], b = edges[2 * i + 1];
    return Segment2{{points[2 * a], points[2 * a + 1]}, {points[2 * b], points[2 * b + 1]}};
  };
  const Buffer<std::uint64_t> order =
      along_curve(k, [&](std::size_t i) { return middle(segment(i)); }, job);
  SegmentTree2 tree{Buffer<Segment2>(k), Buffer<std::int32_t>(k), Buffer<Box2>(box_count2(k))};
  const Levels levels(k);
  const Parts parts(levels.size(0), job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t node = parts.begin(part); node < parts.end(part); ++node) {
      for (std::size_t i = kFan * node; i < std::min(kFan * (node + 1), k); ++i) {
        tree.place[i] = static_cast<std::int32_t>(static_cast<std::uint32_t>(order[i]));
        tree.segments[i] = segment(static_cast<std::size_t>(tree.place[i]));
        const Box2 box = box_of(tree.segments[i]);
        tree.boxes[node] = i == kFan * node ? box : joined(tree.boxes[node], box);
      }
    }
  });
  for (std::size_t level = 1; level < levels.count; ++level) {
    const Box2* below = tree.boxes.data() + levels.first[level - 1];
    for (std::size_t node = 0; node < levels.size(level); ++node) {
      Box2 box = below[kFan * node];
      const std::size_t end = std::min(kFan * (node + 1), levels.size(level - 1));
      for (std::size_t i = kFan * node + 1; i < end; ++i) box = joined(box, below[i]);
      tree.boxes[levels.first[level] + node] = box;
    }
  }
  return tree;
}

Nearest2 nearest2(const SegmentTreeView2& tree, const double* queries, std::size_t q, Job& job) {
  Nearest2 out{Buffer<std::int32_t>(q), Buffer<Point2>(q), Buffer<double>(q)};
  auto query = [&](std::size_t i) { return Point2{queries[2 * i], queries[2 * i + 1]}; };
  const Buffer<std::uint64_t> order = along_curve(q, query, job);
  const Parts parts(q, job, 1024);
  job.run(parts.count(), [&](std::size_t part) {
    Search search(tree);
    std::size_t guess = 0;
    for (std::size_t k = parts.begin(part); k < parts.end(part); ++k) {
      if ((k & 0x3ff) == 0) job.poll();
      const std::size_t i = static_cast<std::uint32_t>(order[k]);
      const Best best = search(query(i), guess);
      guess = best.at;
      out.place[i] = best.place;
      out.point[i] = nearest_on(tree.segments[best.at], query(i), out.distance[i]);
    }
    job.advance(1.0 / static_cast<double>(parts.count()));
  });
  return out;
}

}  // namespace alphamesh
