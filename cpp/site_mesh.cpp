#include "site_mesh.hpp"

#include <algorithm>
#include <stdexcept>

#include "radix_sort.hpp"
#include "rounds3.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {
namespace {

using Id = Sites::Id;

constexpr std::uint64_t kEmpty = ~std::uint64_t{0};

// The sites along a Hilbert curve; what they are rounded to is enough for that.
std::vector<Id> along_curve(const Sites& sites, Job& job) {
  const std::size_t n = sites.size();
  double lo[3], hi[3];
  std::fill(lo, lo + 3, HUGE_VAL);
  std::fill(hi, hi + 3, -HUGE_VAL);
  for (std::size_t i = 0; i < n; ++i) {
    for (int k = 0; k < 3; ++k) {
      const double v = coordinate(sites.high(static_cast<Id>(i)), k);
      lo[k] = std::min(lo[k], v);
      hi[k] = std::max(hi[k], v);
    }
  }
  double side = 0.0;
  for (int k = 0; k < 3; ++k) side = std::max(side, hi[k] - lo[k]);
  constexpr std::uint32_t kCells = 1u << Space::kBits;
  const double scale = side > 0.0 ? kCells / side : 0.0;
  Buffer<std::uint64_t> words(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::uint32_t cell[3];
    for (int k = 0; k < 3; ++k) {
      const double v = (coordinate(sites.high(static_cast<Id>(i)), k) - lo[k]) * scale;
      cell[k] = std::min(static_cast<std::uint32_t>(v), kCells - 1);
    }
    words[i] = (std::uint64_t{Space::code(cell, Space::kBits)} << 32) | i;
  }
  radix_sort(words, 32, job);
  std::vector<Id> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = static_cast<Id>(words[i] & 0xffffffffu);
  return order;
}

// An axis along which two sites differ; false if there is none.
bool find_line(const Sites& sites, const Id* v, int* axes) {
  for (int k = 0; k < 3; ++k) {
    axes[0] = k;
    if (sites.orient<1>(v, axes) != 0) return true;
  }
  return false;
}

// Two of the axes along which three sites are seen not to be on one line; false if none are.
bool find_plane(const Sites& sites, const Id* v, int* axes) {
  for (int skipped = 2; skipped >= 0; --skipped) {
    const int pair[2] = {skipped == 0 ? 1 : 0, skipped == 2 ? 1 : 2};
    if (sites.orient<2>(v, pair) == 0) continue;
    std::copy(pair, pair + 2, axes);
    return true;
  }
  return false;
}

}  // namespace

Span span_of(const Sites& sites, const Job& job) {
  Span span;
  for (std::size_t i = 0; i < sites.size() && span.dimension < 3; ++i) {
    if ((i & 0xfff) == 0) job.poll();
    Id v[4];
    std::copy(span.site.begin(), span.site.end(), v);
    v[span.dimension + 1] = static_cast<Id>(i);
    if (span.dimension == 0 && !find_line(sites, v, span.axes)) continue;
    if (span.dimension == 1 && !find_plane(sites, v, span.axes)) continue;
    const int all[3] = {0, 1, 2};
    if (span.dimension == 2) {
      if (sites.orient<3>(v, all) == 0) continue;
      std::copy(all, all + 3, span.axes);
    }
    span.site.push_back(static_cast<Id>(i));
    ++span.dimension;
  }
  const Id* v = span.site.data();
  int sign = 0;
  if (span.dimension == 1) sign = sites.orient<1>(v, span.axes);
  if (span.dimension == 2) sign = sites.orient<2>(v, span.axes);
  if (span.dimension == 3) sign = sites.orient<3>(v, span.axes);
  if (sign < 0) std::swap(span.site[0], span.site[1]);
  return span;
}

// One cell and a ghost on each of its facets.
template <int D>
SiteMesh<D>::SiteMesh(const Sites& sites, const Span& span)
    : sites_(sites), span_(span), infinity_(static_cast<Id>(sites.size())) {
  table_.resize(1024, {kEmpty, -1});
  const Id* v = span.site.data();
  Cell first;
  std::copy(v, v + D + 1, first.vertex);
  std::fill(first.neighbor, first.neighbor + D + 1, -1);
  cells_.assign(D + 2, first);
  stamp_.assign(D + 2, -1);
  for (int i = 0; i <= D; ++i) {
    Cell& g = cells_[static_cast<std::size_t>(i) + 1];
    g.vertex[i] = infinity_;
    // A site beyond the facet in place of i would turn the cell over.
    const int a = (i + 1) % (D + 1), b = D == 1 ? i : (i + 2) % (D + 1), place = D == 1 ? a : i;
    std::swap(g.vertex[a], g.vertex[b]);
    g.neighbor[place] = i;
    cells_[0].neighbor[i] = 4 * (i + 1) + place;
  }
  for (Id c = 1; c <= D + 1; ++c) {
    for (int i = 0; i <= D; ++i) {
      if (at(c).vertex[i] != infinity_) link(c, i, infinity_);
    }
  }
  clear_table();
}

template <int D>
void SiteMesh<D>::clear_table() {
  for (const std::size_t place : filled_) table_[place].first = kEmpty;
  filled_.clear();
}

