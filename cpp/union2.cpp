#include "union2.hpp"

#include <algorithm>
#include <cmath>

#include "exact.hpp"
#include "predicates2.hpp"
#include "waves.hpp"

// The union of discs is cut into pieces by the alpha complex, see union3.cpp: its triangles;
// a flap on each side of an edge that has no triangle there, up to the point where the two
// circles meet; and what is left of each disc, a share of its full turn.

namespace alphamesh {
namespace {

using Id = std::int32_t;
constexpr double kPi = 3.14159265358979323846;
constexpr int kOther[3][2] = {{1, 2}, {0, 2}, {0, 1}};

std::size_t at(Id i) { return static_cast<std::size_t>(i); }

// From one point to another, exactly.
struct Side {
  Dd x, y;
};

Side side(const Place2& to, const Place2& from) {
  return {wide_difference(to.x(), from.x()), wide_difference(to.y(), from.y())};
}
Dd dot(const Side& a, const Side& b) { return a.x * b.x + a.y * b.y; }

// Below this share of its greatest possible value, the area of a triangle is so small that
// what is divided by it needs twice the digits.
constexpr double kThin = 1.0 / 128.0;

// Two discs: the distances of their radical line from the two centres, half their common
// chord, and half the angle that each centre sees it under.
struct Lens {
  double length, from[2], chord, half[2];
};

struct EdgeRecord {
  Id v[2], hole[2];
  double half[2], share[2], area, hole_area, hole_perimeter;
};

struct TriangleRecord {
  Id v[3], hole;
  double share[3], angle[3], area, perimeter;
};

class Union2 {
 public:
  Union2(const UnionView& view, Job& job);
  UnionMeasures run();

 private:
  Place2 place(Id v) const {
    const double* h = view_.centres.high + 2 * at(v);
    if (view_.centres.low == nullptr) return {{h[0], h[1]}, {0.0, 0.0}};
    const double* l = view_.centres.low + 2 * at(v);
    return {{h[0], h[1]}, {l[0], l[1]}};
  }
  Lens lens(Id i, Id j) const;
  TriangleRecord triangle(std::size_t t) const;
  EdgeRecord edge(std::size_t e) const;
  void add_edges();
  void add_triangles();
  void add_vertices();

