// Disjoint sets of numbers, by union-find.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "memory.hpp"

namespace alphamesh {

// Who becomes the root of a joined set is the caller's choice.
class DisjointSets {
 public:
  using Id = std::int32_t;

  explicit DisjointSets(std::size_t n) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  Id root(Id i) {
    while (parent_[static_cast<std::size_t>(i)] != i) {
      Id& p = parent_[static_cast<std::size_t>(i)];
      p = parent_[static_cast<std::size_t>(p)];  // path halving
      i = p;
    }
    return i;
  }
  void expect(Id i) const { prefetch(parent_.data() + i); }
  void join(Id young, Id old) { parent_[static_cast<std::size_t>(young)] = old; }

 private:
  Buffer<Id> parent_;
};

}  // namespace alphamesh
