#include "box.hpp"

#include <numeric>

#include "periodic_check.hpp"
#include "periodic_values.hpp"
#include "proof.hpp"
#include "quotient.hpp"
#include "reach.hpp"
#include "site_mesh.hpp"
#include "sites.hpp"

namespace trust {
namespace {

using alphamesh::Buffer;
using alphamesh::Dd;
using alphamesh::Job;
using alphamesh::Layer;

constexpr double kError = 1e-14;
constexpr int kTop = 100, kBottom = -170;  // as in alphamesh.periodic

using Move = std::array<int, 3>;  // by so many periods

Move operator-(const Move& a, const Move& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

// A cloud in its box, as alphamesh.periodic puts it there: point i lies at its anchor, moved by
// `shift` periods.
struct Box {
  std::size_t n = 0;
  double period[3] = {0, 0, 0};
  std::vector<double> anchor, weight;
  std::vector<std::int8_t> shift;
  std::vector<Id> representative, rows;  // those that stand for themselves
  int exponent = 0;
  double unit = 1.0;

  int dimensions_closed() const {
    return static_cast<int>(std::count_if(period, period + 3, [](double p) { return p > 0; }));
  }
  Dd at(Id row, std::size_t axis, int move) const {
    const std::size_t i = 3 * static_cast<std::size_t>(row) + axis;
    return alphamesh::two_sum(anchor[i], (shift[i] + move) * period[axis]);
  }
};

// The digits of numbers, from the first to the last one.
struct Digits {
  int top = INT_MIN, bottom = INT_MAX;
  void add(double v) {
    if (v == 0.0) return;
    top = std::max(top, std::ilogb(v) + 1);
    bottom = std::min(bottom, lowest_bit(v));
  }
};

bool scale(Box& box) {
  Digits numbers;
  for (double v : box.anchor) numbers.add(v);
  for (double v : box.period) numbers.add(v);
  if (numbers.top - numbers.bottom > kTop - kBottom) return false;
  if (numbers.top > kTop || numbers.bottom < kBottom) box.exponent = kTop - numbers.top;
  for (double& v : box.anchor) v = std::ldexp(v, box.exponent);
  for (double& v : box.period) v = std::ldexp(v, box.exponent);
  int unit = numbers.bottom + box.exponent;
  for (double& w : box.weight) {
    if (w == 0.0) continue;
    const int first = std::ilogb(w) + 1 + 2 * box.exponent, last = lowest_bit(w) + 2 * box.exponent;
    if (first > 2 * kTop || last < 2 * kBottom) return false;
    w = std::ldexp(w, 2 * box.exponent);
    unit = std::min(unit, (last - (last & 1)) / 2);
  }
  box.unit = std::ldexp(1.0, unit);
  return true;
}

void find_representatives(Box& box) {
  std::map<std::array<double, 6>, Id> best;
  std::vector<std::array<double, 6>> places;
  for (Id i = 0; i < static_cast<Id>(box.n); ++i) {
    std::array<double, 6> place;
    for (std::size_t k = 0; k < 3; ++k) {
      const Dd at = box.at(i, k, 0);
      place[2 * k] = at.h + 0.0;
      place[2 * k + 1] = at.l + 0.0;
    }
    places.push_back(place);
    const auto [known, is_new] = best.emplace(place, i);
    if (!is_new && !box.weight.empty() && box.weight[i] > box.weight[known->second]) {
      known->second = i;
    }
  }
  for (Id i = 0; i < static_cast<Id>(box.n); ++i) {
    box.representative.push_back(best[places[static_cast<std::size_t>(i)]]);
    if (box.representative.back() == i) box.rows.push_back(i);
  }
}

// False if it is beyond the range.
bool put(const Cloud& cloud, Box& box) {
  box.n = cloud.n;
  std::copy(cloud.periods, cloud.periods + 3, box.period);
  box.weight = cloud.weights;
  for (double w : cloud.weights) {
    if (!std::isfinite(w)) return false;
  }
  for (double side : cloud.periods) {
    if (!std::isfinite(side)) return false;
  }
  for (std::size_t i = 0; i < cloud.n; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double v = k < cloud.dimension ? cloud.row(i)[k] : 0.0, side = box.period[k];
      if (!std::isfinite(v)) return false;
      if (side > 0 && std::fabs(v) >= std::ldexp(side, 52)) return false;
      box.anchor.push_back(side > 0 ? std::fmod(v, side) : v);
      box.shift.push_back(side > 0 && box.anchor.back() < 0 ? 1 : 0);
    }
  }
  if (!scale(box)) return false;
  find_representatives(box);
  return true;
}

struct Copy {
  Id row;
  Move move;
};

// The points of the box, then their copies at most `halo` beyond it.
std::vector<Copy> copies_of(const Box& box, const double* halo) {
  std::vector<Copy> out;
  for (Id row : box.rows) out.push_back({row, {0, 0, 0}});
  const auto near = [&](Id row, std::size_t k, int m) {
    if (m == 0) return true;
    if (!(box.period[k] > 0)) return false;
    if (halo[k] >= box.period[k]) return true;
    const double at = box.at(row, k, 0).h;
    return m < 0 ? at >= box.period[k] - halo[k] : at <= halo[k];
  };
  for (int code = 0; code < 27; ++code) {
    const Move m{code / 9 - 1, code / 3 % 3 - 1, code % 3 - 1};
    if (m == Move{0, 0, 0}) continue;
    for (Id row : box.rows) {
      if (near(row, 0, m[0]) && near(row, 1, m[1]) && near(row, 2, m[2])) out.push_back({row, m});
    }
  }
  return out;
}

// The cells at points in the box, of the triangulation of these and of copies.
struct Star {
  int dimension = -1;
  std::vector<Copy> copies;
  std::vector<Id> cells;
  alphamesh::Reach reach;
};

template <int D>
void fill_star(const alphamesh::Sites& sites, const alphamesh::Span& span, Id base, double heaviest,
               Star& star, Job& job) {
  alphamesh::SiteMesh<D> mesh(sites, span);
  mesh.insert_all(job);
  for (std::size_t c = 0; c < mesh.slots(); ++c) {
    const Id* v = mesh.cell(c).vertex;
    if (v[0] < 0 || !std::any_of(v, v + D + 1, [&](Id i) { return i < base; })) continue;
    if (mesh.finite(c)) {
      star.cells.insert(star.cells.end(), v, v + D + 1);
    } else {
      star.reach.open = true;
    }
  }
  star.reach.add<D>(sites, star.cells.data(), star.cells.size() / (D + 1), heaviest, job);
}

Star star_of(const Box& box, const double* halo, Job& job) {
  Star star;
  star.copies = copies_of(box, halo);
  alphamesh::Sites sites(star.copies.size());
  sites.set_unit(box.unit);
  double heaviest = -HUGE_VAL;
  for (std::size_t i = 0; i < star.copies.size(); ++i) {
    const Copy& c = star.copies[i];
    Dd position[3];
    for (std::size_t k = 0; k < 3; ++k) position[k] = box.at(c.row, k, c.move[k]);
    const double weight = box.weight.empty() ? 0.0 : box.weight[static_cast<std::size_t>(c.row)];
    sites.set(static_cast<Id>(i), position, weight);
    heaviest = std::max(heaviest, weight);
  }
  const alphamesh::Span span = alphamesh::span_of(sites, job);
  const Id base = static_cast<Id>(box.rows.size());
  star.dimension = span.dimension;
  if (span.dimension == 1) fill_star<1>(sites, span, base, heaviest, star, job);
  if (span.dimension == 2) fill_star<2>(sites, span, base, heaviest, star, job);
  if (span.dimension == 3) fill_star<3>(sites, span, base, heaviest, star, job);
  return star;
}

struct Corner {
  Id row;
  Move move;
  bool operator<(const Corner& o) const { return std::tie(row, move) < std::tie(o.row, o.move); }
  bool operator==(const Corner& o) const { return row == o.row && move == o.move; }
};
using Corners = std::vector<Corner>;

// One of all translates: ascending, the first one unmoved.
Corners normal(Corners corners) {
  std::sort(corners.begin(), corners.end());
  const Move first = corners[0].move;
  for (Corner& c : corners) c.move = c.move - first;
  return corners;
}

std::set<Corners> cells_of(const Star& star) {
  std::set<Corners> out;
  const auto columns = static_cast<std::size_t>(star.dimension + 1);
  for (std::size_t i = 0; i < star.cells.size(); i += columns) {
    Corners corners;
    for (std::size_t j = 0; j < columns; ++j) {
      const Copy& c = star.copies[static_cast<std::size_t>(star.cells[i + j])];
      corners.push_back({c.row, c.move});
    }
    out.insert(normal(corners));
  }
  return out;
}

struct Built {
  Box box;
  Star star;
  std::vector<Layer> layers;
  std::vector<Buffer<double>> radii;
  Buffer<Id> sides;  // the cells of each facet

