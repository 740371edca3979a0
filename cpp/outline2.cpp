#include "outline2.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace alphamesh {
namespace {

using Id = std::int32_t;
constexpr std::size_t kPoll = 0xffff;

std::size_t at(Id i) { return static_cast<std::size_t>(i); }

// An edge of a region's border, seen from the region: it runs with the region on its left.
struct Side {
  Id from, to, region, edge;
};

// Calls found(edge, triangle, region) for each side in a range of edges.
template <class Found>
void for_sides(const ComplexView2& view, const Id* region, std::size_t begin, std::size_t end,
               Found&& found) {
  for (std::size_t e = begin; e < end; ++e) {
    const Id s = view.edge_triangles[2 * e], t = view.edge_triangles[2 * e + 1];
    const Id a = s < 0 ? -1 : region[s], b = t < 0 ? -1 : region[t];
    if (a == b) continue;
    if (a >= 0) found(e, at(s), a);
    if (b >= 0) found(e, at(t), b);
  }
}

Side side_of(const ComplexView2& view, std::size_t edge, std::size_t triangle, Id region) {
  const Id u = view.edges[2 * edge], v = view.edges[2 * edge + 1];
  const Id* row = view.triangles + 3 * triangle;
  const Id apex = row[0] != u ? row[0] : (row[1] != v ? row[1] : row[2]);
  const bool left = orient(view.point(u), view.point(v), view.point(apex), Lattice()) > 0;
  return left ? Side{u, v, region, static_cast<Id>(edge)}
              : Side{v, u, region, static_cast<Id>(edge)};
}

Buffer<Side> sides_of(const ComplexView2& view, const Id* region, Job& job) {
  const Parts parts(view.edge_count, job);
  std::vector<std::size_t> first(parts.count() + 1, 0);
  job.run(parts.count(), [&](std::size_t part) {
    std::size_t count = 0;
    for_sides(view, region, parts.begin(part), parts.end(part),
              [&](std::size_t, std::size_t, Id) { ++count; });
    first[part + 1] = count;
  });
  std::partial_sum(first.begin(), first.end(), first.begin());
  Buffer<Side> sides(first.back());
  job.run(parts.count(), [&](std::size_t part) {
    std::size_t next = first[part];
    for_sides(view, region, parts.begin(part), parts.end(part),
              [&](std::size_t e, std::size_t t, Id r) { sides[next++] = side_of(view, e, t, r); });
  });
  return sides;
}

// A side at a vertex: where its other end lies, and whether it leaves the vertex.
struct Spoke {
  Point2 end;
  Id region, side;
  bool leaves;
};

// Counter-clockwise around `centre`, from the direction of the x-axis, region by region.
struct Around {
  Point2 centre;
  bool lower(Point2 p) const { return p.y < centre.y || (p.y == centre.y && p.x < centre.x); }
  bool operator()(const Spoke& a, const Spoke& b) const {
    if (a.region != b.region) return a.region < b.region;
    if (lower(a.end) != lower(b.end)) return lower(b.end);
    return orient(centre, a.end, b.end, Lattice()) > 0;
  }
};

// Links the sides of one vertex. Those of a region alternate around it: one leaves, its
// fan of triangles follows, one arrives, a gap follows. A ring that arrives goes around
// the gap and leaves beyond it, so that each gap gets a ring of its own.
void link_spokes(Point2 centre, Spoke* begin, Spoke* end, Buffer<Id>& next) {
  std::sort(begin, end, Around{centre});
  for (Spoke *group = begin, *last; group != end; group = last) {
    last = std::find_if(group, end, [&](const Spoke& s) { return s.region != group->region; });
    for (Spoke* s = group; s != last; ++s) {
      if (s->leaves) continue;
      const Spoke* beyond = s + 1 == last ? group : s + 1;
      next[at(s->side)] = beyond->side;
    }
  }
}

// What leaves each vertex: nothing, one side, or several, kept apart by numbers of pinches.
struct Leaving {
  static constexpr Id kNone = -1;
  Buffer<Id> side;          // (n,): kNone, a side, or -2 - pinch
  std::vector<Id> pinches;  // vertices that several sides leave

