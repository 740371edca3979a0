// Insertion of weighted points into a triangulation of a plane: the walk, the cavity, the
// star. S is WeightedPlane or WeightedSheet.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

#include "delaunay2.hpp"
#include "memory.hpp"
#include "power2.hpp"
#include "stack.hpp"

namespace alphamesh {

// Triangles as in Mesh2, in slots some of which are free: vertex 0 of those is kFree. The
// spare number 8t + 3 is 1 while t is in a cavity. In parallel, each worker keeps to its
// own triangles; only the counter of slots is common.
template <class S>
struct Slots2 {
  static constexpr std::int32_t kFree = -2;
  static constexpr std::size_t kMost = std::size_t{1} << 28;

  const typename S::Point* p;
  Lattice lattice;
  Buffer<std::int32_t> m;
  std::atomic<std::size_t> used{0};

  std::size_t room() const { return m.size() / 8; }
  void reserve(std::size_t triangles) {
    if (triangles <= room()) return;
    if (triangles > kMost) throw std::bad_alloc();
    m.grow(8 * triangles);
  }
};

enum class Inserted { kDone, kNotOurs, kNoRoom };

// Inserts points numbered first ... last - 1 of take_range() where the cavity has no other
// finite vertices.
template <class S>
class Inserter2 {
 public:
  using Id = std::int32_t;
  using Point = typename S::Point;

  explicit Inserter2(Slots2<S>& slots) : s_(slots) {}

  void make_first(const Id* corner);  // three, counter-clockwise
  void take_range(Id first, Id last) {
    first_ = first;
    last_ = last;
  }
  // Neither while others work.
  bool has_start();
  bool take_free(Inserter2& other);  // slots; false if there are none
  // A point that is hidden is done, too.
  Inserted insert(Id point);

 private:
  struct Border {
    Id outer;     // the half-edge beyond
    Id from, to;  // seen from inside
    Id made;      // the half-edge of the new triangle
  };

  static constexpr Id kHidden = -1, kForeign = -2;
  static constexpr std::size_t kChunk = 1024;

  Id& at(Id h) { return s_.m[static_cast<std::size_t>(h)]; }
  Id twin(Id h) { return at(h + 4); }
  const Point& point(Id v) const { return s_.p[v]; }
  void link(Id h, Id g) {
    at(h + 4) = g;
    at(g + 4) = h;
  }
  bool is_ghost(Id t) { return at(t + 2) == Mesh2::kInfinity; }
  bool owns(Id v) const {
    const auto i = static_cast<std::uint32_t>(v - first_);
    return (i < static_cast<std::uint32_t>(last_ - first_)) | (v == Mesh2::kInfinity);
  }
  bool owns_all(Id t) { return owns(at(t)) & owns(at(t + 1)) & owns(at(t + 2)); }
  bool conflict(Id t, const Point& q);
  Id locate(const Point& q);
  bool collect(Id start, const Point& q);
  void fill_star(Id v);
  bool provide(std::size_t triangles);
  Id new_triangle();

  Slots2<S>& s_;
  Id first_ = 0, last_ = 0;
  Id here_ = -1;
  std::size_t chunk_ = 0, chunk_end_ = 0;
  std::vector<Id> free_;
  std::vector<Id> cross_;  // half-edges still to be crossed
  Stack<Id> cavity_;
  Stack<Border> border_;
};

}  // namespace alphamesh
