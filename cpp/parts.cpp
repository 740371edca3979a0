#include "parts.hpp"

#include <algorithm>

#include "disjoint_sets.hpp"

namespace alphamesh {

Buffer<std::int32_t> parts(std::size_t cells, const std::int32_t* facet_cells, std::size_t facets,
                           const bool* inside, const bool* wall, Job& job) {
  using Id = std::int32_t;
  const auto outside = static_cast<Id>(cells);
  DisjointSets sets(cells + 1);
  for (std::size_t f = 0; f < facets; ++f) {
    if ((f & 0xffff) == 0) job.poll();
    const Id s = facet_cells[2 * f], t = facet_cells[2 * f + 1];
    if (s < 0 || (t < 0 ? inside[s] : inside[s] != inside[t])) continue;
    if (wall != nullptr && wall[f] && !inside[s]) continue;
    const Id a = sets.root(s), b = sets.root(t < 0 ? outside : t);
    if (a != b) sets.join(std::max(a, b), std::min(a, b));
  }
  const Id around = sets.root(outside);
  Buffer<Id> part(cells);
  Id regions = 0, enclosed = -2;
  for (std::size_t c = 0; c < cells; ++c) {  // roots come first
    const Id root = sets.root(static_cast<Id>(c));
    if (root != static_cast<Id>(c)) {
      part[c] = part[static_cast<std::size_t>(root)];
    } else if (root == around) {
      part[c] = -1;
    } else {
      part[c] = inside[c] ? regions++ : enclosed--;
    }
  }
  return part;
}

}  // namespace alphamesh
