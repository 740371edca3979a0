#include "pairing.hpp"

#include <algorithm>
#include <cstring>

#include "disjoint_sets.hpp"
#include "radix_sort.hpp"

namespace alphamesh {
namespace {

using Id = std::int32_t;

// Bits of a double, in its order: those of negative ones are turned around, and lie below.
std::uint64_t bits_of(double v) {
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63;
  const double plain = v + 0.0;  // no negative zero
  std::uint64_t b;
  std::memcpy(&b, &plain, sizeof b);
  return (b & kSign) == 0 ? b | kSign : ~b;
}

constexpr std::size_t kPoll = 0xffff;

// Rows come in no order that a cache would know: they are asked for so many steps ahead,
// and what they name half as many. On a million points this saves a third of the time.
constexpr std::size_t kAhead = 32;

struct Found {
  Buffer<Id> pairs;
  std::size_t count = 0;

  explicit Found(std::size_t most) : pairs(2 * most) {}
  void add(Id creator, Id destroyer) {
    pairs[2 * count] = creator;
    pairs[2 * count++ + 1] = destroyer;
  }
  Buffer<Id> trimmed() const {
    Buffer<Id> out(2 * count);
    std::copy(pairs.data(), pairs.data() + 2 * count, out.begin());
    return out;
  }
};

}  // namespace

Buffer<std::uint64_t> ascending(const double* value, std::size_t n, Job& job) {
  Buffer<std::uint64_t> words(n);
  if (n == 0) return words;
  const auto range = std::minmax_element(value, value + n);
  const std::uint64_t least = bits_of(*range.first), span = bits_of(*range.second) - least;
  int shift = 0;
  while ((span >> shift) > 0xffffffffu) ++shift;
  const Parts parts(n, job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      words[i] = ((bits_of(value[i]) - least) >> shift << 32) | i;
    }
  });
  radix_sort(words, 32, job);
  // Values that agree in the bits that were sorted by.
  auto less = [&](std::uint64_t a, std::uint64_t b) {
    const std::uint32_t i = row_of(a), j = row_of(b);
    return value[i] != value[j] ? value[i] < value[j] : i < j;
  };
  for (std::size_t i = 0, j; i < n; i = j) {
    for (j = i + 1; j < n && (words[j] >> 32) == (words[i] >> 32);) ++j;
    if (shift > 0 && j > i + 1 && !std::is_sorted(words.begin() + i, words.begin() + j, less)) {
      std::sort(words.begin() + i, words.begin() + j, less);
    }
  }
  return words;
}

Buffer<Id> pair_components(std::size_t n, const double* births, const Id* edges,
                           const Buffer<std::uint64_t>& order, const Job& job) {
  DisjointSets sets(n);
  Found found(n);
  auto younger = [&](Id a, Id b) {
    if (births != nullptr && births[a] != births[b]) return births[a] > births[b];
    return a > b;
  };
  for (std::size_t i = 0; i < order.size(); ++i) {
    if ((i & kPoll) == 0) job.poll();
    if (i + kAhead < order.size()) {
      prefetch(edges + 2 * std::size_t{row_of(order[i + kAhead])});
      const Id* soon = edges + 2 * std::size_t{row_of(order[i + kAhead / 2])};
      sets.expect(soon[0]);
      sets.expect(soon[1]);
    }
    const std::size_t e = row_of(order[i]);
    const Id a = sets.root(edges[2 * e]), b = sets.root(edges[2 * e + 1]);
    if (a == b) continue;
    const Id young = younger(a, b) ? a : b;
    sets.join(young, young == a ? b : a);
    found.add(young, static_cast<Id>(e));
  }
  return found.trimmed();
}

Buffer<Id> pair_hollows(const Id* cofaces, const Buffer<std::uint64_t>& order,
                        const double* cell_radii, std::size_t cells, const Job& job) {
  const auto outside = static_cast<Id>(cells);
  DisjointSets sets(cells + 1);
  Found found(cells);
  auto cell = [&](Id coface) { return coface < 0 ? outside : coface; };
  auto later = [&](Id a, Id b) {  // does a stand after b in the filtration?
    if (a == outside || b == outside) return a == outside;
    return cell_radii[a] != cell_radii[b] ? cell_radii[a] > cell_radii[b] : a > b;
  };
  for (std::size_t i = order.size(); i-- > 0;) {
    if ((i & kPoll) == 0) job.poll();
    if (i >= kAhead) {
      prefetch(cofaces + 2 * std::size_t{row_of(order[i - kAhead])});
      const Id* soon = cofaces + 2 * std::size_t{row_of(order[i - kAhead / 2])};
      sets.expect(cell(soon[0]));
      sets.expect(cell(soon[1]));
    }
    const std::size_t f = row_of(order[i]);
    const Id a = sets.root(cell(cofaces[2 * f])), b = sets.root(cell(cofaces[2 * f + 1]));
    if (a == b) continue;
    const Id young = later(a, b) ? b : a;
    sets.join(young, young == a ? b : a);
    found.add(static_cast<Id>(f), young);
  }
  return found.trimmed();
}

std::size_t count_components(std::size_t n, const Id* pairs, std::size_t count, const Job& job) {
  DisjointSets sets(n);
  std::size_t left = n;
  for (std::size_t i = 0; i < count; ++i) {
    if ((i & kPoll) == 0) job.poll();
    const Id a = sets.root(pairs[2 * i]), b = sets.root(pairs[2 * i + 1]);
    if (a == b) continue;
    sets.join(std::max(a, b), std::min(a, b));
    --left;
  }
  return left;
}

}  // namespace alphamesh
