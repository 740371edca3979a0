#include "box.hpp"

#include "boxed.hpp"
#include "periodic_check.hpp"
#include "proof.hpp"

namespace trust {
namespace {

using alphamesh::Buffer;
using alphamesh::Dd;
using alphamesh::Job;
using alphamesh::Layer;

// Of values, as it is promised in the plane and in space.
double error_in(std::size_t dimension) { return dimension == 2 ? 1e-14 : 2e-13; }

class Proof {
 public:
  Proof(const Cloud& cloud, const Built& built, Job& job)
      : b_(built),
        job_(job),
        d_(built.layers.size() - 1),
        error_(error_in(cloud.dimension)),
        full_(d_ == cloud.dimension),
        g_(geometry_of(built)) {
    for (std::size_t k = 0; k <= d_; ++k) {
      simplices_.emplace_back();
      for (std::size_t i = 0; i < b_.layers[k].count; ++i) {
        simplices_[k].push_back(corners_of(b_.layers[k], k, i));
      }
    }
  }

  void prove_layers();
  void prove_mesh();
  void prove_once();
  void prove_hidden();
  void prove_values();
  void prove_checked();
  void prove_margin();

 private:
  static constexpr std::size_t kMoves = 125;

  Id id(const Corner& c) const {
    for (int m : c.move) require(std::abs(m) <= 2, "no simplex is longer than a period");
    return static_cast<Id>(kMoves) * c.row + 25 * (c.move[0] + 2) + 5 * (c.move[1] + 2) +
           (c.move[2] + 2);
  }
  // The vertex that a face lacks, where the face is as it is listed.
  Corner apex(std::size_t k, std::size_t cell, std::size_t left) const {
    const Corners& c = simplices_[k][cell];
    return {c[left].row, c[left].move - c[left == 0 ? 1 : 0].move};
  }
  std::vector<Id> ids(const Corners& corners) const {
    std::vector<Id> out;
    for (const Corner& c : corners) out.push_back(id(c));
    return out;
  }
  // Whether a move is one of the box: along its closed directions.
  bool allowed(std::size_t code) const {
    const int m[3] = {static_cast<int>(code) / 25 - 2, static_cast<int>(code) / 5 % 5 - 2,
                      static_cast<int>(code) % 5 - 2};
    for (std::size_t k = 0; k < 3; ++k) {
      if (m[k] != 0 && !(b_.box.period[k] > 0)) return false;
    }
    return true;
  }
  int orientation(const std::vector<Id>& v) const {
    if (d_ == 1) return g_.before(v[0], v[1]) ? 1 : -1;
    return d_ == 2 ? g_.turn(v[0], v[1], v[2]) : g_.side(v[0], v[1], v[2], v[3]);
  }
  // +1 if q is within the sphere of a cell, or on it and told to be inside.
  int conflict(std::vector<Id> v, Id q) const {
    if (d_ == 1) return g_.in_interval_or_out(v[0], v[1], q);
    if (orientation(v) < 0) std::swap(v[0], v[1]);
    return d_ == 2 ? g_.in_circle_or_out(v[0], v[1], v[2], q)
                   : g_.in_sphere_or_out(v[0], v[1], v[2], v[3], q);
  }
  // +1 if q is strictly within a cell, 0 on its border, -1 outside.
  int within(const std::vector<Id>& v, Id q) const {
    if (d_ == 1) return g_.before(v[0], q) == g_.before(q, v[1]) ? 1 : -1;
    const int way = orientation(v);
    int least = 1;
    for (std::size_t k = 0; k <= d_ && least >= 0; ++k) {
      std::vector<Id> replaced = v;
      replaced[k] = q;
      least = std::min(least, way * orientation(replaced));
    }
    return least;
  }
  void look_flat();

