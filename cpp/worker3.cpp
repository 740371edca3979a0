#include "worker3.hpp"

#include <cmath>

namespace alphamesh {

using Id = std::int32_t;

template <class Cloud>
void Worker<Cloud>::take_range(Id first, Id last) {
  first_ = first;
  last_ = last;
  out_of_room_ = false;
}

// Stands on a tetrahedron of its own, or finds one.
template <class Cloud>
bool Worker<Cloud>::has_start() {
  if (here_ >= 0 && tet(here_).vertex[0] >= 0 && owns_all(here_)) return true;
  const auto used = static_cast<Id>(store_.used.load());
  const Id from = static_cast<Id>(std::int64_t{used} * first_ / std::max(1, store_.infinity));
  for (Id i = 0; i < used; ++i) {
    const Id t = from + i < used ? from + i : from + i - used;
    if (tet(t).vertex[0] >= 0 && owns_all(t)) {
      here_ = t;
      return true;
    }
  }
  return false;
}

template <class Cloud>
Id Worker<Cloud>::new_slot() {
  if (!free_.empty()) {
    const Id t = free_.back();
    free_.pop_back();
    return t;
  }
  return static_cast<Id>(chunk_++);
}

// Makes sure that so many new slots can be had.
template <class Cloud>
bool Worker<Cloud>::provide(std::size_t slots) {
  while (free_.size() + (chunk_end_ - chunk_) < slots) {
    while (chunk_ < chunk_end_) free_.push_back(static_cast<Id>(chunk_++));
    const std::size_t begin = store_.used.fetch_add(kChunk);
    if (begin + kChunk > store_.slot.size()) {
      store_.used.fetch_sub(kChunk);
      out_of_room_ = true;
      return false;
    }
    chunk_ = begin;
    chunk_end_ = begin + kChunk;
    for (std::size_t t = begin; t < chunk_end_; ++t) store_.slot[t].vertex[0] = -1;
  }
  return true;
}

template <class Cloud>
int Worker<Cloud>::infinite(Id t) {
  for (int i = 0; i < 4; ++i) {
    if (vertex(t, i) == store_.infinity) return i;
  }
  return -1;
}

template <class Cloud>
bool Worker<Cloud>::conflict_exact(Id t, Point q, Verdict verdict) {
  const int ghost = infinite(t);
  Id v[4];
  for (int i = 0; i < 4; ++i) v[i] = i == ghost ? point_ : vertex(t, i);
  if (ghost < 0) return store_.cloud.in_sphere(v, point_, verdict);
  const int side = store_.cloud.orient(v);
  if (side != 0) return side > 0;
  // In the plane of a hull facet: inside its circle if inside the sphere behind it.
  return conflict(tet(t).neighbor[ghost] >> 2, q);
}

// The facet behind which q lies, by the largest distance in plain arithmetic; -1 if none.
template <class Cloud>
int Worker<Cloud>::way_out(Id t, Point q, int entry) {
  Vector3<double> d[4];
  for (int i = 0; i < 4; ++i) d[i] = store_.cloud.place(vertex(t, i)) - q;
  const Vector3<double> cd = cross(d[2], d[3]), ab = cross(d[0], d[1]);
  const double side[4] = {dot(d[1], cd), -dot(d[0], cd), dot(d[3], ab), -dot(d[2], ab)};
  int best = -1;
  double farthest = 0.0;
  for (int i = 0; i < 4; ++i) {
    if (i == entry || side[i] >= 0.0) continue;
    const Vector3<double>&a = d[kFacet[i][0]], &b = d[kFacet[i][1]], &c = d[kFacet[i][2]];
    const Vector3<double> n = cross(Vector3<double>{b.x - a.x, b.y - a.y, b.z - a.z},
                                    Vector3<double>{c.x - a.x, c.y - a.y, c.z - a.z});
    const double distance_sq = side[i] * side[i] / dot(n, n);
    if (!(distance_sq <= farthest)) {
      farthest = distance_sq;
      best = i;
    }
  }
  return best;
}

// Walks to a tetrahedron whose sphere contains q, or to one that contains q itself if that one's
// sphere does not: q is hidden then, and stays so whatever is inserted.
template <class Cloud>
typename Worker<Cloud>::Found Worker<Cloud>::locate(Point q) {
  Id t = here_;
  int entry = -1;
  for (int step = 0; step < 1000; ++step) {
    if (conflict(t, q)) {
      here_ = t;
      return Found::kConflict;
    }
    const int ghost = infinite(t);
    const int exit = ghost >= 0 ? ghost : way_out(t, q, entry);
    if (exit < 0) break;
    const Id code = tet(t).neighbor[exit];
    if (!owns_all(code >> 2)) return Found::kNotOurs;
    t = code >> 2;
    entry = code & 3;
  }
  here_ = t;
  return locate_exactly(q);
}

// The same with exact signs and random turns, which always arrives.
template <class Cloud>
typename Worker<Cloud>::Found Worker<Cloud>::locate_exactly(Point q) {
  while (!conflict(here_, q)) {
    int exit = infinite(here_);
    random_ = random_ * 1664525u + 1013904223u;
    for (int k = 0; exit < 0 && k < 4; ++k) {
      const int i = static_cast<int>((random_ >> 30) + static_cast<unsigned>(k)) & 3;
      Id v[4];
      for (int j = 0; j < 4; ++j) v[j] = j == i ? point_ : vertex(here_, j);
      if (store_.cloud.orient(v) < 0) exit = i;
    }
    if (exit < 0) return Found::kHidden;
    const Id t = tet(here_).neighbor[exit] >> 2;
    if (!owns_all(t)) return Found::kNotOurs;
    here_ = t;
  }
  return Found::kConflict;
}

// All tetrahedra whose spheres contain q, and the facets around them. False, and nothing
// changed, if one of them is not ours.
template <class Cloud>
bool Worker<Cloud>::collect(Id start, Point q) {
  cavity_.clear();
  border_.clear();
  cavity_.reserve(8);
  border_.reserve(8);
  tet(start).vertex[3] |= kMark;
  cavity_.next() = 4 * start;
  cavity_.keep(true);
  bool ours = visit(start, 0, q);
  for (std::size_t k = 0; ours && k < cavity_.size(); ++k) {
    if (k + 1 < cavity_.size()) prefetch_around(cavity_[k + 1]);
    cavity_.reserve(4);
    border_.reserve(4);
    const Id t = cavity_[k] >> 2, entry = cavity_[k] & 3;
    for (Id i = 1; i < 4; ++i) ours &= visit(t, (entry + i) & 3, q);
  }
  if (!ours) unmark();
  return ours;
}

// Looks across facet i of t, which is in the cavity. False if what lies there is in, too, but
// not ours.
template <class Cloud>
inline bool Worker<Cloud>::visit(Id t, Id i, Point q) {
  const Id code = tet(t).neighbor[i], u = code >> 2;
  if (tet(u).vertex[3] < 0) return true;
  if (!conflict(u, q)) {
    Border& b = border_.next();
    b.inner = 4 * t + i;
    b.outer = code;
    border_.keep(true);
    return true;
  }
  if (!owns_all(u)) return false;
  tet(u).vertex[3] |= kMark;
  cavity_.next() = code;
  cavity_.keep(true);
  return true;
}

template <class Cloud>
void Worker<Cloud>::prefetch_around(Id code) {
  const Id* around = tet(code >> 2).neighbor;
  for (Id i = 1; i < 4; ++i) {
    const auto u = static_cast<std::size_t>(around[(code + i) & 3] >> 2);
    prefetch(&store_.sphere[u]);
    prefetch(&store_.slot[u]);
  }
}

template <class Cloud>
void Worker<Cloud>::unmark() {
  for (const Id code : cavity_) tet(code >> 2).vertex[3] &= kVertex;
}

// Numbers the vertices of the border from 0 and sees them from q.
template <class Cloud>
void Worker<Cloud>::number_vertices(Point q) {
  arm_.clear();
  for (Border& b : border_) {
    arm_.reserve(3);
    const Id* v = tet(b.inner >> 2).vertex;
    for (int k = 0; k < 3; ++k) {
      b.vertex[k] = v[kFacet[b.inner & 3][k]] & kVertex;
      Id& local = local_[static_cast<std::size_t>(b.vertex[k])];
      const bool fresh = local < 0;
      local = fresh ? static_cast<Id>(arm_.size()) : local;
      arm_.next().vertex = b.vertex[k];
      arm_.keep(fresh);
      b.local[k] = local;
    }
  }
  for (Arm& a : arm_) {
    local_[static_cast<std::size_t>(a.vertex)] = -1;
    a = a.vertex == store_.infinity ? Cloud::infinite_arm(a.vertex) : store_.cloud.arm(a.vertex, q);
  }
}

// Puts a tetrahedron on each facet of the border; the slots of the cavity come first.
template <class Cloud>
void Worker<Cloud>::fill_star(Id point, Point q) {
  for (std::size_t k = 0; k < border_.size(); ++k) {
    Border& b = border_[k];
    b.made = k < cavity_.size() ? cavity_[k] >> 2 : new_slot();
    tet(b.made) = {{point, b.vertex[0], b.vertex[1], b.vertex[2]}, {b.outer, -1, -1, -1}};
    tet(b.outer >> 2).neighbor[b.outer & 3] = 4 * b.made;
    store_.sphere[static_cast<std::size_t>(b.made)] = sphere_of(
        q, arm_[static_cast<std::size_t>(b.local[0])], arm_[static_cast<std::size_t>(b.local[1])],
        arm_[static_cast<std::size_t>(b.local[2])]);
  }
  for (std::size_t k = border_.size(); k < cavity_.size(); ++k) {
    const Id t = cavity_[k] >> 2;
    tet(t).vertex[0] = -1;
    tet(t).vertex[3] = 0;
    free_.push_back(t);
  }
}

// Around the new point, facet i of a tetrahedron belongs to the directed edge from local
// vertex i + 1 to i + 2; the neighbour has the same edge the other way.
template <class Cloud>
void Worker<Cloud>::link_by_table() {
  for (const Border& b : border_) {
    for (int i = 0; i < 3; ++i) {
      const auto from = static_cast<std::size_t>(b.local[(i + 1) % 3]);
      const auto to = static_cast<std::size_t>(b.local[(i + 2) % 3]);
      table_[from * kTable + to] = 4 * b.made + i + 1;
    }
  }
  for (const Border& b : border_) {
    for (int i = 0; i < 3; ++i) {
      const auto from = static_cast<std::size_t>(b.local[(i + 1) % 3]);
      const auto to = static_cast<std::size_t>(b.local[(i + 2) % 3]);
      tet(b.made).neighbor[i + 1] = table_[to * kTable + from];
    }
  }
}

template <class Cloud>
void Worker<Cloud>::link_by_sorting() {
  directed_.clear();
  auto key = [](Id from, Id to) {
    return (std::uint64_t{static_cast<std::uint32_t>(from)} << 32) | static_cast<std::uint32_t>(to);
  };
  for (const Border& b : border_) {
    for (int i = 0; i < 3; ++i) {
      directed_.emplace_back(key(b.local[(i + 1) % 3], b.local[(i + 2) % 3]), 4 * b.made + i + 1);
    }
  }
  std::sort(directed_.begin(), directed_.end());
  for (const auto& [edge, code] : directed_) {
    const std::uint64_t reverse = edge << 32 | edge >> 32;
    const auto found =
        std::lower_bound(directed_.begin(), directed_.end(), std::make_pair(reverse, Id{0}));
    tet(code >> 2).neighbor[code & 3] = found->second;
  }
}

// False, and nothing changed, if the cavity is not all ours or room is lacking. A point that is
// hidden is done with.
template <class Cloud>
bool Worker<Cloud>::insert(Id point) {
  const Point q = store_.cloud.point(point);
  point_ = point;
  const Found found = locate(q);
  if (Cloud::kHides && found == Found::kHidden) return true;
  if (found == Found::kNotOurs || !collect(here_, q)) return false;
  const std::size_t old = cavity_.size(), made = border_.size();
  if (made > old && !provide(made - old)) {
    unmark();
    return false;
  }
  number_vertices(q);
  fill_star(point, q);
  if (arm_.size() <= kTable) {
    link_by_table();
  } else {
    link_by_sorting();
  }
  here_ = border_[0].made;
  return true;
}

template class Worker<PlainCloud3>;
template class Worker<WeightedCloud3>;

}  // namespace alphamesh