template <int D>
void SiteMesh<D>::insert_all(Job& job) {
  const std::vector<Id> order = along_curve(sites_, job);
  const Rounds rounds = plan_rounds(order.size());
  const std::size_t ample = (D == 2 ? 3 : 8) * order.size() + 64;
  cells_.reserve(ample);
  stamp_.reserve(ample);
  std::size_t done = 0;
  while (done < order.size()) {
    if ((done & 0x3ff) == 0) job.poll();
    const Id q = order[static_cast<std::size_t>(rounds.point[done])];
    if (std::find(span_.site.begin(), span_.site.end(), q) == span_.site.end()) insert(q);
    if ((++done & 0x3fff) == 0) job.advance(0.6 * 0x4000 / static_cast<double>(order.size()));
  }
}

template <int D>
bool SiteMesh<D>::conflict(Id c, Id q) {
  const Cell& cell = at(c);
  const int i = infinite(cell);
  if (i < 0) return sites_.conflict<D>(cell.vertex, q, span_.axes);
  Id v[D + 1];
  std::copy(cell.vertex, cell.vertex + D + 1, v);
  v[i] = q;
  const int side = sites_.orient<D>(v, span_.axes);
  if (side != 0) return side > 0;
  // On the hyperplane of a hull facet: as the cell behind it.
  return sites_.conflict<D>(at(cell.neighbor[i] >> 2).vertex, q, span_.axes);
}

// Walks, with random turns, to a cell in conflict; -1 if the cell that holds q is in none.
template <int D>
Id SiteMesh<D>::locate(Id q) {
  Id c = here_, entry = -1;
  while (!conflict(c, q)) {
    const Cell& cell = at(c);
    int exit = infinite(cell);
    random_ = random_ * 1664525u + 1013904223u;
    for (int k = 0; exit < 0 && k <= D; ++k) {
      const int i = static_cast<int>(((random_ >> 20) + static_cast<unsigned>(k)) % (D + 1));
      if (i == entry) continue;
      Id v[D + 1];
      std::copy(cell.vertex, cell.vertex + D + 1, v);
      v[i] = q;
      if (sites_.orient<D>(v, span_.axes) < 0) exit = i;
    }
    if (exit < 0) {
      here_ = c;
      return -1;
    }
    entry = cell.neighbor[exit] & 3;
    c = cell.neighbor[exit] >> 2;
  }
  return c;
}

template <int D>
void SiteMesh<D>::insert(Id q) {
  const Id start = locate(q);
  if (start < 0) return;  // hidden
  collect(start, q);
  fill(q);
}

// All cells in conflict, and the facets around them.
template <int D>
void SiteMesh<D>::collect(Id start, Id q) {
  cavity_.assign(1, start);
  border_.clear();
  stamp_[static_cast<std::size_t>(start)] = 2 * q + 1;
  for (std::size_t k = 0; k < cavity_.size(); ++k) {
    const Id c = cavity_[k];
    for (int i = 0; i <= D; ++i) {
      const Id code = at(c).neighbor[i], other = code >> 2;
      Id& stamp = stamp_[static_cast<std::size_t>(other)];
      if (stamp >> 1 != q) {
        stamp = 2 * q + (conflict(other, q) ? 1 : 0);
        if ((stamp & 1) != 0) cavity_.push_back(other);
      }
      if ((stamp & 1) == 0) border_.push_back({4 * c + i, code});
    }
  }
}

template <int D>
Id SiteMesh<D>::new_cell() {
  if (!free_.empty()) {
    const Id c = free_.back();
    free_.pop_back();
    return c;
  }
  if (cells_.size() >= std::size_t{1} << 29) throw std::bad_alloc();
  cells_.push_back({});
  stamp_.push_back(-1);
  return static_cast<Id>(cells_.size()) - 1;
}

// Puts a cell on each facet of the border.
template <int D>
void SiteMesh<D>::fill(Id q) {
  std::size_t size = table_.size();
  while (size < 4 * D * border_.size()) size *= 2;
  if (size > table_.size()) table_.assign(size, {kEmpty, -1});
  for (const Border& b : border_) {
    const Id made = new_cell();
    Cell cell = at(b.inner >> 2);
    const int facet = b.inner & 3;
    cell.vertex[facet] = q;
    cell.neighbor[facet] = b.outer;
    at(made) = cell;
    at(b.outer >> 2).neighbor[b.outer & 3] = 4 * made + facet;
    for (int i = 0; i <= D; ++i) {
      if (i != facet) link(made, i, q);
    }
    here_ = made;
  }
  clear_table();
  for (const Id c : cavity_) {
    at(c).vertex[0] = -1;
    free_.push_back(c);
  }
}

// Joins facets that have the same vertices: the one that all have in common, and a ridge.
template <int D>
void SiteMesh<D>::link(Id c, int facet, Id common) {
  std::uint64_t ridge[2] = {0, 0};
  int count = 0;
  for (int i = 0; i <= D; ++i) {
    const Id v = at(c).vertex[i];
    if (i != facet && v != common) ridge[count++] = static_cast<std::uint32_t>(v);
  }
  const std::uint64_t key = std::max(ridge[0], ridge[1]) << 32 | std::min(ridge[0], ridge[1]);
  const std::size_t mask = table_.size() - 1;
  std::size_t place = (key * 0x9e3779b97f4a7c15u >> 32) & mask;
  while (table_[place].first != kEmpty && table_[place].first != key) place = (place + 1) & mask;
  if (table_[place].first == kEmpty) {
    table_[place] = {key, 4 * c + facet};
    filled_.push_back(place);
    return;
  }
  const Id other = table_[place].second;
  at(c).neighbor[facet] = other;
  at(other >> 2).neighbor[other & 3] = 4 * c + facet;
}

template class SiteMesh<1>;
template class SiteMesh<2>;
template class SiteMesh<3>;

}  // namespace alphamesh