  const Built& b_;
  Job& job_;
  std::size_t d_;
  double error_;
  bool full_;  // else nothing is told of the cells of facets
  Geometry g_;
  std::vector<std::vector<Corners>> simplices_;
};

// Simplices come once and in order, their faces are told, and so are the cells of facets.
void Proof::prove_layers() {
  long euler = 0;
  for (std::size_t k = 0; k <= d_; ++k) {
    const long count = static_cast<long>(simplices_[k].size());
    euler += k % 2 == 0 ? count : -count;
    require(b_.radii[k].size() == simplices_[k].size(), "a value for each simplex");
    std::set<Id> met;
    for (std::size_t i = 0; i < simplices_[k].size(); ++i) {
      const Corners& c = simplices_[k][i];
      require(normal(c) == c, "vertices ascend from one that is not moved");
      require(
          i == 0 ||
              [&] {
                const Corners& before = simplices_[k][i - 1];
                std::vector<Id> last, rows;
                std::vector<Move> last_moves, moves;
                for (const Corner& v : before) last.push_back(v.row), last_moves.push_back(v.move);
                for (const Corner& v : c) rows.push_back(v.row), moves.push_back(v.move);
                return std::tie(last, last_moves) < std::tie(rows, moves);
              }(),
          "simplices ascend by rows, then by offsets");
      for (std::size_t j = 0; j <= k && k > 0; ++j) {
        Corners face = c;
        face.erase(face.begin() + static_cast<std::ptrdiff_t>(j));
        const Id f = b_.layers[k].face[(k + 1) * i + j];
        require(f >= 0 && static_cast<std::size_t>(f) < simplices_[k - 1].size() &&
                    simplices_[k - 1][static_cast<std::size_t>(f)] == normal(face),
                "faces are told");
        met.insert(f);
      }
    }
    require(k == 0 || met.size() == simplices_[k - 1].size(), "every face has a coface");
  }
  require(euler == 0, "as many simplices of even dimension as of odd");
  std::set<Id> vertices;
  for (const Corners& c : simplices_[0]) vertices.insert(c[0].row);
  for (Id v : vertices) require(b_.box.representative[v] == v, "vertices stand for themselves");
  require(g_.weighted() || vertices.size() == b_.box.rows.size(), "all points are vertices");
}

// A cloud on a plane of space is looked at along an axis that it does not hold.
void Proof::look_flat() {
  const std::vector<Id> v = ids(simplices_[2][0]);
  std::size_t dropped = 0;
  for (; dropped < 3; ++dropped) {
    g_.look_along(dropped);
    if (g_.turn(v[0], v[1], v[2]) != 0) break;
  }
  require(dropped < 3, "no triangle is flat");
}

// Locally Delaunay at all facets, and convex where there is an end.
void Proof::prove_mesh() {
  if (d_ == 2) look_flat();
  const auto& facets = simplices_[d_ - 1];
  std::vector<std::vector<std::pair<Id, Corner>>> cells(facets.size());
  for (std::size_t i = 0; i < simplices_[d_].size(); ++i) {
    require(orientation(ids(simplices_[d_][i])) != 0, "no cell is flat");
    for (std::size_t j = 0; j <= d_; ++j) {
      const auto f = static_cast<std::size_t>(b_.layers[d_].face[(d_ + 1) * i + j]);
      cells[f].push_back({static_cast<Id>(i), apex(d_, i, j)});
    }
  }
  const bool open = static_cast<std::size_t>(b_.box.dimensions_closed()) < d_;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    std::multiset<Id> said{b_.sides[2 * f], b_.sides[2 * f + 1]}, found;
    for (const auto& cell : cells[f]) found.insert(cell.first);
    while (found.size() < 2) found.insert(-1);
    require(!full_ || (said == found && b_.sides[2 * f] >= 0), "the cells of a facet are told");
    std::vector<Id> v = ids(facets[f]);
    v.push_back(id(cells[f][0].second));
    const int side = orientation(v);
    if (cells[f].size() == 1) {
      require(open, "a facet without a second cell in a closed box");
      for (Id row : b_.box.rows) {
        for (std::size_t code = 0; code < kMoves; ++code) {
          if (!allowed(code)) continue;
          v[d_] = static_cast<Id>(kMoves) * row + static_cast<Id>(code);
          require(orientation(v) * side >= 0, "all within the hull");
        }
      }
      continue;
    }
    std::vector<Id> beyond = v;
    beyond[d_] = id(cells[f][1].second);
    require(orientation(beyond) == -side, "cells on both sides of a facet");
    require(conflict(v, beyond[d_]) < 0, "locally Delaunay, ties broken");
  }
}

// With all this, cells cover everything equally often: once, if they do so at one place.
void Proof::prove_once() {
  int found = 0;
  for (const Corners& c : simplices_[d_]) {
    const std::vector<Id> v = ids(c);
    for (std::size_t code = 0; code < kMoves; ++code) {
      if (!allowed(code)) continue;
      const Id q = static_cast<Id>(kMoves * b_.box.n + code);
      found += within(v, q) > 0;
    }
  }
  require(found == 1, "cells cover a place once");
}

void Proof::prove_hidden() {
  std::set<Id> vertices;
  for (const Corners& c : simplices_[0]) vertices.insert(c[0].row);
  for (const Id row : b_.box.rows) {
    if (vertices.count(row) == 1) continue;
    bool found = false;
    for (const Corners& c : simplices_[d_]) {
      const std::vector<Id> v = ids(c);
      for (std::size_t code = 0; code < kMoves; ++code) {
        const Id q = static_cast<Id>(kMoves) * row + static_cast<Id>(code);
        if (!allowed(code) || within(v, q) < 0) continue;
        found = true;
        require(conflict(v, q) < 0, "hidden points are lifted above the cells that hold them");
      }
    }
    require(found, "hidden points lie in a cell");
  }
}

void Proof::prove_values() {
  for (std::size_t k = 0; k <= d_; ++k) {
    std::vector<Claim> claims(simplices_[k].size());
    std::vector<std::vector<Id>> own;
    for (std::size_t i = 0; i < claims.size(); ++i) {
      claims[i].value = b_.radii[k][i];
      own.push_back(ids(simplices_[k][i]));
    }
    for (std::size_t i = 0; k < d_ && i < simplices_[k + 1].size(); ++i) {
      for (std::size_t j = 0; j <= k + 1; ++j) {
        const auto f = static_cast<std::size_t>(b_.layers[k + 1].face[(k + 2) * i + j]);
        claims[f].least = std::min(claims[f].least, b_.radii[k + 1][i]);
        claims[f].inside |= g_.in_smallest(own[f].data(), k + 1, id(apex(k + 1, i, j))) > 0;
      }
    }
    for (std::size_t i = 0; i < claims.size(); ++i) {
      // Here all is scaled. A vertex without a weight is there from the beginning.
      claims[i].value = std::ldexp(claims[i].value, b_.box.exponent);
      claims[i].least = std::ldexp(claims[i].least, b_.box.exponent);
      prove_value(g_, own[i].data(), k + 1, claims[i], error_);
    }
  }
}

void Proof::prove_checked() {
  if (!full_) return;
  const Layer& cells = b_.layers[d_];
  const alphamesh::PeriodicCells view{cells.row.data(),  cells.offset.data(),
                                      cells.face.data(), cells.count,
                                      b_.sides.data(),   simplices_[d_ - 1].size()};
  const auto box = b_.view();
  const auto found = d_ == 2 ? alphamesh::check_facets<2>(box, view, job_)
                             : alphamesh::check_facets<3>(box, view, job_);
  for (std::size_t f = 0; f < found.size(); ++f) {
    require(found[f] == alphamesh::kSound, "what is right is found to be");
  }
}

// A narrower margin does if no sphere reaches beyond it.
void Proof::prove_margin() {
  const alphamesh::Reach& all = b_.star.reach;
  if (all.open) return;
  double halo[3];
  bool narrower = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const double side = b_.box.period[k];
    const double reached = std::max(-all.lo[k], all.hi[k] - side) * (1 + 0x1p-40);
    require(!std::isnan(reached), "reaches are numbers");
    halo[k] = side > 0 ? std::min(side, std::max(0.0, reached) + std::ldexp(side, -40)) : 0.0;
    narrower |= halo[k] < side;
  }
  if (!narrower) return;
  const Star star = star_of(b_.box, halo, job_);
  if (star.reach.open || star.dimension != b_.star.dimension) return;
  for (std::size_t k = 0; k < 3; ++k) {
    const double side = b_.box.period[k];
    const double reached = std::max(-star.reach.lo[k], star.reach.hi[k] - side);
    if (halo[k] < side && reached + std::ldexp(side, -50) > halo[k]) return;
  }
  require(cells_of(star) == cells_of(b_.star), "a margin that holds all spheres is wide enough");
}

