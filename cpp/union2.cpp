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

Side side(Point2 to, Point2 from) { return {two_diff(to.x, from.x), two_diff(to.y, from.y)}; }
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
  Union2(const DiscsView& view, Job& job);
  UnionOfDiscs2 run();

 private:
  Point2 point(Id v) const { return {view_.points[2 * at(v)], view_.points[2 * at(v) + 1]}; }
  double weight(Id v) const { return view_.weights != nullptr ? view_.weights[v] : 0.0; }
  Lens lens(Id i, Id j) const;
  int open_sides(std::size_t e) const;
  TriangleRecord triangle(std::size_t t) const;
  EdgeRecord edge(std::size_t e) const;
  void add_edges();
  void add_triangles();
  void add_vertices();

  const DiscsView& view_;
  Job& job_;
  UnionOfDiscs2 out_;
  CarefulSum total_;
  Buffer<double> square_, radius_;  // of each disc
  Buffer<double> turn_;             // how much of its circle is on the boundary
  Buffer<bool> joined_, open_;      // discs with edges; those that have some of the boundary
};

Union2::Union2(const DiscsView& view, Job& job)
    : view_(view),
      job_(job),
      square_(view.n),
      radius_(view.n),
      turn_(view.n),
      joined_(view.n),
      open_(view.n) {
  out_.areas = Buffer<double>(view.n);
  out_.perimeters = Buffer<double>(view.n);
  out_.hole_areas = Buffer<double>(view.hole_count);
  out_.hole_perimeters = Buffer<double>(view.hole_count);
  std::fill(out_.areas.begin(), out_.areas.end(), 0.0);
  std::fill(out_.hole_areas.begin(), out_.hole_areas.end(), 0.0);
  std::fill(out_.hole_perimeters.begin(), out_.hole_perimeters.end(), 0.0);
  std::fill(turn_.begin(), turn_.end(), 2.0 * kPi);
  std::fill(joined_.begin(), joined_.end(), false);
  std::fill(open_.begin(), open_.end(), false);
  for (std::size_t v = 0; v < view.n; ++v) {
    square_[v] = std::max(0.0, weight(static_cast<Id>(v)) + view.power);
    radius_[v] = std::sqrt(square_[v]);
  }
}

Lens Union2::lens(Id i, Id j) const {
  const Point2 a = point(i), b = point(j);
  Lens out{};
  out.length = std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
  const double lean = (weight(i) - weight(j)) / out.length;
  out.from[0] = 0.5 * (out.length + lean);
  out.from[1] = 0.5 * (out.length - lean);
  // From the smaller disc, less cancels.
  const int k = square_[at(i)] <= square_[at(j)] ? 0 : 1;
  const double r = radius_[at(k == 0 ? i : j)], h = std::fabs(out.from[k]);
  out.chord = std::sqrt(std::max(0.0, (r - h) * (r + h)));
  out.half[0] = std::atan2(out.chord, out.from[0]);
  out.half[1] = lean == 0.0 ? out.half[0] : std::atan2(out.chord, out.from[1]);
  return out;
}

// Sides of an edge without a triangle of the complex.
int Union2::open_sides(std::size_t e) const {
  int open = 2;
  for (std::size_t k = 0; k < 2; ++k) {
    const Id t = view_.edge_triangles[2 * e + k];
    if (t >= 0 && view_.has_triangle[t]) --open;
  }
  return open;
}

EdgeRecord Union2::edge(std::size_t e) const {
  const Id i = view_.edges[2 * e], j = view_.edges[2 * e + 1];
  EdgeRecord out{{i, j}, {-1, -1}, {-1.0, -1.0}, {}, 0.0, 0.0, 0.0};
  const int open = open_sides(e);
  if (open == 0) return out;
  const Lens lens = this->lens(i, j);
  for (std::size_t k = 0; k < 2; ++k) {
    out.half[k] = open * lens.half[k];
    out.share[k] = 0.5 * open * lens.from[k] * lens.chord;
    const Id t = view_.edge_triangles[2 * e + k];
    out.hole[k] = t < 0 || view_.has_triangle[t] ? -1 : view_.hole[t];
    // What a flap takes from the holes on either side.
    const Id v = out.v[k];
    out.hole_perimeter -= radius_[at(v)] * lens.half[k];
    out.hole_area += 0.5 * square_[at(v)] * lens.half[k];
  }
  out.area = 0.5 * open * lens.length * lens.chord;
  out.hole_area -= 0.5 * lens.length * lens.chord;
  return out;
}

void Union2::add_edges() {
  in_waves<EdgeRecord>(
      view_.edge_count, job_, 0.45,
      [&](std::size_t e, std::vector<EdgeRecord>& records) {
        if (view_.has_edge[e]) records.push_back(edge(e));
      },
      [&](const EdgeRecord& record) {
        for (int k = 0; k < 2; ++k) {
          const std::size_t v = at(record.v[k]);
          joined_[v] = true;
          if (record.half[k] < 0.0) continue;
          open_[v] = true;
          turn_[v] -= record.half[k];
          out_.areas[v] += record.share[k];
          if (record.hole[k] < 0) continue;
          out_.hole_areas[at(record.hole[k])] += record.hole_area;
          out_.hole_perimeters[at(record.hole[k])] += record.hole_perimeter;
        }
        total_ += record.area;
      });
}

