#include "incidence3.hpp"

#include <algorithm>

namespace alphamesh {
namespace {

using Id = std::int32_t;

std::size_t at(Id i) { return static_cast<std::size_t>(i); }

// Edges by their lower row. Most rows are the lower one of few edges; of those that are
// that of many, the other ends are sorted.
class EdgeTable {
 public:
  EdgeTable(const ComplexView3& view, Job& job) : start_(view.n + 1), entry_(view.edge_count) {
    std::fill(start_.begin(), start_.end(), 0);
    for (std::size_t e = 0; e < view.edge_count; ++e) ++start_[at(view.edges[2 * e]) + 1];
    for (std::size_t v = 0; v < view.n; ++v) start_[v + 1] += start_[v];
    // From the ends backwards: start_[v + 1] moves to where the edges of v begin.
    for (std::size_t e = view.edge_count; e-- > 0;) {
      if ((e & 0xffff) == 0) job.poll();
      Id& next = start_[at(view.edges[2 * e]) + 1];
      entry_[at(--next)] = {view.edges[2 * e + 1], static_cast<Id>(e)};
    }
    for (std::size_t v = 0; v < view.n; ++v) start_[v] = start_[v + 1];
    start_[view.n] = static_cast<Id>(view.edge_count);
    const Parts parts(view.n, job);
    job.run(parts.count(), [&](std::size_t part) {
      for (std::size_t v = parts.begin(part); v < parts.end(part); ++v) {
        Entry* first = entry_.data() + start_[v];
        Entry* last = entry_.data() + start_[v + 1];
        if (last - first > kFew) std::sort(first, last);
      }
    });
  }

  // The edge from row u to row v > u, -1 if there is none.
  Id find(Id u, Id v) const {
    const Entry* entry = entry_.data() + start_[at(u)];
    const Entry* end = entry_.data() + start_[at(u) + 1];
    if (end - entry > kFew) entry = std::lower_bound(entry, end, Entry{v, 0});
    while (entry != end && entry->end != v) ++entry;
    return entry != end ? entry->edge : -1;
  }

 private:
  struct Entry {
    Id end, edge;
    bool operator<(const Entry& other) const { return end < other.end; }
  };
  static constexpr std::ptrdiff_t kFew = 64;

  Buffer<Id> start_;
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
