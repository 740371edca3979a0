// A set of whole numbers with its largest: one bit each, and a tree of 64-fold summaries.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#ifdef _MSC_VER
#include <intrin.h>
#endif

namespace alphamesh {

// A column of a matrix over Z/2 that others are added to (Bauer, Kerber, Reininghaus and
// Wagner, PHAT, Journal of Symbolic Computation 78 (2017): "bit tree").
class BitTree {
 public:
  explicit BitTree(std::size_t n) {
    do {
      n = (n + 63) / 64;
      levels_.emplace_back(n, 0);
    } while (n > 1);
  }

  // Adds a number that is not there, removes one that is.
  void flip(std::size_t i) {
    for (auto& level : levels_) {
      std::uint64_t& word = level[i >> 6];
      const std::uint64_t before = word;
      word ^= std::uint64_t{1} << (i & 63);
      if (before != 0 && word != 0) return;
      i >>= 6;
    }
  }

  // -1 if there is none.
  std::int64_t largest() const {
    if (levels_.back().empty() || levels_.back()[0] == 0) return -1;
    std::size_t i = 0;
    for (std::size_t k = levels_.size(); k-- > 0;) i = i << 6 | highest_bit(levels_[k][i]);
    return static_cast<std::int64_t>(i);
  }

 private:
  static std::size_t highest_bit(std::uint64_t word) {
#ifdef _MSC_VER
    unsigned long place;
    _BitScanReverse64(&place, word);
    return place;
#else
    return 63u - static_cast<std::size_t>(__builtin_clzll(word));
#endif
  }

  std::vector<std::vector<std::uint64_t>> levels_;  // the last has at most one word
};

}  // namespace alphamesh
