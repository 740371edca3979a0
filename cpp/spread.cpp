#include "spread.hpp"

#include <cstring>
#include <vector>

namespace alphamesh {

Spread spread(const double* v, std::size_t n, std::size_t dim, const Cuts& cuts, Job& job) {
  Spread out;
  out.offsets = Buffer<std::int64_t>(cuts.nodes + 2);
  std::fill(out.offsets.begin(), out.offsets.end(), 0);
  std::int64_t* count = out.offsets.data() + 1;
  struct Entry {
    std::int32_t tile, row;
  };
  std::vector<Entry> entries;
  entries.reserve(n + n / 8);
  std::vector<std::int64_t> waiting;
  for (std::size_t i = 0; i < n; ++i) {
    if ((i & 0xffff) == 0) job.poll();
    const double* p = v + dim * i;
    waiting.push_back(cuts.nodes == 0 ? -1 : 0);
    while (!waiting.empty()) {
      std::int64_t node = waiting.back();
      waiting.pop_back();
      while (node >= 0) {
        const double at = p[cuts.axes[node]];
        const bool low = at < cuts.low[node], high = at >= cuts.high[node];
        if (low & high) waiting.push_back(cuts.above[node]);
        node = low ? cuts.below[node] : cuts.above[node];
      }
      const auto tile = static_cast<std::int32_t>(-1 - node);
      ++count[tile];
      entries.push_back({tile, static_cast<std::int32_t>(i)});
    }
  }
  for (std::size_t t = 1; t < out.offsets.size(); ++t) out.offsets[t] += out.offsets[t - 1];
  std::vector<std::int64_t> next(out.offsets.begin(), out.offsets.end());
  out.rows = Buffer<std::int32_t>(entries.size());
  out.points = Buffer<double>(dim * entries.size());
  for (std::size_t e = 0; e < entries.size(); ++e) {
    if ((e & 0xffff) == 0) job.poll();
    const auto to = static_cast<std::size_t>(next[static_cast<std::size_t>(entries[e].tile)]++);
    const auto row = static_cast<std::size_t>(entries[e].row);
    out.rows[to] = entries[e].row;
    for (std::size_t k = 0; k < dim; ++k) out.points[dim * to + k] = v[dim * row + k];
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
