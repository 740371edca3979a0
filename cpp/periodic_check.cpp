#include "periodic_check.hpp"

#include <algorithm>
#include <stdexcept>

#include "site_mesh.hpp"
#include "sites.hpp"

namespace alphamesh {
namespace {

using Id = Sites::Id;

// Makes a vertex of a cell a site, moved by some periods more.
void place(const PeriodicBox& box, const PeriodicCells& cells, std::size_t vertex, const int* move,
           Sites& sites, Id site) {
  const auto row = static_cast<std::size_t>(cells.row[vertex]);
  Dd position[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const int multiple = cells.offset[3 * vertex + k] + box.shift[3 * row + k] + move[k];
    position[k] = two_sum(box.anchor[3 * row + k], multiple * box.period[k]);
  }
  sites.set(site, position, box.weight == nullptr ? 0.0 : box.weight[row]);
}

template <int D>
std::size_t opposite(const PeriodicCells& cells, std::size_t cell, std::size_t facet) {
  const Id* face = cells.face + (D + 1) * cell;
  const Id* found = std::find(face, face + D + 1, static_cast<Id>(facet));
  if (found == face + D + 1) throw std::invalid_argument("a coface without its facet");
  return static_cast<std::size_t>(found - face);
}

// Axes along which the first cell is seen not to be flat.
template <int D>
Span axes_of(const PeriodicBox& box, const PeriodicCells& cells, const Job& job) {
  Sites sites(D + 1);
  const int rest[3] = {0, 0, 0};
  for (Id i = 0; i <= D; ++i) place(box, cells, static_cast<std::size_t>(i), rest, sites, i);
  return span_of(sites, job);
}

template <int D>
std::int8_t check_facet(const PeriodicBox& box, const PeriodicCells& cells, std::size_t facet,
                        const int* axes) {
  const Id one = cells.cofaces[2 * facet], other = cells.cofaces[2 * facet + 1];
  const int rest[3] = {0, 0, 0};
  Sites sites(D + 2);
  const std::size_t first = (D + 1) * static_cast<std::size_t>(one);
  const std::size_t near = opposite<D>(cells, static_cast<std::size_t>(one), facet);
  Id next = 0;
  for (std::size_t i = 0; i <= D; ++i) {
    place(box, cells, first + i, rest, sites, i == near ? D : next++);
  }
  Id v[D + 1], w[D + 1];
  for (Id i = 0; i <= D; ++i) v[i] = w[i] = i;
  const int side = sites.orient<D>(v, axes);
  if (side == 0) return kFlat;
  if (other < 0) return kSound;
  const std::size_t second = (D + 1) * static_cast<std::size_t>(other);
  const std::size_t far = opposite<D>(cells, static_cast<std::size_t>(other), facet);
  // The first vertices of the facet on both sides tell how far apart the copies are.
  const std::size_t a = first + (near == 0 ? 1 : 0), b = second + (far == 0 ? 1 : 0);
  int move[3];
  for (std::size_t k = 0; k < 3; ++k) move[k] = cells.offset[3 * a + k] - cells.offset[3 * b + k];
  place(box, cells, second + far, move, sites, D + 1);
  w[D] = D + 1;
  const int beyond = sites.orient<D>(w, axes);
  if (beyond == 0) return kFlat;
  if (beyond == side) return kFolded;
  if (side < 0) std::swap(v[0], v[1]);
  return sites.conflict<D>(v, D + 1, axes) ? kNotDelaunay : kSound;
}

}  // namespace

template <int D>
Buffer<std::int8_t> check_facets(const PeriodicBox& box, const PeriodicCells& cells, Job& job) {
  Buffer<std::int8_t> out(cells.facets);
  if (cells.count == 0) return out;
  const Span span = axes_of<D>(box, cells, job);
  const Parts parts(cells.facets, job, 1024);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t f = parts.begin(part); f < parts.end(part); ++f) {
      if ((f & 0x3ff) == 0) job.poll();
      out[f] = span.dimension < D ? kFlat : check_facet<D>(box, cells, f, span.axes);
    }
  });
  return out;
}

template Buffer<std::int8_t> check_facets<1>(const PeriodicBox&, const PeriodicCells&, Job&);
template Buffer<std::int8_t> check_facets<2>(const PeriodicBox&, const PeriodicCells&, Job&);
template Buffer<std::int8_t> check_facets<3>(const PeriodicBox&, const PeriodicCells&, Job&);

}  // namespace alphamesh