  const UnionView& view_;
  Job& job_;
  UnionMeasures out_;
  CarefulSum total_;
  Balls balls_;
  Buffer<double> turn_;         // how much of its circle is on the boundary
  Buffer<bool> joined_, open_;  // discs with edges; those that have some of the boundary
};

Union2::Union2(const UnionView& view, Job& job)
    : view_(view),
      job_(job),
      out_(view.centres.balls, view.holes),
      balls_(view.centres),
      turn_(view.centres.balls),
      joined_(view.centres.balls),
      open_(view.centres.balls) {
  std::fill(turn_.begin(), turn_.end(), 2.0 * kPi);
  std::fill(joined_.begin(), joined_.end(), false);
  std::fill(open_.begin(), open_.end(), false);
}

Lens Union2::lens(Id i, Id j) const {
  const Point2 d = place(j) - place(i);
  Lens out{};
  out.length = std::sqrt(d.x * d.x + d.y * d.y);
  const double lean = (balls_.weight(i) - balls_.weight(j)) / out.length;
  out.from[0] = 0.5 * (out.length + lean);
  out.from[1] = 0.5 * (out.length - lean);
  // From the smaller disc, less cancels.
  const int k = balls_.square(i) <= balls_.square(j) ? 0 : 1;
  const double r = balls_.radius(k == 0 ? i : j), h = std::fabs(out.from[k]);
  out.chord = std::sqrt(std::max(0.0, (r - h) * (r + h)));
  out.half[0] = std::atan2(out.chord, out.from[0]);
  out.half[1] = lean == 0.0 ? out.half[0] : std::atan2(out.chord, out.from[1]);
  return out;
}

EdgeRecord Union2::edge(std::size_t e) const {
  const Id i = view_.edges.corner[2 * e], j = view_.edges.corner[2 * e + 1];
  EdgeRecord out{{i, j}, {-1, -1}, {-1.0, -1.0}, {}, 0.0, 0.0, 0.0};
  const int open = view_.open_sides(e, view_.triangles);
  if (open == 0) return out;
  const Lens lens = this->lens(i, j);
  for (std::size_t k = 0; k < 2; ++k) {
    out.half[k] = open * lens.half[k];
    out.share[k] = 0.5 * open * lens.from[k] * lens.chord;
    const Id t = view_.cofaces[2 * e + k];
    out.hole[k] = t < 0 || view_.triangles.has[t] ? -1 : view_.hole[t];
    // What a flap takes from the holes on either side.
    const Id v = out.v[k];
    out.hole_perimeter -= balls_.radius(v) * lens.half[k];
    out.hole_area += 0.5 * balls_.square(v) * lens.half[k];
  }
  out.area = 0.5 * open * lens.length * lens.chord;
  out.hole_area -= 0.5 * lens.length * lens.chord;
  return out;
}

void Union2::add_edges() {
  in_waves<EdgeRecord>(
      view_.edges.count, job_, 0.45,
      [&](std::size_t e, std::vector<EdgeRecord>& records) {
        if (view_.edges.has[e]) records.push_back(edge(e));
      },
      [&](const EdgeRecord& record) {
        for (int k = 0; k < 2; ++k) {
          const std::size_t v = balls_.row(record.v[k]);
          joined_[v] = true;
          if (record.half[k] < 0.0) continue;
          open_[v] = true;
          turn_[v] -= record.half[k];
          out_.contents[v] += record.share[k];
          if (record.hole[k] < 0) continue;
          out_.hole_contents[at(record.hole[k])] += record.hole_area;
          out_.hole_borders[at(record.hole[k])] += record.hole_perimeter;
        }
        total_ += record.area;
      });
}

TriangleRecord Union2::triangle(std::size_t t) const {
  const Id* corner = view_.triangles.corner + 3 * t;
  TriangleRecord out{};
  const Place2 p[3] = {place(corner[0]), place(corner[1]), place(corner[2])};
  const double size = std::fabs(cross_accurate(p[0], p[1], p[2]));
  const bool inside = view_.triangles.has[t];
  out.area = 0.5 * size;
  out.hole = inside ? -1 : view_.hole[t];
  if (!inside && !balls_.weighted()) {  // the same radius all around: half a turn
    out.perimeter = kPi * balls_.radius(corner[0]);
    out.area -= 0.5 * kPi * balls_.square(corner[0]);
    return out;
  }
  for (int i = 0; i < 3; ++i) {
    const int j = kOther[i][0], k = kOther[i][1];
    out.v[i] = corner[i];
    const Point2 ij = p[j] - p[i], ik = p[k] - p[i];
    const double across = ij.x * ik.x + ij.y * ik.y;
    if (!inside || open_[balls_.row(corner[i])]) out.angle[i] = std::atan2(size, across);
    if (!inside) {  // what a triangle of a hole adds to it, but for the flaps on its edges
      if (!view_.has_vertex[balls_.row(corner[i])]) continue;
      out.perimeter += balls_.radius(corner[i]) * out.angle[i];
      out.area -= 0.5 * balls_.square(corner[i]) * out.angle[i];
      continue;
    }
    // Kites between the corner, its edges' centres and the triangle's.
    const Point2 jk = p[k] - p[j];
    const double sq_ij = ij.x * ij.x + ij.y * ij.y, sq_ik = ik.x * ik.x + ik.y * ik.y;
    double off_ij = ik.x * jk.x + ik.y * jk.y, off_ik = -(ij.x * jk.x + ij.y * jk.y);
    const double lean_ij = balls_.weight(corner[i]) - balls_.weight(corner[j]);
    const double lean_ik = balls_.weight(corner[i]) - balls_.weight(corner[k]);
    if (balls_.weighted()) {
      // Each share from its own end: the third corner may almost coincide with one of them.
      const double at_j = off_ik, at_k = off_ij;
      const double lean_jk = balls_.weight(corner[j]) - balls_.weight(corner[k]);
      off_ij += (at_j * lean_ik + across * lean_jk) / sq_ij;
      off_ik += (at_k * lean_ij - across * lean_jk) / sq_ik;
    }
    if (balls_.weighted() && !(size > kThin * std::sqrt(sq_ij * sq_ik))) {
      const Side u = side(p[j], p[i]), v = side(p[k], p[i]), w = side(p[k], p[j]);
      const Dd at_k = dot(v, w), at_j = dot(u, w), at_i = dot(u, v);
      const Dd ij = two_diff(balls_.weight(corner[i]), balls_.weight(corner[j]));
      const Dd ik = two_diff(balls_.weight(corner[i]), balls_.weight(corner[k]));
      const Dd jk = two_diff(balls_.weight(corner[j]), balls_.weight(corner[k]));
      off_ij = (at_k * dot(u, u) - at_j * ik + at_i * jk).h / sq_ij;
      off_ik = (at_k * ij - at_j * dot(v, v) - at_i * jk).h / sq_ik;
    }
    out.share[i] =
        0.125 * ((sq_ij + lean_ij) * (off_ij / size) + (sq_ik + lean_ik) * (off_ik / size));
  }
  return out;
}

void Union2::add_triangles() {
  in_waves<TriangleRecord>(
      view_.triangles.count, job_, 0.5,
      [&](std::size_t t, std::vector<TriangleRecord>& records) {
        if (view_.triangles.has[t] || view_.hole[t] >= 0) records.push_back(triangle(t));
      },
      [&](const TriangleRecord& record) {
        if (record.hole >= 0) {
          out_.hole_contents[at(record.hole)] += record.area;
          out_.hole_borders[at(record.hole)] += record.perimeter;
          return;
        }
        for (int k = 0; k < 3; ++k) {
          out_.contents[balls_.row(record.v[k])] += record.share[k];
          turn_[balls_.row(record.v[k])] -= record.angle[k];
        }
        total_ += record.area;
      });
}

void Union2::add_vertices() {
  for (std::size_t v = 0; v < view_.centres.balls; ++v) {
    double turn = 0.0;
    if (view_.has_vertex[v] && (open_[v] || !joined_[v])) {
      turn = std::max(0.0, std::min(2.0 * kPi, turn_[v]));
    }
    const double sector = 0.5 * balls_.square(static_cast<Id>(v)) * turn;
    out_.borders[v] = balls_.radius(static_cast<Id>(v)) * turn;
    out_.contents[v] = std::max(0.0, out_.contents[v] + sector);
    total_ += sector;
  }
  out_.trim_holes();
}

UnionMeasures Union2::run() {
  add_edges();
  add_triangles();
  add_vertices();
  out_.content = total_.value();
  return std::move(out_);
}

}  // namespace

UnionMeasures union2(const UnionView& view, Job& job) { return Union2(view, job).run(); }

}  // namespace alphamesh
