#include "persistence2.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "radix_sort.hpp"

namespace alphamesh {
namespace {

using Id = std::int32_t;

// Bits of a double that is not negative, in its order.
std::uint64_t bits_of(double v) {
  const double positive = v + 0.0;  // no negative zero
  std::uint64_t b;
  std::memcpy(&b, &positive, sizeof b);
  return b;
}

// The rows of `value` in ascending order, equal values by row.
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
  auto row = [&](std::uint64_t w) { return static_cast<std::uint32_t>(w); };
  auto less = [&](std::uint64_t a, std::uint64_t b) {
    return value[row(a)] != value[row(b)] ? value[row(a)] < value[row(b)] : row(a) < row(b);
  };
  for (std::size_t i = 0, j; i < n; i = j) {
    for (j = i + 1; j < n && (words[j] >> 32) == (words[i] >> 32);) ++j;
    if (shift > 0 && j > i + 1 && !std::is_sorted(words.begin() + i, words.begin() + j, less)) {
      std::sort(words.begin() + i, words.begin() + j, less);
    }
  }
  return words;
}

// Disjoint sets whose root is always the oldest member.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  Id root(Id i) {
    while (parent_[static_cast<std::size_t>(i)] != i) {
      Id& p = parent_[static_cast<std::size_t>(i)];
      p = parent_[static_cast<std::size_t>(p)];  // path halving
      i = p;
    }
    return i;
  }
  void join(Id young, Id old) { parent_[static_cast<std::size_t>(young)] = old; }

 private:
  Buffer<Id> parent_;
};

constexpr std::size_t kPoll = 0xffff;

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

Buffer<Id> pair_components(const ComplexView2& view, const Buffer<std::uint64_t>& order,
                           const Job& job) {
  Sets sets(view.n);
  Found found(view.n);
  for (std::size_t i = 0; i < order.size(); ++i) {
    if ((i & kPoll) == 0) job.poll();
    const auto e = static_cast<std::uint32_t>(order[i]);
    const Id a = sets.root(view.edges[2 * std::size_t{e}]);
    const Id b = sets.root(view.edges[2 * std::size_t{e} + 1]);
    if (a == b) continue;
    const Id young = std::max(a, b);  // all are born at zero: the lower row is older
    sets.join(young, std::min(a, b));
    found.add(young, static_cast<Id>(e));
  }
  return found.trimmed();
}

Buffer<Id> pair_loops(const ComplexView2& view, const double* triangle_radii,
                      const Buffer<std::uint64_t>& order, const Job& job) {
  const auto outside = static_cast<Id>(view.triangle_count);
  Sets sets(view.triangle_count + 1);
  Found found(view.triangle_count);
  auto later = [&](Id a, Id b) {  // does a stand after b in the filtration?
    if (a == outside || b == outside) return a == outside;
    return triangle_radii[a] != triangle_radii[b] ? triangle_radii[a] > triangle_radii[b] : a > b;
  };
  for (std::size_t i = order.size(); i-- > 0;) {
    if ((i & kPoll) == 0) job.poll();
    const auto e = static_cast<std::uint32_t>(order[i]);
    const Id s = view.edge_triangles[2 * std::size_t{e}];
    const Id t = view.edge_triangles[2 * std::size_t{e} + 1];
    const Id a = sets.root(s < 0 ? outside : s), b = sets.root(t < 0 ? outside : t);
    if (a == b) continue;
    const Id young = later(a, b) ? b : a;
    sets.join(young, young == a ? b : a);
    found.add(static_cast<Id>(e), young);
  }
  return found.trimmed();
}

}  // namespace

Pairs2 persistence2(const ComplexView2& view, const double* triangle_radii,
                    const double* edge_radii, Job& job) {
  const Buffer<std::uint64_t> order = ascending(edge_radii, view.edge_count, job);
  job.advance(0.3);
  Pairs2 out;
  job.run(2, [&](std::size_t task) {
    if (task == 0) {
      out.components = pair_components(view, order, job);
    } else {
      out.loops = pair_loops(view, triangle_radii, order, job);
    }
    job.advance(0.35);
  });
  return out;
}

}  // namespace alphamesh
