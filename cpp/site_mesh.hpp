// The regular triangulation of sites, for periodic boxes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "parallel.hpp"
#include "sites.hpp"

namespace alphamesh {

// The dimension of the cloud, 0 to 3, and so many axes along which it is seen without loss;
// sites that span it.
struct Span {
  int dimension = -1;
  int axes[3] = {0, 1, 2};
  std::vector<Sites::Id> site;
};
Span span_of(const Sites& sites, const Job& job);

// Bowyer 1981 and Watson 1981, one site after another in rounds along a Hilbert curve, in
// dimension D = 1, 2 or 3. Beyond each facet of the hull lies a ghost, one vertex of which is
// the site at infinity. The result is the unique triangulation that Sites::conflict()
// defines: hidden sites are in no cell.
template <int D>
class SiteMesh {
 public:
  using Id = Sites::Id;
  struct Cell {
    Id vertex[D + 1];    // positively oriented, the one at infinity beyond the hull
    Id neighbor[D + 1];  // 4c + i: facet opposite to vertex i of cell c
  };

  SiteMesh(const Sites& sites, const Span& span);
  void insert_all(Job& job);

  std::size_t slots() const { return cells_.size(); }
  // Whether a slot holds a cell that is no ghost.
  bool finite(std::size_t c) const { return cells_[c].vertex[0] >= 0 && !ghost(cells_[c]); }
  const Cell& cell(std::size_t c) const { return cells_[c]; }

 private:
  struct Border {
    Id inner, outer;  // facet of the cavity, from either side
  };

  int infinite(const Cell& c) const {
    for (int i = 0; i <= D; ++i) {
      if (c.vertex[i] == infinity_) return i;
    }
    return -1;
  }
  bool ghost(const Cell& c) const { return infinite(c) >= 0; }
  Cell& at(Id c) { return cells_[static_cast<std::size_t>(c)]; }
  bool conflict(Id c, Id q);
  Id locate(Id q);
  void insert(Id q);
  void collect(Id start, Id q);
  void fill(Id q);
  void link(Id c, int facet, Id common);
  void clear_table();
  Id new_cell();

  const Sites& sites_;
  const Span& span_;
  Id infinity_;
  Id here_ = 0;
  std::uint32_t random_ = 12345;
  std::vector<Cell> cells_;
  std::vector<Id> stamp_;  // twice the last site tested, + 1 if in conflict
  std::vector<Id> free_, cavity_;
  std::vector<Border> border_;
  std::vector<std::pair<std::uint64_t, Id>> table_;  // facets by their ridges; 2^k places
  std::vector<std::size_t> filled_;
};

}  // namespace alphamesh
