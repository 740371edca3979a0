#include "locate3.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <vector>

#include "predicates3.hpp"
#include "radix_sort.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {
namespace {

using Id = std::int32_t;
constexpr Id kNone = -1;

struct Answer {
  Id label = kNone;
  std::int8_t side = -1;
};

// Walks from tetrahedron to tetrahedron, always across a face that has the goal beyond it:
// none is met twice in a Delaunay triangulation (Edelsbrunner 1990; Devillers, Pion &
// Teillaud 2002).
class Walker {
 public:
  Walker(const LabelledSpace3& space, const double* points) : space_(space), points_(points) {}

  // Begins near `q`: at the nearest of a few tetrahedra (Mücke, Saias & Zhu 1999).
  void jump(Point3 q);
  Answer find(Point3 q);

 private:
  Point3 point(Id row) const {
    const double* p = points_ + 3 * static_cast<std::size_t>(row);
    return {p[0], p[1], p[2]};
  }
  const Id* vertices(Id t) const { return space_.tetrahedra + 4 * static_cast<std::size_t>(t); }
  Id beyond(Id t, int k) const {
    const Id face = space_.tetrahedron_triangles[4 * static_cast<std::size_t>(t) + k];
    const Id* both = space_.triangle_tetrahedra + 2 * static_cast<std::size_t>(face);
    return both[0] == t ? both[1] : both[0];
  }
  bool step(Point3 q);
  Answer answer();
  void spread();

  const LabelledSpace3& space_;
  const double* points_;
  Id at_ = 0, came_ = kNone;
  bool outside_ = false;
  int side_[4] = {};  // on which side of the faces opposite to its vertices the goal lies
  std::vector<Id> holding_;
  std::unordered_set<Id> met_;
};

void Walker::jump(Point3 q) {
  const std::size_t count = space_.tetrahedron_count;
  const auto samples = static_cast<std::size_t>(std::cbrt(static_cast<double>(count))) + 1;
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < samples; ++i) {
    const auto t = static_cast<Id>(count * i / samples);
    const double distance = norm(point(vertices(t)[0]) - q);
    if (distance < least) {
      least = distance;
      at_ = t;
    }
  }
}

// Moves on by one tetrahedron; false where the walk ends.
bool Walker::step(Point3 q) {
  const Id* v = vertices(at_);
  Point3 p[4] = {point(v[0]), point(v[1]), point(v[2]), point(v[3])};
  const int turn = orient3(p[0], p[1], p[2], p[3], Lattice3());
  for (int k = 0; k < 4; ++k) {
    const Id next = beyond(at_, k);
    if (came_ != kNone && next == came_) {
      side_[k] = 1;  // the walk has just crossed it
      continue;
    }
    const Point3 kept = p[k];
    p[k] = q;
    side_[k] = turn * orient3(p[0], p[1], p[2], p[3], Lattice3());
    p[k] = kept;
    if (side_[k] >= 0) continue;
    outside_ = next == kNone;
    if (outside_) return false;
    came_ = at_;
    at_ = next;
    return true;
  }
  return false;
}

Answer Walker::find(Point3 q) {
  came_ = kNone;
  outside_ = false;
  while (step(q)) {
  }
  return outside_ ? Answer() : answer();
}

Answer Walker::answer() {
  holding_.assign(1, at_);
  const auto zeros = std::count(side_, side_ + 4, 0);
  if (zeros == 1) {
    holding_.push_back(beyond(at_, static_cast<int>(std::find(side_, side_ + 4, 0) - side_)));
  } else if (zeros > 1) {
    spread();
  }
  Answer found;
  bool all = true;
  for (const Id t : holding_) {
    const Id label = t == kNone ? kNone : space_.label[t];
    if (label < 0) {
      all = false;
    } else if (found.label < 0 || label < found.label) {
      found.label = label;
    }
  }
  if (found.label >= 0) found.side = all ? 1 : 0;
  return found;
}

