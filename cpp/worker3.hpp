// Insertion of points into a triangulation of space: the walk, the cavity, the star.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>
#include <vector>

#include "cloud3.hpp"
#include "delaunay3.hpp"
#include "memory.hpp"
#include "stack.hpp"

namespace alphamesh {

constexpr std::int32_t kMark =
    static_cast<std::int32_t>(0x80000000);  // in vertex[3]: in the cavity
constexpr std::int32_t kVertex = 0x7fffffff;
// (p, facet opposite to i) is positive if the tetrahedron with p in place of i is.
constexpr int kFacet[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

// What all workers share. In parallel, each keeps to its own tetrahedra; only the counter
// of slots is common.
template <class Cloud>
struct Store {
  Cloud cloud;
  std::int32_t infinity;
  Buffer<Tetrahedron> slot;
  Buffer<typename Cloud::Sphere> sphere;
  std::atomic<std::size_t> used{0};

  explicit Store(const SpatialOrder3& order)
      : cloud(order), infinity(static_cast<std::int32_t>(order.size)) {}

  void reserve(std::size_t slots) {
    if (slots <= slot.size()) return;
    if (slots >= std::size_t{1} << 29) throw std::bad_alloc();
    slot.grow(slots);
    sphere.grow(slots);
  }
};

// Inserts points numbered first_ ... last_ - 1.
template <class Cloud>
class Worker {
 public:
  using Id = std::int32_t;
  using Point = typename Cloud::Point;
  using Arm = typename Cloud::Arm;

  Worker(Store<Cloud>& store)
      : store_(store), local_(static_cast<std::size_t>(store.infinity) + 1) {
    std::fill(local_.begin(), local_.end(), -1);
    table_.resize(kTable * kTable);
  }

  void take_range(Id first, Id last);
  bool insert(Id point);
  bool out_of_room() const { return out_of_room_; }
  bool provide(std::size_t slots);
  Id new_slot();
  void start_at(Id t) { here_ = t; }
  bool has_start();

 private:
  struct Border {
    Id inner, outer;  // facet of the cavity, as 4t + i from either side
    Id vertex[3], local[3];
    Id made;
  };

  enum class Found { kConflict, kHidden, kNotOurs };

  static constexpr std::size_t kTable = 256;
  static constexpr std::size_t kChunk = 1024;

  Tetrahedron& tet(Id t) { return store_.slot[static_cast<std::size_t>(t)]; }
  Id vertex(Id t, int i) { return tet(t).vertex[i] & kVertex; }
  bool owns(Id v) const {
    const auto at = static_cast<std::uint32_t>(v - first_);
    return (at < static_cast<std::uint32_t>(last_ - first_)) | (v == store_.infinity);
  }
  bool owns_all(Id t) {
    const Id* v = tet(t).vertex;
    return owns(v[0]) & owns(v[1]) & owns(v[2]) & owns(v[3] & kVertex);
  }
  int infinite(Id t);
  bool conflict(Id t, Point q) {
    const Verdict v = test(store_.sphere[static_cast<std::size_t>(t)], q);
    if (v.value > v.bound) return true;
    if (v.value < -v.bound) return false;
    return conflict_exact(t, q, v);
  }
  bool conflict_exact(Id t, Point q, Verdict verdict);
  Found locate(Point q);
  Found locate_exactly(Point q);
  int way_out(Id t, Point q, int entry);
  bool collect(Id start, Point q);
  bool visit(Id t, Id i, Point q);
  void prefetch_around(Id code);
  void unmark();
  void number_vertices(Point q);
  void fill_star(Id point, Point q);
  void link_by_table();
  void link_by_sorting();

  Store<Cloud>& store_;
  Id first_ = 0, last_ = 0;
  Id here_ = -1;
  Id point_ = -1;  // that is being inserted
  bool out_of_room_ = false;
  std::uint32_t random_ = 12345;
  std::size_t chunk_ = 0, chunk_end_ = 0;
  std::vector<Id> free_;
  Stack<Id> cavity_;  // 4t + i: entered through facet i of t
  Stack<Border> border_;
  Stack<Arm> arm_;
  Buffer<Id> local_;
  std::vector<Id> table_;
  std::vector<std::pair<std::uint64_t, Id>> directed_;
};

}  // namespace alphamesh
