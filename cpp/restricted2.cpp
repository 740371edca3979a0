#include "restricted2.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "voronoi2.hpp"

namespace alphamesh {
namespace {

using Id = std::int32_t;
constexpr double kPi = 3.14159265358979323846;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A cell's segment on the bisector with one neighbour: with weights, on their radical axis.
struct Segment {
  Id edge, row;      // the neighbour across
  Id before, after;  // triangles at its ends, -1 where it ends on the circle
  double half;       // half the distance to the neighbour
  double near;       // how far the bisector is; with weights, it may lie behind, below 0
  double from, to;   // ends along the bisector, from its foot on, counter-clockwise
  Point2 start, end;
};

class CellMaker {
 public:
  CellMaker(const ComplexView2& view, const bool* triangles, const bool* edges, double radius,
            const Rings2& rings, const Buffer<Point2>& centres)
      : view_(view),
        triangles_(triangles),
        edges_(edges),
        r_(radius),
        rings_(rings),
        centres_(centres) {}

  std::size_t count_pieces(Id v) const;
  void write(Id v, RestrictedCells2& out, std::size_t at);

 private:
  double radius(Id v) const;
  double foot(Id v, Id row) const;
  double half_chord(Id v, double distance) const;
  bool has_edge(Id e) const { return edges_[e]; }
  bool has_triangle(Id t) const { return t >= 0 && triangles_[t]; }
  void collect(Id v);
  Segment segment(Id v, Id edge, Id before, Id after) const;
  Point2 crossing(Id edge, double along) const;
  double centre_along(Id v, const Segment& s, Id triangle) const;
  double turn(Id v, Id from, Id to) const;

  const ComplexView2& view_;
  const bool* triangles_;  // which the complex has
  const bool* edges_;
  double r_;
  const Rings2& rings_;
  const Buffer<Point2>& centres_;
  std::vector<Segment> segments_;
};

// A segment each, and an arc after each that does not end in a triangle of the complex.
std::size_t CellMaker::count_pieces(Id v) const {
  std::size_t pieces = 0;
  for (std::int64_t i = rings_.offset[v]; i < rings_.offset[v + 1]; ++i) {
    if (!has_edge(rings_.edge[i])) continue;
    pieces += has_triangle(rings_.triangle[i]) ? 1 : 2;
  }
  return std::max<std::size_t>(1, pieces);
}

// The radius of the disc of a row.
double CellMaker::radius(Id v) const {
  if (view_.weights == nullptr || r_ * r_ == HUGE_VAL) return std::max(0.0, r_);
  return std::sqrt(std::max(0.0, view_.weight(v) + std::copysign(r_ * r_, r_)));
}

// Where the bisector crosses the line from v to a neighbour: which part of the way it is.
double CellMaker::foot(Id v, Id row) const {
  const Point2 a = view_.point(v), b = view_.point(row);
  const double dx = b.x - a.x, dy = b.y - a.y, change = view_.weight(v) - view_.weight(row);
  return 0.5 + 0.5 * change / (dx * dx + dy * dy);
}

// Where the circle around either end crosses the bisector: the same bits for both cells.
Point2 CellMaker::crossing(Id edge, double along) const {
  const Id* ends = view_.edges + 2 * edge;
  const Point2 a = view_.point(ends[0]), b = view_.point(ends[1]);
  const double dx = b.x - a.x, dy = b.y - a.y, length = std::sqrt(dx * dx + dy * dy);
  const double share = along / length, way = foot(ends[0], ends[1]);
  return {a.x + way * dx - share * dy, a.y + way * dy + share * dx};
}

// Position of a triangle's circumcentre along the bisector of v and s.row, positive to
// the left of the way from v to the neighbour: half times the cotangent of the angle at
// the apex, with the sign of the side on which the apex lies. Weights move it on.
double CellMaker::centre_along(Id v, const Segment& s, Id triangle) const {
  const Id* row = view_.triangles + 3 * static_cast<std::size_t>(triangle);
  Id apex = row[0];
  if (apex == v || apex == s.row) apex = row[1];
  if (apex == v || apex == s.row) apex = row[2];
  const Point2 a = view_.point(v), b = view_.point(s.row), c = view_.point(apex);
  double dot = (a.x - c.x) * (b.x - c.x) + (a.y - c.y) * (b.y - c.y);
  if (view_.weights != nullptr) {
    const double dx = b.x - a.x, dy = b.y - a.y;
    const double way = ((c.x - a.x) * dx + (c.y - a.y) * dy) / (dx * dx + dy * dy);
    dot += view_.weight(v) - view_.weight(apex) - way * (view_.weight(v) - view_.weight(s.row));
  }
  return s.half * (dot / cross_accurate(a, b, c));
}

// Half the chord of the circle at this distance from its centre; 0 from the radius on.
double CellMaker::half_chord(Id v, double distance) const {
  const double r = radius(v);
  const double less = std::max(0.0, r - distance), more = r + distance, square = less * more;
  return square < HUGE_VAL ? std::sqrt(square) : std::sqrt(less) * std::sqrt(more);
}

Segment CellMaker::segment(Id v, Id edge, Id before, Id after) const {
  Segment s{};
  s.edge = edge;
  s.row = view_.other_end(edge, v);
  s.before = has_triangle(before) ? before : -1;
  s.after = has_triangle(after) ? after : -1;
  const Point2 a = view_.point(v), b = view_.point(s.row);
  s.half = 0.5 * std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
  s.near = 2.0 * foot(v, s.row) * s.half;
  // As long, and left of the way from v, as seen from the lower row.
  const Id lower = view_.edges[2 * edge];
  const double distance = 2.0 * foot(lower, view_.edges[2 * edge + 1]) * s.half;
  const double reach = half_chord(lower, std::fabs(distance)), sign = v == lower ? 1.0 : -1.0;
  s.to = s.after >= 0 ? centre_along(v, s, s.after) : reach;
  s.from = s.before >= 0 ? centre_along(v, s, s.before) : -reach;
  s.end = s.after >= 0 ? centres_[static_cast<std::size_t>(s.after)] : crossing(edge, sign * reach);
  s.start =
      s.before >= 0 ? centres_[static_cast<std::size_t>(s.before)] : crossing(edge, -sign * reach);
  return s;
}

void CellMaker::collect(Id v) {
  segments_.clear();
  const std::int64_t begin = rings_.offset[v], end = rings_.offset[v + 1];
  for (std::int64_t i = begin; i < end; ++i) {
    const Id before = rings_.triangle[i == begin ? end - 1 : i - 1];
    if (has_edge(rings_.edge[i])) {
      segments_.push_back(segment(v, rings_.edge[i], before, rings_.triangle[i]));
    }
  }
}

// The angle from one neighbour to the next, counter-clockwise, in (0, 2 pi]. An exact
// sign keeps a rounded zero from becoming a full turn.
double CellMaker::turn(Id v, Id from, Id to) const {
  if (from == to) return 2.0 * kPi;
  const Point2 c = view_.point(v), a = view_.point(from), b = view_.point(to);
  const double dot = (a.x - c.x) * (b.x - c.x) + (a.y - c.y) * (b.y - c.y);
  const double angle = std::atan2(cross_accurate(c, a, b), dot);
  const int side = orient(c, a, b, Lattice());
  if (side == 0) return kPi;
  return side > 0 ? std::max(0.0, angle) : 2.0 * kPi + std::min(0.0, angle);
}

void CellMaker::write(Id v, RestrictedCells2& out, std::size_t at) {
  collect(v);
  const Point2 c = view_.point(v);
  const double r = radius(v);
  auto put = [&](Point2 start, Point2 end, Id neighbor, double from, double to) {
    out.start[at] = start;
    out.end[at] = end;
    out.neighbor[at] = neighbor;
    out.angles[2 * at] = from;
    out.angles[2 * at + 1] = to;
    ++at;
  };
  if (segments_.empty()) {
    const Point2 p{c.x + r, c.y};
    put(p, p, -1, 0.0, 2.0 * kPi);
    out.straight_area[v] = 0.0;
    out.segment_length[v] = 0.0;
    out.arc_length[v] = 2.0 * kPi * r;
    return;
  }
  double triangles = 0.0, length = 0.0, angles = 0.0;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const Segment& s = segments_[i];
    put(s.start, s.end, s.row, kNan, kNan);
    length += s.to - s.from;
    triangles += 0.5 * s.near * (s.to - s.from);
    if (s.after >= 0) continue;
    const Segment& next = segments_[(i + 1) % segments_.size()];
    const double used = std::atan2(s.to, s.near) + std::atan2(-next.from, next.near);
    const double angle = std::max(0.0, turn(v, s.row, next.row) - used);
    const double from = std::atan2(s.end.y - c.y, s.end.x - c.x);
    put(s.end, next.start, -1, from, from + angle);
    angles += angle;
  }
  out.straight_area[v] = triangles;
  out.segment_length[v] = length;
  out.arc_length[v] = angles * r;
}

}  // namespace

