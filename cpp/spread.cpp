#include "spread.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

namespace alphamesh {

namespace {

// Points sent to tiles, in the order in which they came.
class Walk {
 public:
  static constexpr std::size_t kTogether = 16;

  Walk(const double* v, std::size_t n, std::size_t dim, const Cuts& cuts, std::int64_t* count)
      : v_(v), dim_(dim), nodes_(cuts.nodes), count_(count), tree_(2 * cuts.nodes + 1) {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    auto number = [&](std::int64_t child) {
      return static_cast<std::int32_t>(child < 0 ? -1 - child + static_cast<std::int64_t>(nodes_)
                                                 : child);
    };
    for (std::size_t i = 0; i < tree_.size(); ++i) {
      const auto self = static_cast<std::int32_t>(i);
      tree_[i] = {kInf, kInf, 0, {self, self}};
      if (i < nodes_) {
        tree_[i] = {cuts.low[i],
                    cuts.high[i],
                    static_cast<std::int32_t>(cuts.axes[i]),
                    {number(cuts.above[i]), number(cuts.below[i])}};
      }
    }
    depth_ = depth(0);
    reserve(n + n / 16 + 1);
  }

  // Walks down with some points at a time, as each step waits for memory, not for the
  // others. Those near to a cut go again, both ways.
  void send(std::size_t row, std::size_t count) {
    std::int32_t node[kTogether] = {};
    bool near[kTogether] = {};
    for (int step = 0; step < depth_; ++step) {
      for (std::size_t i = 0; i < count; ++i) {
        const Node& m = tree_[static_cast<std::size_t>(node[i])];
        const double at = v_[dim_ * (row + i) + static_cast<std::size_t>(m.axis)];
        const bool low = at < m.low;
        near[i] |= low & (at >= m.high);
        node[i] = m.child[low];
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      const auto at = static_cast<std::int32_t>(row + i);
      if (near[i]) {
        send_both_ways(0, at);
      } else {
        add(node[i], at);
      }
    }
  }

  std::size_t size() const { return size_; }
  std::size_t tile(std::size_t i) const { return static_cast<std::size_t>(entry_[2 * i]); }
  std::int32_t row(std::size_t i) const { return entry_[2 * i + 1]; }

 private:
  // A leaf, which is its own child, stands for a tile.
  struct Node {
    double low, high;
    std::int32_t axis, child[2];
  };

  int depth(std::size_t node) const {
    if (node >= nodes_) return 0;
    const Node& m = tree_[node];
    return 1 + std::max(depth(static_cast<std::size_t>(m.child[0])),
                        depth(static_cast<std::size_t>(m.child[1])));
  }

  void send_both_ways(std::int32_t node, std::int32_t row) {
    while (static_cast<std::size_t>(node) < nodes_) {
      const Node& m = tree_[static_cast<std::size_t>(node)];
      const double at = v_[dim_ * static_cast<std::size_t>(row) + static_cast<std::size_t>(m.axis)];
      const bool low = at < m.low;
      if (low & (at >= m.high)) send_both_ways(m.child[0], row);
      node = m.child[low];
    }
    add(node, row);
  }

  void reserve(std::size_t room) {
    entry_.grow(2 * room);
    room_ = room;
  }

  void add(std::int32_t leaf, std::int32_t row) {
    if (size_ == room_) reserve(room_ + room_ / 4 + 1);
    const std::int32_t tile = leaf - static_cast<std::int32_t>(nodes_);
    entry_[2 * size_] = tile;
    entry_[2 * size_ + 1] = row;
    ++size_;
    ++count_[tile];
  }

  const double* v_;
  std::size_t dim_, nodes_;
  std::int64_t* count_;
  std::vector<Node> tree_;
  int depth_ = 0;
  Buffer<std::int32_t> entry_;
  std::size_t size_ = 0, room_ = 0;
};

}  // namespace

Spread spread(const double* v, std::size_t n, std::size_t dim, const Cuts& cuts, Job& job) {
  Spread out;
  out.offsets = Buffer<std::int64_t>(cuts.nodes + 2);
  std::fill(out.offsets.begin(), out.offsets.end(), 0);
  Walk walk(v, n, dim, cuts, out.offsets.data() + 1);
  for (std::size_t i = 0; i < n; i += Walk::kTogether) {
    if ((i & 0xffff) == 0) job.poll();
    walk.send(i, std::min(Walk::kTogether, n - i));
  }
  for (std::size_t t = 1; t < out.offsets.size(); ++t) out.offsets[t] += out.offsets[t - 1];
  std::vector<std::int64_t> next(out.offsets.begin(), out.offsets.end());
  out.rows = Buffer<std::int32_t>(walk.size());
  out.points = Buffer<double>(dim * walk.size());
  for (std::size_t e = 0; e < walk.size(); ++e) {
    if ((e & 0xffff) == 0) job.poll();
    const auto to = static_cast<std::size_t>(next[walk.tile(e)]++);
    const double* p = v + dim * static_cast<std::size_t>(walk.row(e));
    out.rows[to] = walk.row(e);
    for (std::size_t k = 0; k < dim; ++k) out.points[dim * to + k] = p[k];
  }
  return out;
}

namespace {

// Each step can be undone, so that no word is without effect.
std::uint64_t step(std::uint64_t state, std::uint64_t word) {
  const std::uint64_t mixed = (state ^ word) * 0x9e3779b97f4a7c15U;  // odd: 2^64 / golden ratio
  return (mixed << 29) | (mixed >> 35);
}

}  // namespace

std::uint64_t checksum(const std::uint8_t* bytes, std::size_t n, std::uint64_t before) {
  constexpr std::size_t kLanes = 8, kWord = sizeof(std::uint64_t);
  std::uint64_t lane[kLanes];  // side by side, as a product takes a few cycles
  for (std::size_t k = 0; k < kLanes; ++k) lane[k] = k;
  std::size_t i = 0;
  for (; i + kLanes * kWord <= n; i += kLanes * kWord) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      std::uint64_t word;
      std::memcpy(&word, bytes + i + k * kWord, kWord);
      lane[k] = step(lane[k], word);
    }
  }
  std::uint64_t sum = step(before, n);
  for (const std::uint64_t part : lane) sum = step(sum, part);
  for (; i < n; i += kWord) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + i, n - i < kWord ? n - i : kWord);
    sum = step(sum, word);
  }
  return step(sum ^ (sum >> 32), 0);
}

}  // namespace alphamesh