  Leaving(std::size_t n, const Buffer<Side>& sides) : side(n) {
    std::fill(side.begin(), side.end(), kNone);
    for (std::size_t i = 0; i < sides.size(); ++i) {
      Id& s = side[at(sides[i].from)];
      if (s == kNone) {
        s = static_cast<Id>(i);
      } else if (s >= 0) {
        s = -2 - static_cast<Id>(pinches.size());
        pinches.push_back(sides[i].from);
      }
    }
  }
};

// The side that follows each side in its ring.
Buffer<Id> following(const ComplexView2& view, const Buffer<Side>& sides, const Job& job) {
  const Leaving leaving(view.n, sides);
  std::vector<std::size_t> first(leaving.pinches.size() + 1, 0);
  auto pinch = [&](Id row) { return -2 - leaving.side[at(row)]; };
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (const Id p = pinch(sides[i].from); p >= 0) first[at(p)] += 2;  // as many arrive
  }
  std::exclusive_scan(first.begin(), first.end(), first.begin(), std::size_t{0});
  std::vector<std::size_t> filled(first.begin(), first.end() - 1);
  Buffer<Spoke> spokes(first.back());
  Buffer<Id> next(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if ((i & kPoll) == 0) job.poll();
    const Side& s = sides[i];
    const Id side = static_cast<Id>(i), start = pinch(s.from), end = pinch(s.to);
    if (start >= 0) {
      spokes[filled[at(start)]++] = {view.point(s.to), s.region, side, true};
    }
    if (end >= 0) {
      spokes[filled[at(end)]++] = {view.point(s.from), s.region, side, false};
    } else {
      next[i] = leaving.side[at(s.to)];
    }
  }
  for (std::size_t p = 0; p < leaving.pinches.size(); ++p) {
    if ((p & kPoll) == 0) job.poll();
    link_spokes(view.point(leaving.pinches[p]), spokes.begin() + first[p],
                spokes.begin() + first[p + 1], next);
  }
  return next;
}

// A ring: its side that starts at the least vertex, its length, and what it bounds.
struct Ring {
  Id first;
  std::int64_t size;
  Id region;
  bool hole;
};

std::vector<Ring> rings_of(const ComplexView2& view, const Buffer<Side>& sides,
                           const Buffer<Id>& next, const Job& job) {
  std::vector<Ring> rings;
  std::vector<bool> seen(sides.size(), false);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if ((i & kPoll) == 0) job.poll();
    if (seen[i]) continue;
    Id before = static_cast<Id>(i), last = -1, first = -1;
    std::int64_t size = 0;
    Point2 least{};
    for (Id s = static_cast<Id>(i); !seen[at(s)]; s = next[at(s)], ++size) {
      seen[at(s)] = true;
      const Point2 p = view.point(sides[at(s)].from);
      if (first < 0 || p < least) {
        least = p;
        first = s;
        last = before;
      }
      before = s;
    }
    if (first == static_cast<Id>(i)) last = before;
    // A simple ring turns left at its least vertex if and only if it is counter-clockwise.
    const int turn =
        orient(view.point(sides[at(last)].from), least, view.point(sides[at(first)].to), Lattice());
    rings.push_back({first, size, sides[i].region, turn < 0});
  }
  return rings;
}

// Sorts by region, outer rings before holes; else keeps the order.
std::vector<Ring> by_region(const std::vector<Ring>& rings) {
  auto key = [](const Ring& r) { return 2 * at(r.region) + (r.hole ? 1 : 0); };
  std::size_t keys = 0;
  for (const Ring& r : rings) keys = std::max(keys, key(r) + 1);
  std::vector<std::size_t> place(keys + 1, 0);
  for (const Ring& r : rings) ++place[key(r) + 1];
  std::partial_sum(place.begin(), place.end(), place.begin());
  std::vector<Ring> sorted(rings.size());
  for (const Ring& r : rings) sorted[place[key(r)]++] = r;
  return sorted;
}

}  // namespace

Outlines2 outlines2(const ComplexView2& view, const std::int32_t* region, Job& job) {
  const Buffer<Side> sides = sides_of(view, region, job);
  const Buffer<Id> next = following(view, sides, job);
  const std::vector<Ring> rings = by_region(rings_of(view, sides, next, job));
  Outlines2 out;
  out.offset = Buffer<std::int64_t>(rings.size() + 1);
  out.region = Buffer<Id>(rings.size());
  out.hole = Buffer<bool>(rings.size());
  out.offset[0] = 0;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    out.offset[r + 1] = out.offset[r] + rings[r].size;
    out.region[r] = rings[r].region;
    out.hole[r] = rings[r].hole;
  }
  out.row = Buffer<Id>(sides.size());
  out.edge = Buffer<Id>(sides.size());
  const Parts parts(rings.size(), job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t r = parts.begin(part); r < parts.end(part); ++r) {
      Id s = rings[r].first;
      for (auto i = static_cast<std::size_t>(out.offset[r]),
                end = static_cast<std::size_t>(out.offset[r + 1]);
           i < end; ++i, s = next[at(s)]) {
        out.row[i] = sides[at(s)].from;
        out.edge[i] = sides[at(s)].edge;
      }
    }
  });
  return out;
}

}  // namespace alphamesh