TriangleRecord Union2::triangle(std::size_t t) const {
  const Id* corner = view_.triangles + 3 * t;
  TriangleRecord out{};
  const Point2 p[3] = {point(corner[0]), point(corner[1]), point(corner[2])};
  const double size = std::fabs(cross_accurate(p[0], p[1], p[2]));
  const bool inside = view_.has_triangle[t];
  out.area = 0.5 * size;
  out.hole = inside ? -1 : view_.hole[t];
  if (!inside && view_.weights == nullptr) {  // the same radius all around: half a turn
    out.perimeter = kPi * radius_[at(corner[0])];
    out.area -= 0.5 * kPi * square_[at(corner[0])];
    return out;
  }
  for (int i = 0; i < 3; ++i) {
    const int j = kOther[i][0], k = kOther[i][1];
    out.v[i] = corner[i];
    const Point2 ij{p[j].x - p[i].x, p[j].y - p[i].y}, ik{p[k].x - p[i].x, p[k].y - p[i].y};
    const double across = ij.x * ik.x + ij.y * ik.y;
    if (!inside || open_[at(corner[i])]) out.angle[i] = std::atan2(size, across);
    if (!inside) {  // what a triangle of a hole adds to it, but for the flaps on its edges
      if (!view_.has_vertex[corner[i]]) continue;
      out.perimeter += radius_[at(corner[i])] * out.angle[i];
      out.area -= 0.5 * square_[at(corner[i])] * out.angle[i];
      continue;
    }
    // Kites between the corner, its edges' centres and the triangle's.
    const Point2 jk{p[k].x - p[j].x, p[k].y - p[j].y};
    const double sq_ij = ij.x * ij.x + ij.y * ij.y, sq_ik = ik.x * ik.x + ik.y * ik.y;
    double off_ij = ik.x * jk.x + ik.y * jk.y, off_ik = -(ij.x * jk.x + ij.y * jk.y);
    const double lean_ij = weight(corner[i]) - weight(corner[j]);
    const double lean_ik = weight(corner[i]) - weight(corner[k]);
    if (view_.weights != nullptr) {
      // Each share from its own end: the third corner may almost coincide with one of them.
      const double at_j = off_ik, at_k = off_ij;
      const double lean_jk = weight(corner[j]) - weight(corner[k]);
      off_ij += (at_j * lean_ik + across * lean_jk) / sq_ij;
      off_ik += (at_k * lean_ij - across * lean_jk) / sq_ik;
    }
    if (view_.weights != nullptr && !(size > kThin * std::sqrt(sq_ij * sq_ik))) {
      const Side u = side(p[j], p[i]), v = side(p[k], p[i]), w = side(p[k], p[j]);
      const Dd at_k = dot(v, w), at_j = dot(u, w), at_i = dot(u, v);
      const Dd ij = two_diff(weight(corner[i]), weight(corner[j]));
      const Dd ik = two_diff(weight(corner[i]), weight(corner[k]));
      const Dd jk = two_diff(weight(corner[j]), weight(corner[k]));
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
      view_.triangle_count, job_, 0.5,
      [&](std::size_t t, std::vector<TriangleRecord>& records) {
        if (view_.has_triangle[t] || view_.hole[t] >= 0) records.push_back(triangle(t));
      },
      [&](const TriangleRecord& record) {
        if (record.hole >= 0) {
          out_.hole_areas[at(record.hole)] += record.area;
          out_.hole_perimeters[at(record.hole)] += record.perimeter;
          return;
        }
        for (int k = 0; k < 3; ++k) {
          out_.areas[at(record.v[k])] += record.share[k];
          turn_[at(record.v[k])] -= record.angle[k];
        }
        total_ += record.area;
      });
}

void Union2::add_vertices() {
  for (std::size_t v = 0; v < view_.n; ++v) {
    double turn = 0.0;
    if (view_.has_vertex[v] && (open_[v] || !joined_[v])) {
      turn = std::max(0.0, std::min(2.0 * kPi, turn_[v]));
    }
    const double sector = 0.5 * square_[v] * turn;
    out_.perimeters[v] = radius_[v] * turn;
    out_.areas[v] = std::max(0.0, out_.areas[v] + sector);
    total_ += sector;
  }
  for (double& area : out_.hole_areas) area = std::max(0.0, area);
  for (double& perimeter : out_.hole_perimeters) perimeter = std::max(0.0, perimeter);
}

UnionOfDiscs2 Union2::run() {
  add_edges();
  add_triangles();
  add_vertices();
  out_.area = total_.value();
  return std::move(out_);
}

}  // namespace

UnionOfDiscs2 union2(const DiscsView& view, Job& job) { return Union2(view, job).run(); }

}  // namespace alphamesh
