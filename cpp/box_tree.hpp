// A tree of boxes over items in spatial order, and the nearest of them; eight items share a
// box, eight boxes the next one, up to a single one, the last.
//
// What items are is told by a class Kind: its types Point, Item and Box, and its functions
// box_of(item), joined(box, box), squared(point, item or box), the distance squared,
// near(point, item, sq), whether an item is worth a look, nearest_on(item, point, distance).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "memory.hpp"
#include "parallel.hpp"
#include "radix_sort.hpp"

namespace alphamesh {

template <class Item, class Box>
struct BoxTree {
  Buffer<Item> items;          // in the order of a space-filling curve
  Buffer<std::int32_t> place;  // where each of them stood in the input
  Buffer<Box> boxes;           // level after level
};

// A tree as it comes back from the caller.
template <class Item, class Box>
struct BoxTreeView {
  const Item* items;
  const std::int32_t* place;
  std::size_t size;  // more than zero
  const Box* boxes;
};

template <class Point>
struct Nearest {
  Buffer<std::int32_t> place;  // (q,) the first of the nearest items, in input order
  Buffer<Point> point;         // (q,) the nearest point on it
  Buffer<double> distance;     // (q,) zero exactly on the item in the plane
};

// Where each level of boxes begins.
struct BoxLevels {
  static constexpr std::size_t kFan = 8;
  std::size_t first[13], count = 0;  // 8^12 items

  explicit BoxLevels(std::size_t k) {
    first[0] = 0;
    do {
      k = (k + kFan - 1) / kFan;
      first[count + 1] = first[count] + k;
      ++count;
    } while (k > 1);
  }
  std::size_t size(std::size_t level) const { return first[level + 1] - first[level]; }
};

// The number of boxes of a tree over k items.
inline std::size_t box_count(std::size_t k) {
  const BoxLevels levels(k);
  return levels.first[levels.count];
}

// The numbers 0 to n - 1 in the low halves of words, along a curve through places, which
// are arrays of N coordinates.
template <class Curve, class PlaceOf, std::size_t N = Curve::kDim>
Buffer<std::uint64_t> along_curve(std::size_t n, PlaceOf&& place_of, Job& job) {
  Buffer<std::uint64_t> words(n);
  if (n == 0) return words;
  std::array<double, N> low = place_of(0), high = low;
  for (std::size_t i = 1; i < n; ++i) {
    const std::array<double, N> p = place_of(i);
    for (std::size_t k = 0; k < N; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  constexpr double kCells = (1 << Curve::kBits) - 1;
  double width = 0.0;
  for (std::size_t k = 0; k < N; ++k) width = std::max(width, high[k] - low[k]);
  const double cells = width > 0.0 ? kCells / width : 0.0;
  const Parts parts(n, job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      const std::array<double, N> p = place_of(i);
      std::uint32_t cell[N];
      for (std::size_t k = 0; k < N; ++k) {
        cell[k] = static_cast<std::uint32_t>(std::min(kCells, (p[k] - low[k]) * cells));
      }
      words[i] = std::uint64_t{Curve::code(cell, Curve::kBits)} << 32 | i;
    }
  });
  radix_sort(words, N * Curve::kBits, job);
  return words;
}

// The tree of k items; item(i) makes one of them, `order` is along_curve of them.
template <class Kind, class ItemOf, class Item = typename Kind::Item,
          class Box = typename Kind::Box>
BoxTree<Item, Box> box_tree(std::size_t k, const Buffer<std::uint64_t>& order, ItemOf&& item,
                            Job& job) {
  constexpr std::size_t kFan = BoxLevels::kFan;
  BoxTree<Item, Box> tree{Buffer<Item>(k), Buffer<std::int32_t>(k), Buffer<Box>(box_count(k))};
  const BoxLevels levels(k);
  const Parts parts(levels.size(0), job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t node = parts.begin(part); node < parts.end(part); ++node) {
      for (std::size_t i = kFan * node; i < std::min(kFan * (node + 1), k); ++i) {
        tree.place[i] = static_cast<std::int32_t>(static_cast<std::uint32_t>(order[i]));
        tree.items[i] = item(static_cast<std::size_t>(tree.place[i]));
        const Box box = Kind::box_of(tree.items[i]);
        tree.boxes[node] = i == kFan * node ? box : Kind::joined(tree.boxes[node], box);
      }
    }
  });
  for (std::size_t level = 1; level < levels.count; ++level) {
    const Box* below = tree.boxes.data() + levels.first[level - 1];
    Box* here = tree.boxes.data() + levels.first[level];
    for (std::size_t i = 0; i < levels.size(level - 1); ++i) {
      here[i / kFan] = i % kFan == 0 ? below[i] : Kind::joined(here[i / kFan], below[i]);
    }
  }
  return tree;
}

