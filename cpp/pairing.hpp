// What persistence in the plane and in space share: the order of a filtration, and pairs
// that union-find alone can tell.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"

namespace alphamesh {

// The rows of `value` in ascending order, equal values by row: the lower halves of the words.
Buffer<std::uint64_t> ascending(const double* value, std::size_t n, Job& job);

inline std::uint32_t row_of(std::uint64_t word) { return static_cast<std::uint32_t>(word); }

// Pairs (vertex, edge): the edge joins the component that began with the vertex to an older
// one. `births` are those of the n points, null if all are born at once; of equally old ones
// the lower row is older. `edges` is (E, 2) rows of points, `order` is that of the edges.
Buffer<std::int32_t> pair_components(std::size_t n, const double* births, const std::int32_t* edges,
                                     const Buffer<std::uint64_t>& order, const Job& job);

// Pairs (facet, cell): the facet closes off a hollow that the cell fills at last. `cofaces`
// is (facets, 2), -1 for the outside; `order` is that of the facets. Backwards, when facets
// are taken away, cells and the outside grow together across them.
Buffer<std::int32_t> pair_hollows(const std::int32_t* cofaces, const Buffer<std::uint64_t>& order,
                                  const double* cell_radii, std::size_t cells, const Job& job);

// The number of sets that n single numbers become when each of the `count` pairs is joined.
std::size_t count_components(std::size_t n, const std::int32_t* pairs, std::size_t count,
                             const Job& job);

}  // namespace alphamesh