RestrictedCells2 restricted2(const ComplexView2& view, const bool* has_triangle,
                             const bool* has_edge, const bool* active, double radius, Job& job) {
  const Buffer<Id> triangle_edges = triangle_edges2(view, job);
  const Rings2 rings = rings2(view, triangle_edges, job);
  const Buffer<Point2> centres = voronoi_vertices2(view, job).position;
  RestrictedCells2 out;
  out.offset = Buffer<std::int64_t>(view.n + 1);
  out.straight_area = Buffer<double>(view.n);
  out.segment_length = Buffer<double>(view.n);
  out.arc_length = Buffer<double>(view.n);
  out.offset[0] = 0;
  const Parts parts(view.n, job, 2048);
  job.run(parts.count(), [&](std::size_t part) {
    const CellMaker maker(view, has_triangle, has_edge, radius, rings, centres);
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      const Id v = rings.order[i];
      out.offset[v + 1] = active[v] ? static_cast<std::int64_t>(maker.count_pieces(v)) : 0;
    }
  });
  for (std::size_t v = 0; v < view.n; ++v) out.offset[v + 1] += out.offset[v];
  const auto pieces = static_cast<std::size_t>(out.offset[view.n]);
  out.start = Buffer<Point2>(pieces);
  out.end = Buffer<Point2>(pieces);
  out.neighbor = Buffer<Id>(pieces);
  out.angles = Buffer<double>(2 * pieces);
  job.run(parts.count(), [&](std::size_t part) {
    CellMaker maker(view, has_triangle, has_edge, radius, rings, centres);
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      const Id v = rings.order[i];
      if (active[v]) {
        maker.write(v, out, static_cast<std::size_t>(out.offset[v]));
      } else {
        out.straight_area[v] = out.segment_length[v] = out.arc_length[v] = 0.0;
      }
    }
    job.advance(1.0 / static_cast<double>(parts.count()));
  });
  return out;
}

}  // namespace alphamesh