template <class Kind>
class NearestSearch {
 public:
  using Point = typename Kind::Point;
  using View = BoxTreeView<typename Kind::Item, typename Kind::Box>;
  // The best item so far; of equally near ones, the first of the input.
  struct Best {
    double sq = std::numeric_limits<double>::infinity();
    std::int32_t place = -1;
    std::size_t at = 0;
  };

  explicit NearestSearch(const View& tree) : tree_(tree), levels_(tree.size) {}

  // `guess` is an item that may be near, to begin with.
  Best operator()(const Point& p, std::size_t guess) {
    Best best;
    try_item(p, guess, best);
    open_.clear();
    open_.push_back({levels_.count - 1, 0, 0.0});
    while (!open_.empty()) {
      const Open node = open_.back();
      open_.pop_back();
      if (node.sq > best.sq) continue;
      const std::size_t begin = BoxLevels::kFan * node.index;
      if (node.level == 0) {
        for (std::size_t i = begin; i < std::min(begin + BoxLevels::kFan, tree_.size); ++i) {
          if (Kind::near(p, tree_.items[i], best.sq)) try_item(p, i, best);
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

  void try_item(const Point& p, std::size_t i, Best& best) const {
    const double sq = Kind::squared(p, tree_.items[i]);
    if (sq < best.sq || (sq == best.sq && tree_.place[i] < best.place)) {
      best = {sq, tree_.place[i], i};
    }
  }

  // The nearest child goes last, to be opened first.
  void push_children(const Point& p, std::size_t level, std::size_t begin, const Best& best) {
    const std::size_t bottom = open_.size();
    const std::size_t end = std::min(begin + BoxLevels::kFan, levels_.size(level));
    for (std::size_t i = begin; i < end; ++i) {
      const double sq = Kind::squared(p, tree_.boxes[levels_.first[level] + i]);
      if (sq > best.sq) continue;
      open_.push_back({level, i, sq});
      for (std::size_t k = open_.size() - 1; k > bottom && open_[k - 1].sq < open_[k].sq; --k) {
        std::swap(open_[k - 1], open_[k]);
      }
    }
  }

  const View& tree_;
  BoxLevels levels_;
  std::vector<Open> open_;
};

// The nearest item of each of q queries; query(i) makes a point, `order` is along_curve of
// them, and `grain` how many are one task at least.
template <class Kind, class QueryOf, class Point = typename Kind::Point>
Nearest<Point> nearest_items(const BoxTreeView<typename Kind::Item, typename Kind::Box>& tree,
                             std::size_t q, const Buffer<std::uint64_t>& order, QueryOf&& query,
                             std::size_t grain, Job& job) {
  Nearest<Point> out{Buffer<std::int32_t>(q), Buffer<Point>(q), Buffer<double>(q)};
  const Parts parts(q, job, grain);
  job.run(parts.count(), [&](std::size_t part) {
    NearestSearch<Kind> search(tree);
    std::size_t guess = 0;
    for (std::size_t k = parts.begin(part); k < parts.end(part); ++k) {
      if ((k & 0x3ff) == 0) job.poll();
      const std::size_t i = static_cast<std::uint32_t>(order[k]);
      const Point p = query(i);
      const auto best = search(p, guess);
      guess = best.at;
      out.place[i] = best.place;
      out.point[i] = Kind::nearest_on(tree.items[best.at], p, out.distance[i]);
    }
    job.advance(1.0 / static_cast<double>(parts.count()));
  });
  return out;
}

}  // namespace alphamesh