// Values by simplices, whose corners are told from the points as they were given.
std::vector<std::map<Corners, double>> by_corners(const Cloud& cloud, const Built& built,
                                                  bool reversed) {
  const Box& box = built.box;
  std::vector<std::map<Corners, double>> out(built.layers.size());
  for (std::size_t k = 0; k < built.layers.size(); ++k) {
    for (std::size_t i = 0; i < built.layers[k].count; ++i) {
      Corners corners = corners_of(built.layers[k], k, i);
      for (Corner& c : corners) {
        for (std::size_t a = 0; a < cloud.dimension; ++a) {
          if (!(box.period[a] > 0)) continue;
          const std::size_t at = 3 * static_cast<std::size_t>(c.row) + a;
          const double anchor = std::ldexp(box.anchor[at], -box.exponent);
          const double given = cloud.row(static_cast<std::size_t>(c.row))[a];
          c.move[a] +=
              box.shift[at] - static_cast<int>(std::lround((given - anchor) / cloud.periods[a]));
        }
        if (reversed) c.row = static_cast<Id>(cloud.n) - 1 - c.row;
      }
      out[k].emplace(normal(corners), built.radii[k][i]);
    }
  }
  return out;
}

bool few_periods(const Cloud& cloud) {
  for (std::size_t i = 0; i < cloud.coordinates.size(); ++i) {
    const double side = cloud.periods[i % cloud.dimension];
    if (side > 0 && std::fabs(cloud.coordinates[i]) > 0x1p20 * side) return false;
  }
  return true;
}

