#include "nearest3.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "radix_sort.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {
namespace {

constexpr std::size_t kFan = 8;
constexpr std::size_t kMostLevels = 12;  // 8^12 triangles
constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Vector = Vector3<double>;

Box3 joined(const Box3& a, const Box3& b) {
  return {
      {std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z)},
      {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y), std::max(a.high.z, b.high.z)}};
}

Box3 box_of(const Triangle3& t) { return joined(joined({t.a, t.a}, {t.b, t.b}), {t.c, t.c}); }

// A corner of its box is as good as its middle, and needs no rounding.
Point3 place_of(const Triangle3& t) { return box_of(t).low; }

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

// The numbers 0 to n - 1 in Hilbert order of the points.
template <class PointOf>
Buffer<std::uint64_t> along_curve(std::size_t n, PointOf&& point_of, Job& job) {
  Buffer<std::uint64_t> words(n);
  if (n == 0) return words;
  Box3 box{point_of(0), point_of(0)};
  for (std::size_t i = 1; i < n; ++i) box = joined(box, {point_of(i), point_of(i)});
  constexpr double kCells = (1 << Space::kBits) - 1;
  const Vector size = box.high - box.low;
  const double width = std::max(size.x, std::max(size.y, size.z));
  const double cells = width > 0.0 ? kCells / width : 0.0;
  const Parts parts(n, job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      const Vector p = point_of(i) - box.low;
      const std::uint32_t cell[3] = {static_cast<std::uint32_t>(std::min(kCells, p.x * cells)),
                                     static_cast<std::uint32_t>(std::min(kCells, p.y * cells)),
                                     static_cast<std::uint32_t>(std::min(kCells, p.z * cells))};
      words[i] = std::uint64_t{Space::code(cell, Space::kBits)} << 32 | i;
    }
  });
  radix_sort(words, 3 * Space::kBits, job);
  return words;
}

double squared(const Vector& v) { return dot(v, v); }

double squared(Point3 p, const Box3& b) {
  const double x = std::max(0.0, std::max(b.low.x - p.x, p.x - b.high.x));
  const double y = std::max(0.0, std::max(b.low.y - p.y, p.y - b.high.y));
  const double z = std::max(0.0, std::max(b.low.z - p.z, p.z - b.high.z));
  return x * x + y * y + z * z;
}

// Seen from the nearer end, so that long segments are no less accurate than short ones.
double squared(Point3 p, Point3 a, Point3 b) {
  const Vector d = b - a, from_a = p - a, from_b = p - b;
  if (dot(from_a, d) <= 0.0) return squared(from_a);
  if (dot(from_b, d) >= 0.0) return squared(from_b);
  const double a_sq = squared(from_a), b_sq = squared(from_b);
  return squared(cross(d, a_sq < b_sq ? from_a : from_b)) / squared(d);
}

// The normal (b - a) x (c - a), computed again where it cancels.
Vector normal(const Triangle3& t) {
  const Vector u = t.b - t.a, v = t.c - t.a, n = cross(u, v);
  const bool thin = squared(n) < 0x1p-40 * squared(u) * squared(v);
  return thin ? normal_accurate(t.a, t.b, t.c) : n;
}

// Whether the foot of the perpendicular from p to the plane lies in the triangle (Ericson,
// Real-Time Collision Detection, 2005, section 5.1.5). Near its border it does not matter:
// the distances to the plane and to the side agree there.
bool above(Point3 p, const Triangle3& t, const Vector& n) {
  const Vector a = p - t.a, b = p - t.b, c = p - t.c;
  return dot(n, cross(t.b - t.a, a)) >= 0.0 && dot(n, cross(t.c - t.b, b)) >= 0.0 &&
         dot(n, cross(t.a - t.c, c)) >= 0.0 && squared(n) > 0.0;
}

double squared(Point3 p, const Triangle3& t) {
  const Vector n = normal(t);
  if (above(p, t, n)) {
    const double height = dot(n, p - t.a);
    return height / squared(n) * height;
  }
  return std::min(squared(p, t.a, t.b), std::min(squared(p, t.b, t.c), squared(p, t.c, t.a)));
}

Point3 moved(Point3 p, const Vector& v, double share) {
  return {p.x + share * v.x, p.y + share * v.y, p.z + share * v.z};
}

// The nearest point of a segment, and how far it is to about 2^-50 of the distance.
Point3 nearest_on(Point3 a, Point3 b, Point3 p, double& distance) {
  const Vector d = b - a, from_a = p - a, from_b = p - b;
  if (dot(from_a, d) <= 0.0 || dot(from_b, d) >= 0.0) {
    const bool at_a = dot(from_a, d) <= 0.0;
    distance = norm(at_a ? from_a : from_b);
    return at_a ? a : b;
  }
  distance = norm(normal_accurate(a, b, p)) / norm(d);
  if (distance == 0.0) return p;
  const bool nearer_a = squared(from_a) < squared(from_b);
  const double share = dot(nearer_a ? from_a : from_b, d) / squared(d);
  return moved(nearer_a ? a : b, d, share);
}

