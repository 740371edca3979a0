#include "locate2.hpp"

#include <algorithm>
#include <cmath>

#include "predicates2.hpp"
#include "radix_sort.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {
namespace {

using Id = std::int32_t;
constexpr Id kNone = -1;

// Walks from triangle to triangle, always across a side that has the goal beyond it: no
// triangle is met twice (Devillers, Pion & Teillaud 2002; Edelsbrunner 1990).
class Walker {
 public:
  Walker(const TriangulationView2& view, const double* points) : view_(view), points_(points) {}

  // Begins near `q`: at the nearest of a few triangles (Mücke, Saias & Zhu 1999).
  void jump(Point2 q);
  // The lowest triangle that holds `q`, or -1.
  Id find(Point2 q);

 private:
  Point2 point(Id row) const { return {points_[2 * row], points_[2 * row + 1]}; }
  const Id* vertices(Id t) const { return view_.triangles + 3 * static_cast<std::size_t>(t); }
  const Id* neighbors(Id t) const { return view_.neighbors + 3 * static_cast<std::size_t>(t); }
  bool step(Point2 q);
  Id lowest() const;
  Id lowest_around(int corner) const;

  const TriangulationView2& view_;
  const double* points_;
  Id at_ = 0, came_ = kNone;
  bool outside_ = false;
  int side_[3] = {};  // on which side of the sides opposite to its corners the goal lies
};

void Walker::jump(Point2 q) {
  const std::size_t count = view_.triangle_count;
  const auto samples = static_cast<std::size_t>(std::cbrt(static_cast<double>(count))) + 1;
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < samples; ++i) {
    const auto t = static_cast<Id>(count * i / samples);
    const Point2 p = point(vertices(t)[0]);
    const double distance = (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y);
    if (distance < least) {
      least = distance;
      at_ = t;
    }
  }
}

// Moves on by one triangle; false where the walk ends.
bool Walker::step(Point2 q) {
  const Id* v = vertices(at_);
  const Id* next = neighbors(at_);
  const Point2 p[3] = {point(v[0]), point(v[1]), point(v[2])};
  const int turn = orient(p[0], p[1], p[2], Lattice());
  for (int k = 0; k < 3; ++k) {
    if (came_ != kNone && next[k] == came_) {
      side_[k] = 1;  // the walk has just crossed it
      continue;
    }
    side_[k] = turn * orient(p[(k + 1) % 3], p[(k + 2) % 3], q, Lattice());
    if (side_[k] >= 0) continue;
    outside_ = next[k] == kNone;
    if (outside_) return false;
    came_ = at_;
    at_ = next[k];
    return true;
  }
  return false;
}

Id Walker::find(Point2 q) {
  came_ = kNone;
  outside_ = false;
  while (step(q)) {
  }
  return outside_ ? kNone : lowest();
}

Id Walker::lowest() const {
  int zeros = 0, last = 0, sum = 0;
  for (int k = 0; k < 3; ++k) {
    if (side_[k] != 0) continue;
    ++zeros;
    last = k;
    sum += k;
  }
  if (zeros == 0) return at_;
  if (zeros == 2) return lowest_around(3 - sum);
  const Id other = neighbors(at_)[last];
  return other == kNone ? at_ : std::min(at_, other);
}

// Turns around a corner of the triangle, first one way, and where that ends at the hull
// also the other way.
Id Walker::lowest_around(int corner) const {
  const Id row = vertices(at_)[corner];
  Id best = at_;
  for (int way = 1; way <= 2; ++way) {
    Id t = at_, next = neighbors(at_)[(corner + way) % 3];
    while (next != kNone && next != at_) {
      best = std::min(best, next);
      const Id* v = vertices(next);
      const Id* n = neighbors(next);
      const int k = v[0] == row ? 0 : (v[1] == row ? 1 : 2);
      const Id beyond = n[(k + 1) % 3] == t ? n[(k + 2) % 3] : n[(k + 1) % 3];
      t = next;
      next = beyond;
    }
    if (next == at_) break;
  }
  return best;
}

// Queries in the order of a lawn mower, so that each is near the one before.
Buffer<std::uint64_t> mowing_order(const double* queries, std::size_t m, Job& job) {
  double lo[2] = {HUGE_VAL, HUGE_VAL}, hi[2] = {-HUGE_VAL, -HUGE_VAL};
  for (std::size_t i = 0; i < 2 * m; ++i) {
    lo[i % 2] = std::min(lo[i % 2], queries[i]);
    hi[i % 2] = std::max(hi[i % 2], queries[i]);
  }
  int bits = 1;
  while (bits < 15 && (std::size_t{1} << (2 * bits + 2)) < m) ++bits;
  const std::uint32_t last = (1u << bits) - 1;
  double scale[2];
  for (int k = 0; k < 2; ++k)
    scale[k] = hi[k] > lo[k] ? std::ldexp(1.0, bits) / (hi[k] - lo[k]) : 0.0;
  auto cell = [&](std::size_t i, std::size_t k) {
    return std::min(last, static_cast<std::uint32_t>((queries[2 * i + k] - lo[k]) * scale[k]));
  };
  Buffer<std::uint64_t> order(m);
  const Parts parts(m, job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      const std::uint32_t column = cell(i, 0), row = cell(i, 1);
      const std::uint32_t key = (row << bits) | ((row & 1u) != 0 ? last - column : column);
      order[i] = (std::uint64_t{key} << 32) | i;
    }
  });
  radix_sort(order, 2 * bits, job);
  return order;
}

Buffer<Id> locate(const TriangulationView2& view, const double* points, const double* queries,
                  std::size_t m, Job& job) {
  const Buffer<std::uint64_t> order = mowing_order(queries, m, job);
  Buffer<Id> out(m);
  const Parts parts(m, job, 1024);
  job.run(parts.count(), [&](std::size_t part) {
    Walker walker(view, points);
    Point2 before{};
    Id found = kNone;
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      const auto row = static_cast<std::uint32_t>(order[i]);
      const Point2 q{queries[2 * std::size_t{row}], queries[2 * std::size_t{row} + 1]};
      if (i == parts.begin(part)) {
        walker.jump(q);
        found = walker.find(q);
      } else if (!(q == before)) {
        job.poll();
        found = walker.find(q);
      }
      before = q;
      out[row] = found;
    }
  });
  return out;
}

}  // namespace

Buffer<std::int32_t> locate2(const TriangulationView2& view, const double* queries, std::size_t m,
                             Job& job) {
  const bool in_range = range_exponent<Plane>(view.points, view.n, job) == 0 &&
                        range_exponent<Plane>(queries, m, job) == 0;
  if (view.triangle_count == 0) {
    Buffer<Id> out(m);
    std::fill(out.begin(), out.end(), kNone);
    return out;
  }
  if (in_range) return locate(view, view.points, queries, m, job);
  // Seldom: queries and points are brought into the range of exact products together.
  Buffer<double> both(2 * (view.n + m));
  std::copy(view.points, view.points + 2 * view.n, both.begin());
  std::copy(queries, queries + 2 * m, both.begin() + 2 * view.n);
  const PowerOfTwo factor(range_exponent<Plane>(both.data(), view.n + m, job));
  for (double& v : both) v = factor * v;
  return locate(view, both.data(), both.data() + 2 * view.n, m, job);
}

}  // namespace alphamesh