void prove_same(const Cloud& cloud, const Built& built, const Cloud& other, bool reversed) {
  Job job(1);
  Built again;
  require(build(other, again, job), "what is in range stays so");
  const auto expected = by_corners(cloud, built, false), found = by_corners(other, again, reversed);
  require(expected.size() == found.size(), "the same dimension");
  for (std::size_t k = 0; k < expected.size(); ++k) {
    require(expected[k].size() == found[k].size(), "as many simplices");
    auto f = found[k].begin();
    for (const auto& [corners, value] : expected[k]) {
      require(f->first == corners, "the same simplices");
      const double slack = reversed ? 0.0 : 2 * error_in(cloud.dimension) * std::fabs(value);
      require(std::fabs(f->second - value) <= slack || !measurable(value), "the same values");
      ++f;
    }
  }
}

// Moves all points by the way from the last to the first one, if that rounds nothing.
bool moved(const Cloud& cloud, Cloud& out) {
  out = cloud;
  for (std::size_t i = 0; i < cloud.coordinates.size(); ++i) {
    const std::size_t k = i % cloud.dimension;
    const double by = cloud.row(0)[k] - cloud.row(cloud.n - 1)[k];
    const Dd sum = alphamesh::two_sum(cloud.coordinates[i], by);
    if (sum.l != 0.0 || !std::isfinite(sum.h)) return false;
    out.coordinates[i] = sum.h;
  }
  Box box;
  return put(out, box);
}

}  // namespace

void prove_box(const Cloud& cloud) {
  Job job(cloud.threads);
  const alphamesh::Recycling recycling;
  Built built;
  if (!build(cloud, built, job)) return;
  Proof proof(cloud, built, job);
  proof.prove_layers();
  proof.prove_mesh();
  proof.prove_once();
  proof.prove_hidden();
  proof.prove_values();
  proof.prove_checked();
  proof.prove_margin();
  if (!cloud.again || built.box.rows.size() != cloud.n || !few_periods(cloud)) return;
  prove_same(cloud, built, reversed(cloud), true);
  Cloud elsewhere;
  if (moved(cloud, elsewhere) && few_periods(elsewhere)) prove_same(cloud, built, elsewhere, false);
}

}  // namespace trust
