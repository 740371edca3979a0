#include "insert2.hpp"

namespace alphamesh {

using Id = std::int32_t;

// One triangle and a ghost beyond each of its edges.
template <class S>
void Inserter2<S>::make_first(const Id* corner) {
  if (!provide(4)) throw std::bad_alloc();
  Id ghost[3];
  const Id t = new_triangle();
  for (Id& g : ghost) g = new_triangle();
  for (Id i = 0; i < 3; ++i) {
    at(t + i) = corner[i];
    at(ghost[i]) = corner[(i + 1) % 3];
    at(ghost[i] + 1) = corner[i];
    at(ghost[i] + 2) = Mesh2::kInfinity;
    link(t + i, ghost[i]);
    link(ghost[i] + 2, ghost[(i + 1) % 3] + 1);
  }
  here_ = t;
}

template <class S>
bool Inserter2<S>::has_start() {
  auto serves = [&](Id t) { return at(t) != Slots2<S>::kFree && owns_all(t); };
  if (here_ >= 0 && serves(here_)) return true;
  const auto used = static_cast<Id>(8 * s_.used.load());
  for (here_ = 0; here_ < used; here_ += 8) {
    if (serves(here_)) return true;
  }
  here_ = -1;
  return false;
}

// Makes sure that so many new triangles can be had.
template <class S>
bool Inserter2<S>::provide(std::size_t triangles) {
  while (free_.size() + (chunk_end_ - chunk_) < triangles) {
    while (chunk_ < chunk_end_) free_.push_back(static_cast<Id>(8 * chunk_++));
    const std::size_t begin = s_.used.fetch_add(kChunk);
    if (begin + kChunk > s_.room()) {
      s_.used.fetch_sub(kChunk);
      return false;
    }
    chunk_ = begin;
    chunk_end_ = begin + kChunk;
    for (std::size_t t = begin; t < chunk_end_; ++t) s_.m[8 * t] = Slots2<S>::kFree;
  }
  return true;
}

template <class S>
bool Inserter2<S>::take_free(Inserter2& other) {
  const std::size_t before = free_.size();
  free_.insert(free_.end(), other.free_.begin(), other.free_.end());
  other.free_.clear();
  while (other.chunk_ < other.chunk_end_) free_.push_back(static_cast<Id>(8 * other.chunk_++));
  return free_.size() > before;
}

template <class S>
Id Inserter2<S>::new_triangle() {
  Id t;
  if (free_.empty()) {
    t = static_cast<Id>(8 * chunk_++);
  } else {
    t = free_.back();
    free_.pop_back();
  }
  at(t + 3) = 0;
  return t;
}

template <class S>
bool Inserter2<S>::conflict(Id t, const Point& q) {
  if (is_ghost(t)) {
    const int side = orient(point(at(t)), point(at(t + 1)), q, s_.lattice);
    if (side != 0) return side > 0;
    // On the line of a hull edge, the power circle behind it cuts out the same as the edge's.
    t = Mesh2::base(twin(t));
  }
  return in_power_circle(point(at(t)), point(at(t + 1)), point(at(t + 2)), q, s_.lattice);
}

// A triangle in conflict with q, or why there is none. The walk across edges that q is beyond
// arrives, as it runs in a regular triangulation (Edelsbrunner 1990): at the triangle of q or
// at a ghost. If q is above the lifted triangle that it is in, it is hidden.
template <class S>
Id Inserter2<S>::locate(const Point& q) {
  Id t = is_ghost(here_) ? Mesh2::base(twin(here_)) : here_, entry = -1;
  while (owns_all(t)) {
    if (is_ghost(t)) return t;
    Id exit = -1;
    for (Id h = t; h < t + 3 && exit < 0; ++h) {
      if (h == entry) continue;
      const Id from = at(h), to = at(Mesh2::next(h));
      if (orient(point(from), point(to), q, s_.lattice) < 0) exit = h;
    }
    if (exit < 0) {
      here_ = t;
      return conflict(t, q) ? t : kHidden;
    }
    entry = twin(exit);
    t = Mesh2::base(entry);
  }
  return kForeign;
}

// All triangles in conflict with q, and the edges around them, counter-clockwise. False, and
// nothing changed, if one of them is not ours.
template <class S>
bool Inserter2<S>::collect(Id start, const Point& q) {
  cavity_.clear();
  border_.clear();
  auto take = [&](Id t) {
    at(t + 3) = 1;
    cavity_.reserve(1);
    cavity_.next() = t;
    cavity_.keep(true);
  };
  take(start);
  cross_.assign({start + 2, start + 1, start});
  while (!cross_.empty()) {
    const Id h = cross_.back(), g = twin(h), t = Mesh2::base(g);
    cross_.pop_back();
    if (at(t + 3) != 0) continue;
    if (!conflict(t, q)) {
      border_.reserve(1);
      border_.next() = {g, at(h), at(g), -1};
      border_.keep(true);
    } else if (owns_all(t)) {
      take(t);
      cross_.push_back(Mesh2::prev(g));
      cross_.push_back(Mesh2::next(g));
    } else {
      for (const Id mine : cavity_) at(mine + 3) = 0;
      return false;
    }
  }
  return true;
}

// Puts a triangle on each edge of the border; the slots of the cavity come first.
template <class S>
void Inserter2<S>::fill_star(Id v) {
  for (std::size_t k = 0; k < border_.size(); ++k) {
    Border& b = border_[k];
    const Id t = k < cavity_.size() ? cavity_[k] : new_triangle();
    at(t + 3) = 0;
    // The point at infinity comes last.
    b.made = t + (b.from == Mesh2::kInfinity ? 2 : b.to == Mesh2::kInfinity ? 1 : 0);
    at(b.made) = b.from;
    at(Mesh2::next(b.made)) = b.to;
    at(Mesh2::prev(b.made)) = v;
    link(b.made, b.outer);
  }
  Id last = border_[border_.size() - 1].made;
  for (const Border& b : border_) {
    link(Mesh2::next(last), Mesh2::prev(b.made));
    last = b.made;
  }
  for (std::size_t k = border_.size(); k < cavity_.size(); ++k) {
    at(cavity_[k]) = Slots2<S>::kFree;
    at(cavity_[k] + 3) = 0;
    free_.push_back(cavity_[k]);
  }
  here_ = Mesh2::base(last);
}

template <class S>
Inserted Inserter2<S>::insert(Id v) {
  const Point q = point(v);
  const Id start = locate(q);
  if (start == kHidden) return Inserted::kDone;
  if (start == kForeign || !collect(start, q)) return Inserted::kNotOurs;
  const std::size_t old = cavity_.size(), made = border_.size();
  if (made > old && !provide(made - old)) {
    for (const Id t : cavity_) at(t + 3) = 0;
    return Inserted::kNoRoom;
  }
  fill_star(v);
  return Inserted::kDone;
}

template class Inserter2<WeightedPlane>;
template class Inserter2<WeightedSheet>;

}  // namespace alphamesh
