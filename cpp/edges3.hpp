// The edges of a triangulation of space, each found once by going around it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "compact3.hpp"
#include "memory.hpp"
#include "parallel.hpp"
#include "rules3.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {

// What is known of the facets. One belongs to the lower of its two tetrahedra, an edge to
// the lowest of all around it.
template <class Rule>
struct Facets3 {
  struct Of {
    std::int32_t first;        // the first triangle that belongs to the tetrahedron
    typename Rule::Code code;  // see there
    std::uint8_t before;       // how many of its own precede facet k, two bits each
    std::uint8_t met;          // edges that a lower tetrahedron of the same part has come across
  };
  Buffer<Of> of;  // per tetrahedron

  // Whether the facet of t belongs to it, given what lies across; -1 wraps around.
  static int owns(std::size_t t, std::int32_t code) {
    return static_cast<std::uint32_t>(code) > 4 * static_cast<std::uint32_t>(t) + 3 ? 1 : 0;
  }
};

struct Edges3 {
  Buffer<std::int32_t> ends;  // (E, 2)
  Buffer<double> radii;       // (E,)
};

// Leaves notes in `met`, which is zero at first.
template <class Rule>
Edges3 edges3(const SpatialOrder3& order, const Compact3& mesh, Facets3<Rule>& facets, Rule& rule,
              const Buffer<double>& triangle_radii, Job& job);

}  // namespace alphamesh