// The tetrahedra that share the edge or vertex on which the goal lies: neighbours of
// neighbours, over all faces that hold it. kNone is added where the hull holds it.
void Walker::spread() {
  Id on[2];
  int count = 0;
  for (int k = 0; k < 4; ++k) {
    if (side_[k] != 0) on[count++] = vertices(at_)[k];
  }
  if (count == 1) on[1] = on[0];
  met_.clear();
  met_.insert(at_);
  for (std::size_t i = 0; i < holding_.size(); ++i) {
    const Id t = holding_[i];
    if (t == kNone) continue;
    for (int k = 0; k < 4; ++k) {
      const Id v = vertices(t)[k];
      if (v == on[0] || v == on[1]) continue;
      const Id next = beyond(t, k);
      if (met_.insert(next).second) holding_.push_back(next);
    }
  }
}

// Queries along a curve, so that each is near the one before.
Buffer<std::uint64_t> curve_order(const double* queries, std::size_t m, Job& job) {
  double lo[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, width = 0.0;
  for (std::size_t i = 0; i < 3 * m; ++i) lo[i % 3] = std::min(lo[i % 3], queries[i]);
  for (std::size_t i = 0; i < 3 * m; ++i) width = std::max(width, queries[i] - lo[i % 3]);
  constexpr double kCells = (1 << Space::kBits) - 1;
  const double cells = width > 0.0 ? kCells / width : 0.0;
  Buffer<std::uint64_t> order(m);
  const Parts parts(m, job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      std::uint32_t cell[3];
      for (std::size_t k = 0; k < 3; ++k) {
        cell[k] =
            static_cast<std::uint32_t>(std::min(kCells, (queries[3 * i + k] - lo[k]) * cells));
      }
      order[i] = (std::uint64_t{Space::code(cell, Space::kBits)} << 32) | i;
    }
  });
  radix_sort(order, 3 * Space::kBits, job);
  return order;
}

Located3 locate(const LabelledSpace3& space, const double* points, const double* queries,
                std::size_t m, Job& job) {
  const Buffer<std::uint64_t> order = curve_order(queries, m, job);
  Located3 out{Buffer<Id>(m), Buffer<std::int8_t>(m)};
  const Parts parts(m, job, 1024);
  job.run(parts.count(), [&](std::size_t part) {
    Walker walker(space, points);
    Point3 before{};
    Answer found;
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      const auto row = std::size_t{static_cast<std::uint32_t>(order[i])};
      const Point3 q{queries[3 * row], queries[3 * row + 1], queries[3 * row + 2]};
      if (i == parts.begin(part)) {
        walker.jump(q);
        found = walker.find(q);
      } else if (!(q == before)) {
        job.poll();
        found = walker.find(q);
      }
      before = q;
      out.label[row] = found.label;
      out.side[row] = found.side;
    }
  });
  return out;
}

}  // namespace

Located3 locate3(const LabelledSpace3& space, const double* queries, std::size_t q, Job& job) {
  const bool in_range = range_exponent<Space>(space.points, space.n, job) == 0 &&
                        range_exponent<Space>(queries, q, job) == 0;
  if (space.tetrahedron_count == 0) {
    Located3 out{Buffer<Id>(q), Buffer<std::int8_t>(q)};
    std::fill(out.label.begin(), out.label.end(), kNone);
    std::fill(out.side.begin(), out.side.end(), std::int8_t{-1});
    return out;
  }
  if (in_range) return locate(space, space.points, queries, q, job);
  // Seldom: queries and points are brought into the range of exact products together.
  Buffer<double> both(3 * (space.n + q));
  std::copy(space.points, space.points + 3 * space.n, both.begin());
  std::copy(queries, queries + 3 * q, both.begin() + 3 * space.n);
  const PowerOfTwo factor(range_exponent<Space>(both.data(), space.n + q, job));
  for (double& v : both) v = factor * v;
  return locate(space, both.data(), both.data() + 3 * space.n, q, job);
}

}  // namespace alphamesh
