#include "incidence3.hpp"

#include <algorithm>
#include <utility>

namespace alphamesh {
namespace {

using Id = std::int32_t;

std::size_t at(Id i) { return static_cast<std::size_t>(i); }

// Rows in the order in which edges, sorted in space, name them: neighbours in space are
// neighbours in memory. Merged rows, which no edge has, keep -1.
Buffer<Id> ranks_of_rows(const ComplexView3& view) {
  Buffer<Id> rank(view.n);
  std::fill(rank.begin(), rank.end(), -1);
  Id next = 0;
  for (std::size_t i = 0; i < 2 * view.edge_count; ++i) {
    Id& r = rank[at(view.edges[i])];
    if (r < 0) r = next++;
  }
  return rank;
}

// Edges by the lower rank of their ends, then by the higher one.
class EdgeTable {
 public:
  EdgeTable(const ComplexView3& view, Job& job)
      : rank_(ranks_of_rows(view)), start_(view.n + 1), entry_(view.edge_count) {
    std::fill(start_.begin(), start_.end(), 0);
    for (std::size_t e = 0; e < view.edge_count; ++e) ++start_[ends(view.edges + 2 * e).first + 1];
    for (std::size_t v = 0; v < view.n; ++v) start_[v + 1] += start_[v];
    Buffer<Id> next(view.n);
    std::copy(start_.begin(), start_.end() - 1, next.begin());
    for (std::size_t e = 0; e < view.edge_count; ++e) {
      if ((e & 0xffff) == 0) job.poll();
      const auto [low, high] = ends(view.edges + 2 * e);
      entry_[at(next[low]++)] = {static_cast<Id>(high), static_cast<Id>(e)};
    }
    const Parts parts(view.n, job);
    job.run(parts.count(), [&](std::size_t part) {
      for (std::size_t v = parts.begin(part); v < parts.end(part); ++v) {
        std::sort(entry_.begin() + start_[v], entry_.begin() + start_[v + 1]);
      }
    });
  }

  Id find(Id u, Id v) const {
    const Id pair[2] = {u, v};
    if (rank_[at(u)] < 0 || rank_[at(v)] < 0) return -1;
    const auto [low, high] = ends(pair);
    const Entry wanted{static_cast<Id>(high), 0};
    const Entry* end = entry_.data() + start_[low + 1];
    const Entry* found = std::lower_bound(entry_.data() + start_[low], end, wanted);
    return found != end && found->end == wanted.end ? found->edge : -1;
  }

 private:
  struct Entry {
    Id end, edge;  // the higher end, and the edge
    bool operator<(const Entry& other) const { return end < other.end; }
  };

  std::pair<std::size_t, std::size_t> ends(const Id* edge) const {
    const std::size_t a = at(rank_[at(edge[0])]), b = at(rank_[at(edge[1])]);
    return {std::min(a, b), std::max(a, b)};
  }

  Buffer<Id> rank_, start_;
  Buffer<Entry> entry_;
};

}  // namespace

Buffer<std::int32_t> tetrahedron_triangles3(const ComplexView3& view, Job& job) {
  Buffer<Id> out(4 * view.tetrahedron_count);
  std::fill(out.begin(), out.end(), -1);
  const Parts parts(view.triangle_count, job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t f = parts.begin(part); f < parts.end(part); ++f) {
      const Id* face = view.triangles + 3 * f;
      for (std::size_t k = 0; k < 2; ++k) {
        const Id t = view.triangle_tetrahedra[2 * f + k];
        if (t < 0) continue;
        // Both ascend, so the vertex left out is where they first differ.
        const Id* row = view.tetrahedra + 4 * at(t);
        std::size_t opposite = 0;
        while (opposite < 3 && row[opposite] == face[opposite]) ++opposite;
        out[4 * at(t) + opposite] = static_cast<Id>(f);
      }
    }
  });
  return out;
}

Buffer<std::int32_t> triangle_edges3(const ComplexView3& view, Job& job) {
  Buffer<Id> out(3 * view.triangle_count);
  const EdgeTable table(view, job);
  const Parts parts(view.triangle_count, job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t f = parts.begin(part); f < parts.end(part); ++f) {
      if ((f & 0xffff) == 0) job.poll();
      const Id* v = view.triangles + 3 * f;
      for (std::size_t k = 0; k < 3; ++k) {
        out[3 * f + k] = table.find(v[k == 0 ? 1 : 0], v[k == 2 ? 1 : 2]);
      }
    }
  });
  return out;
}

}  // namespace alphamesh
