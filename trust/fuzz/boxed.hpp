// A cloud in a periodic box, and what the core makes of it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "exact.hpp"
#include "periodic_values.hpp"
#include "quotient.hpp"
#include "reach.hpp"
#include "site_mesh.hpp"
#include "sites.hpp"

namespace trust {

constexpr int kTop = 100, kBottom = -170;  // as in alphamesh.periodic

using Move = std::array<int, 3>;  // by so many periods

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
  alphamesh::Dd at(Id row, std::size_t axis, int move) const {
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

inline bool scale(Box& box) {
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

inline void find_representatives(Box& box) {
  std::map<std::array<double, 6>, Id> best;
  std::vector<std::array<double, 6>> places;
  for (Id i = 0; i < static_cast<Id>(box.n); ++i) {
    std::array<double, 6> place;
    for (std::size_t k = 0; k < 3; ++k) {
      const alphamesh::Dd at = box.at(i, k, 0);
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
inline bool put(const Cloud& cloud, Box& box) {
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
inline std::vector<Copy> copies_of(const Box& box, const double* halo) {
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
               Star& star, alphamesh::Job& job) {
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

inline Star star_of(const Box& box, const double* halo, alphamesh::Job& job) {
  Star star;
  star.copies = copies_of(box, halo);
  alphamesh::Sites sites(star.copies.size());
  sites.set_unit(box.unit);
  double heaviest = -HUGE_VAL;
  for (std::size_t i = 0; i < star.copies.size(); ++i) {
    const Copy& c = star.copies[i];
    alphamesh::Dd position[3];
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
inline Corners normal(Corners corners) {
  std::sort(corners.begin(), corners.end());
  const Move first = corners[0].move;
  for (Corner& c : corners) c.move = c.move - first;
  return corners;
}

inline std::set<Corners> cells_of(const Star& star) {
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
  std::vector<alphamesh::Layer> layers;
  std::vector<alphamesh::Buffer<double>> radii;
  alphamesh::Buffer<Id> sides;  // the cells of each facet

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
inline bool build(const Cloud& cloud, Built& out, alphamesh::Job& job) {
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

inline Corners corners_of(const alphamesh::Layer& layer, std::size_t k, std::size_t i) {
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
inline Geometry geometry_of(const Built& built) {
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

}  // namespace trust