  alphamesh::PeriodicBox view() const {
    const double* weight = box.weight.empty() ? nullptr : box.weight.data();
    return {box.anchor.data(),
            box.shift.data(),
            weight,
            {box.period[0], box.period[1], box.period[2]},
            box.exponent};
  }
};

// False where there is nothing to prove.
bool build(const Cloud& cloud, Built& out, Job& job) {
  if (cloud.n == 0 || !put(cloud, out.box)) return false;
  out.star = star_of(out.box, out.box.period, job);
  const int d = out.star.dimension;
  if (d < 1) return false;
  std::vector<Id> rows;
  std::vector<std::int8_t> offsets;
  for (const Copy& c : out.star.copies) {
    rows.push_back(c.row);
    for (int m : c.move) offsets.push_back(static_cast<std::int8_t>(m));
  }
  const alphamesh::Copies copies{rows.data(), offsets.data(), out.box.rows.size(), cloud.n};
  const Id* cells = out.star.cells.data();
  const std::size_t count = out.star.cells.size() / static_cast<std::size_t>(d + 1);
  if (d == 1) out.layers = alphamesh::quotient<1>(copies, cells, count, job);
  if (d == 2) out.layers = alphamesh::quotient<2>(copies, cells, count, job);
  if (d == 3) out.layers = alphamesh::quotient<3>(copies, cells, count, job);
  out.radii = alphamesh::periodic_radii(out.view(), out.layers, job);
  out.sides = alphamesh::cofaces(out.layers.back(), static_cast<std::size_t>(d + 1),
                                 out.layers[static_cast<std::size_t>(d - 1)].count);
  return true;
}

Corners corners_of(const Layer& layer, std::size_t k, std::size_t i) {
  Corners out;
  for (std::size_t j = 0; j <= k; ++j) {
    const std::size_t v = (k + 1) * i + j;
    const std::int8_t* o = &layer.offset[3 * v];
    out.push_back({layer.row[v], {o[0], o[1], o[2]}});
  }
  return out;
}

// All places that matter: every row moved by up to two periods, then the middle of the first
// cell likewise.
Geometry geometry_of(const Built& built) {
  const Box& box = built.box;
  Digits numbers;
  for (double v : box.anchor) numbers.add(v);
  for (double v : box.period) numbers.add(v);
  for (double w : box.weight) {
    if (w != 0.0) numbers.bottom = std::min(numbers.bottom, (lowest_bit(w) - 1) / 2 - 1);
  }
  const int shift = std::max(0, -numbers.bottom) + 2;
  std::vector<Vector<Wide>> places;
  std::vector<Vector<long double>> rounded;
  std::vector<double> weights;
  long double size = 0;
  const auto add = [&](const Corners& corners, const Move& move) {
    Vector<Wide> place;
    Vector<long double> near{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Wide period = Wide::of(box.period[k], shift - 2);
      for (const Corner& c : corners) {
        const std::size_t at = 3 * static_cast<std::size_t>(c.row) + k;
        const int m = box.shift[at] + c.move[k] + move[k];
        place[k] = place[k] + Wide::of(box.anchor[at], shift - 2) + Wide::of(m, 0) * period;
        near[k] += 0.25L * (box.anchor[at] + static_cast<long double>(m) * box.period[k]);
        size = std::max(size, std::fabs(static_cast<long double>(box.anchor[at])) +
                                  4 * static_cast<long double>(box.period[k]));
      }
    }
    places.push_back(place);
    rounded.push_back(near);
  };
  std::vector<Corners> points;
  for (Id i = 0; i < static_cast<Id>(box.n); ++i) {
    points.push_back(Corners(4, {i, {0, 0, 0}}));
  }
  Corners middle = corners_of(built.layers.back(), built.layers.size() - 1, 0);
  while (middle.size() < 4) middle.push_back(middle.back());
  points.push_back(middle);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int code = 0; code < 125; ++code) {
      add(points[i], {code / 25 - 2, code / 5 % 5 - 2, code % 5 - 2});
      if (!box.weight.empty()) weights.push_back(i < box.n ? box.weight[i] : 0.0);
    }
  }
  return Geometry(places, rounded, size, weights, shift);
}

class Proof {
 public:
  Proof(const Cloud& cloud, const Built& built, Job& job)
      : b_(built),
        job_(job),
        d_(built.layers.size() - 1),
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
      prove_value(g_, own[i].data(), k + 1, claims[i], kError);
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
      const double slack = reversed ? 0.0 : 2 * kError * std::fabs(value);
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