Point3 nearest_on(const Triangle3& t, Point3 p, double& distance) {
  const Vector n = normal(t);
  if (above(p, t, n)) {
    const double height = volume_accurate(t.a, t.b, t.c, p);
    distance = std::fabs(height) / norm(n);
    return moved(p, n, -height / squared(n));
  }
  Point3 best{};
  distance = kInfinity;
  const Point3 ends[4] = {t.a, t.b, t.c, t.a};
  for (int i = 0; i < 3; ++i) {
    double other;
    const Point3 q = nearest_on(ends[i], ends[i + 1], p, other);
    if (other < distance) {
      distance = other;
      best = q;
    }
  }
  return best;
}

// The best triangle so far; of equally near ones, the first of the input.
struct Best {
  double sq = kInfinity;
  std::int32_t place = -1;
  std::size_t at = 0;
};

class Search {
 public:
  explicit Search(const TriangleTreeView3& tree) : tree_(tree), levels_(tree.size) {}

  // `guess` is a triangle that may be near, to begin with.
  Best operator()(Point3 p, std::size_t guess) {
    Best best;
    try_triangle(p, guess, best);
    open_.clear();
    open_.push_back({levels_.count - 1, 0, 0.0});
    while (!open_.empty()) {
      const Open node = open_.back();
      open_.pop_back();
      if (node.sq > best.sq) continue;
      const std::size_t begin = kFan * node.index;
      if (node.level == 0) {
        for (std::size_t i = begin; i < std::min(begin + kFan, tree_.size); ++i) {
          if (squared(p, box_of(tree_.triangles[i])) <= best.sq) try_triangle(p, i, best);
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

  void try_triangle(Point3 p, std::size_t i, Best& best) const {
    const double sq = squared(p, tree_.triangles[i]);
    if (sq < best.sq || (sq == best.sq && tree_.place[i] < best.place)) {
      best = {sq, tree_.place[i], i};
    }
  }

  // The nearest child goes last, to be opened first.
  void push_children(Point3 p, std::size_t level, std::size_t begin, const Best& best) {
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

  const TriangleTreeView3& tree_;
  Levels levels_;
  std::vector<Open> open_;
};

}  // namespace

std::size_t box_count3(std::size_t k) {
  const Levels levels(k);
  return levels.first[levels.count];
}

TriangleTree3 triangle_tree3(const double* points, const std::int32_t* corners, std::size_t k,
                             Job& job) {
  auto point = [&](std::int32_t row) {
    const double* p = points + 3 * static_cast<std::size_t>(row);
    return Point3{p[0], p[1], p[2]};
  };
  auto triangle = [&](std::size_t i) {
    return Triangle3{point(corners[3 * i]), point(corners[3 * i + 1]), point(corners[3 * i + 2])};
  };
  const Buffer<std::uint64_t> order =
      along_curve(k, [&](std::size_t i) { return place_of(triangle(i)); }, job);
  TriangleTree3 tree{Buffer<Triangle3>(k), Buffer<std::int32_t>(k), Buffer<Box3>(box_count3(k))};
  const Levels levels(k);
  const Parts parts(levels.size(0), job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t node = parts.begin(part); node < parts.end(part); ++node) {
      for (std::size_t i = kFan * node; i < std::min(kFan * (node + 1), k); ++i) {
        tree.place[i] = static_cast<std::int32_t>(static_cast<std::uint32_t>(order[i]));
        tree.triangles[i] = triangle(static_cast<std::size_t>(tree.place[i]));
        const Box3 box = box_of(tree.triangles[i]);
        tree.boxes[node] = i == kFan * node ? box : joined(tree.boxes[node], box);
      }
    }
  });
  for (std::size_t level = 1; level < levels.count; ++level) {
    const Box3* below = tree.boxes.data() + levels.first[level - 1];
    Box3* here = tree.boxes.data() + levels.first[level];
    for (std::size_t i = 0; i < levels.size(level - 1); ++i) {
      here[i / kFan] = i % kFan == 0 ? below[i] : joined(here[i / kFan], below[i]);
    }
  }
  return tree;
}

Nearest3 nearest3(const TriangleTreeView3& tree, const double* queries, std::size_t q, Job& job) {
  auto query = [&](std::size_t i) {
    return Point3{queries[3 * i], queries[3 * i + 1], queries[3 * i + 2]};
  };
  const Buffer<std::uint64_t> order = along_curve(q, query, job);
  Nearest3 out{Buffer<std::int32_t>(q), Buffer<Point3>(q), Buffer<double>(q)};
  const Parts parts(q, job, 512);
  job.run(parts.count(), [&](std::size_t part) {
    Search search(tree);
    std::size_t guess = 0;
    for (std::size_t k = parts.begin(part); k < parts.end(part); ++k) {
      if ((k & 0x3ff) == 0) job.poll();
      const std::size_t i = static_cast<std::uint32_t>(order[k]);
      const Best best = search(query(i), guess);
      guess = best.at;
      out.place[i] = best.place;
      out.point[i] = nearest_on(tree.triangles[best.at], query(i), out.distance[i]);
    }
    job.advance(1.0 / static_cast<double>(parts.count()));
  });
  return out;
}

}  // namespace alphamesh
