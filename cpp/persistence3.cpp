#include "persistence3.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "bit_tree.hpp"
#include "pairing.hpp"

namespace alphamesh {
namespace {

using Id = std::int32_t;

// The simplices that are in no pair yet, in the order of the filtration.
struct Remaining {
  Buffer<Id> row;   // of each rank
  Buffer<Id> rank;  // of each row, -1 if it has been paired
};

// `taken` are pairs, in whose column `column` the simplices stand that are left out.
Remaining remaining(const Buffer<std::uint64_t>& order, const Buffer<Id>& taken,
                    std::size_t column) {
  const std::size_t pairs = taken.size() / 2;
  Remaining left{Buffer<Id>(order.size() - pairs), Buffer<Id>(order.size())};
  std::fill(left.rank.begin(), left.rank.end(), 0);
  for (std::size_t i = 0; i < pairs; ++i) left.rank[taken[2 * i + column]] = -1;
  std::size_t count = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto row = static_cast<Id>(row_of(order[i]));
    if (left.rank[row] < 0) continue;
    left.rank[row] = static_cast<Id>(count);
    left.row[count++] = row;
  }
  return left;
}

// The boundary of each triangle left, in ranks of edges left: (k, 3), descending, -1 where
// an edge is none of them.
Buffer<Id> boundary_columns(const Remaining& triangles, const Remaining& edges, const Id* sides,
                            Job& job) {
  Buffer<Id> columns(3 * triangles.row.size());
  const Parts parts(triangles.row.size(), job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t j = parts.begin(part); j < parts.end(part); ++j) {
      const Id* side = sides + 3 * static_cast<std::size_t>(triangles.row[j]);
      Id a = edges.rank[side[0]], b = edges.rank[side[1]], c = edges.rank[side[2]];
      if (a < b) std::swap(a, b);
      if (b < c) std::swap(b, c);
      if (a < b) std::swap(a, b);
      Id* column = columns.data() + 3 * j;
      column[0] = a, column[1] = b, column[2] = c;
    }
  });
  return columns;
}

// Reduces columns of at most three entries, in order.
class Reduction {
 public:
  Reduction(const Buffer<Id>& columns, std::size_t rows)
      : columns_(columns), owner_(rows), start_(rows), sum_(rows) {
    std::fill(owner_.begin(), owner_.end(), -1);
    std::fill(start_.begin(), start_.end(), -1);
  }

  void run(Job& job, double share) {
    const std::size_t count = columns_.size() / 3;
    constexpr std::size_t kStep = 1 << 14;
    for (std::size_t from = 0; from < count; from += kStep) {
      const std::size_t to = std::min(count, from + kStep);
      for (std::size_t j = from; j < to; ++j) reduce(static_cast<Id>(j), job);
      job.advance(share * static_cast<double>(to - from) / static_cast<double>(count));
    }
  }

  // The column whose lowest entry, reduced, is this row; -1 if there is none.
  const Buffer<Id>& owner() const { return owner_; }

 private:
  void reduce(Id column, Job& job) {
    const Id first = columns_[3 * static_cast<std::size_t>(column)];
    if (first < 0) return;
    if (owner_[first] < 0) {  // nothing to add: the column stays where it is
      owner_[first] = column;
      return;
    }
    add_plain(column);
    for (std::int64_t pivot; (pivot = sum_.largest()) >= 0;) {
      const auto row = static_cast<std::size_t>(pivot);
      if (owner_[row] < 0) {
        owner_[row] = column;
        keep(row);
        return;
      }
      if (start_[row] < 0) {
        add_plain(owner_[row]);
      } else {
        for (auto i = static_cast<std::size_t>(start_[row]); kept_[i] >= 0; ++i) {
          sum_.flip(static_cast<std::size_t>(kept_[i]));
        }
      }
      if ((++additions_ & 0xfff) == 0) job.poll();
    }
  }

  void add_plain(Id column) {
    const Id* entry = columns_.data() + 3 * static_cast<std::size_t>(column);
    for (int k = 0; k < 3 && entry[k] >= 0; ++k) sum_.flip(static_cast<std::size_t>(entry[k]));
  }

  void keep(std::size_t row) {
    start_[row] = static_cast<std::int64_t>(kept_.size());
    for (std::int64_t i; (i = sum_.largest()) >= 0;) {
      kept_.push_back(static_cast<Id>(i));
      sum_.flip(static_cast<std::size_t>(i));
    }
    kept_.push_back(-1);
  }

  const Buffer<Id>& columns_;
  Buffer<Id> owner_;
  Buffer<std::int64_t> start_;  // of a row's reduced column in kept_; -1 if it is as it was
  std::vector<Id> kept_;        // reduced columns, each closed by -1
  BitTree sum_;
  std::size_t additions_ = 0;
};

Buffer<Id> pair_loops(const Remaining& edges, const Remaining& triangles, const Id* sides, Job& job,
                      double share) {
  const Buffer<Id> columns = boundary_columns(triangles, edges, sides, job);
  Reduction reduction(columns, edges.row.size());
  reduction.run(job, share);
  const Buffer<Id>& owner = reduction.owner();
  const auto missing = std::count(owner.data(), owner.data() + owner.size(), -1);
  Buffer<Id> pairs(2 * (owner.size() - static_cast<std::size_t>(missing)));
  std::size_t count = 0;
  for (std::size_t i = 0; i < owner.size(); ++i) {
    if (owner[i] < 0) continue;
    pairs[count++] = edges.row[i];
    pairs[count++] = triangles.row[owner[i]];
  }
  return pairs;
}

// The one or two triangles of each edge on a plane, (E, 2).
Buffer<Id> edge_triangles(const FiltrationView3& view) {
  Buffer<Id> cofaces(2 * view.edge_count);
  std::fill(cofaces.begin(), cofaces.end(), -1);
  for (std::size_t i = 0; i < 3 * view.triangle_count; ++i) {
    Id* pair = cofaces.data() + 2 * static_cast<std::size_t>(view.triangle_edges[i]);
    pair[pair[0] < 0 ? 0 : 1] = static_cast<Id>(i / 3);
  }
  return cofaces;
}

}  // namespace

Pairs3 persistence3(const FiltrationView3& view, Job& job) {
  const Buffer<std::uint64_t> edge_order = ascending(view.edge_radii, view.edge_count, job);
  const Buffer<std::uint64_t> triangle_order =
      ascending(view.triangle_radii, view.triangle_count, job);
  job.advance(0.2);
  Pairs3 out;
  job.run(2, [&](std::size_t task) {
    if (task == 0) {
      out.voids = pair_hollows(view.triangle_tetrahedra, triangle_order, view.tetrahedron_radii,
                               view.tetrahedron_count, job);
      job.advance(0.25);
    } else {
      out.components = pair_components(view.n, view.births, view.edges, edge_order, job);
      job.advance(0.05);
    }
  });
  if (view.tetrahedron_count == 0) {
    const Buffer<Id> cofaces = edge_triangles(view);
    out.loops =
        pair_hollows(cofaces.data(), edge_order, view.triangle_radii, view.triangle_count, job);
  } else {
    Remaining edges, triangles;
    job.run(2, [&](std::size_t task) {
      if (task == 0) {
        triangles = remaining(triangle_order, out.voids, 0);
      } else {
        edges = remaining(edge_order, out.components, 1);
      }
    });
    out.loops = pair_loops(edges, triangles, view.triangle_edges, job, 0.5);
  }
  return out;
}

}  // namespace alphamesh
