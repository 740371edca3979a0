#include "union3.hpp"

#include <algorithm>
#include <cmath>

#include "balls3.hpp"
#include "waves.hpp"

// The union of balls is cut into pieces by the alpha complex (Edelsbrunner 1995): its
// tetrahedra; a flap on each side of a triangle that has no tetrahedron there, up to the
// point where the three spheres meet; what is left of the lens around each edge, a share of
// its full turn; and what is left of each ball, a share of its sphere. No ball is measured
// as a whole and then diminished, so that little cancels.
//
// The part of a ball in its power cell: pyramids over the facets of the cell, cut by the
// disc in which two spheres' balls meet, and the cone over the sphere's part of the boundary.
// The area of that part follows from the angles around it (Gauss and Bonnet).

namespace alphamesh {
namespace {

using Id = std::int32_t;
using Vector = Vector3<double>;
constexpr double kPi = 3.14159265358979323846;

// The ends of each edge of a tetrahedron.
constexpr int kEdge[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

std::size_t at(Id i) { return static_cast<std::size_t>(i); }

// What a piece adds to a void: a tetrahedron itself, less what the balls have of it.
struct Hollow {
  double area = 0.0, volume = 0.0;

  void sphere(double square, double radius, double angle) {
    area += square * angle;
    volume -= square * radius * angle / 3.0;
  }
  void edge(const Balls3& balls, const Lens& lens, Id i, Id j, double angle) {
    const double a = lens.from[0] * balls.radius(i), b = lens.from[1] * balls.radius(j);
    area += (a + b) * angle;
    volume -= (a * balls.radius(i) + b * balls.radius(j)) * angle / 3.0 +
              lens.length * lens.circle * lens.circle * angle / 6.0;
  }
};

struct FlapRecord {
  Id v[3], e[3];
  Id hollow[2];  // of each side
  double half[3], turn[3], share[3], volume;
  Hollow hole;
};

struct CellRecord {
  Id v[4], e[6];  // edges: -1 where the angle is not asked for
  Id hollow;
  double share[4], angle[6], volume;
  Hollow hole;
};

class Union3 {
 public:
  Union3(const UnionView& view, Job& job);
  UnionMeasures run();

 private:
  void note_voids(std::size_t f, const Flap& flap, FlapRecord& out) const;
  void count();
  void add_triangles();
  void add_tetrahedra();
  void add_edges();
  void add_vertices();
  CellRecord cell(std::size_t t) const;
  void measure_void(std::size_t t, CellRecord& out) const;
  void finish_voids();
  Id cell_edge(std::size_t t, int k) const;
  bool has_vertex(Id v) const { return view_.has_vertex[balls_.row(v)]; }

  const UnionView& view_;
  Job& job_;
  UnionMeasures out_;
  CarefulSum total_;
  Balls3 balls_;
  Buffer<Id> euler_;            // Euler characteristic of each sphere's part of the boundary
  Buffer<std::uint8_t> state_;  // of each edge: kSpanned, kOpen
  Buffer<double> turn_;         // of each edge: how much of its circle is on the boundary
  Buffer<Id> edge_hollow_;      // of each edge outside of the complex: its void
  static constexpr std::uint8_t kSpanned = 1, kOpen = 2;
};

Union3::Union3(const UnionView& view, Job& job)
    : view_(view),
      job_(job),
      out_(view.centres.balls, view.holes),
      balls_(view.centres),
      euler_(view.centres.balls),
      state_(view.edges.count),
      turn_(view.edges.count),
      edge_hollow_(view.holes > 0 ? view.edges.count : 0) {
  std::fill(euler_.begin(), euler_.end(), 2);
  std::fill(state_.begin(), state_.end(), std::uint8_t{0});
  std::fill(turn_.begin(), turn_.end(), 2.0 * kPi);
  std::fill(edge_hollow_.begin(), edge_hollow_.end(), -1);
}

// The boundary on a sphere is what the link of its vertex leaves of it.
void Union3::count() {
  for (std::size_t e = 0; e < view_.edges.count; ++e) {
    if (!view_.edges.has[e]) continue;
    for (std::size_t k = 0; k < 2; ++k) --euler_[balls_.row(view_.edges.corner[2 * e + k])];
  }
  job_.poll();
  for (std::size_t f = 0; f < view_.triangles.count; ++f) {
    if (!view_.triangles.has[f]) continue;
    const std::uint8_t state =
        view_.open_sides(f, view_.tetrahedra) > 0 ? kSpanned | kOpen : kSpanned;
    for (std::size_t k = 0; k < 3; ++k) {
      ++euler_[balls_.row(view_.triangles.corner[3 * f + k])];
      state_[at(view_.triangles.side[3 * f + k])] |= state;
    }
  }
  job_.poll();
  for (std::size_t t = 0; t < view_.tetrahedra.count; ++t) {
    if (!view_.tetrahedra.has[t]) continue;
    for (std::size_t k = 0; k < 4; ++k) --euler_[balls_.row(view_.tetrahedra.corner[4 * t + k])];
  }
  for (std::size_t e = 0; e < view_.edges.count; ++e) {
    if (view_.edges.has[e] && state_[e] == 0) state_[e] = kOpen;
  }
}

// What a flap takes from the voids on either side of its triangle.
void Union3::note_voids(std::size_t f, const Flap& flap, FlapRecord& out) const {
  for (std::size_t k = 0; k < 2; ++k) {
    const Id t = view_.cofaces[2 * f + k];
    out.hollow[k] = t < 0 || view_.tetrahedra.has[t] ? -1 : view_.hole[t];
  }
  if (out.hollow[0] < 0 && out.hollow[1] < 0) return;
  out.hole.volume = -flap.area * flap.height / 3.0;
  for (int k = 0; k < 3; ++k) {
    out.hole.edge(balls_, flap.lens[k], out.v[kEndsOf[k][0]], out.v[kEndsOf[k][1]], -flap.half[k]);
    out.hole.sphere(balls_.square(out.v[k]), balls_.radius(out.v[k]), -flap.turn[k]);
  }
}

void Union3::add_triangles() {
  in_waves<FlapRecord>(
      view_.triangles.count, job_, 0.4,
      [&](std::size_t f, std::vector<FlapRecord>& records) {
        if (!view_.triangles.has[f]) return;
        const int open = view_.open_sides(f, view_.tetrahedra);
        if (open == 0) return;
        const Flap flap = balls_.flap(view_.triangles.corner + 3 * f);
        FlapRecord record{};
        for (std::size_t k = 0; k < 3; ++k) {
          record.v[k] = view_.triangles.corner[3 * f + k];
          record.e[k] = view_.triangles.side[3 * f + k];
          record.half[k] = open * flap.half[k];
          record.turn[k] = open * flap.turn[k];
          record.share[k] = open * flap.share[k] * flap.height / 3.0;
        }
        record.volume = open * flap.area * flap.height / 3.0;
        note_voids(f, flap, record);
        records.push_back(record);
      },
      [&](const FlapRecord& record) {
        for (int k = 0; k < 3; ++k) {
          const std::size_t v = balls_.row(record.v[k]);
          turn_[at(record.e[k])] -= record.half[k];
          out_.borders[v] -= balls_.radius(record.v[k]) * record.turn[k];
          out_.contents[v] += record.share[k];
        }
        total_ += record.volume;
        for (const Id hollow : record.hollow) {
          if (hollow < 0) continue;
          out_.hole_borders[at(hollow)] += record.hole.area;
          out_.hole_contents[at(hollow)] += record.hole.volume;
        }
      });
}

// The edge between two corners of a tetrahedron.
Id Union3::cell_edge(std::size_t t, int k) const {
  const int a = kEdge[k][0], b = kEdge[k][1];
  // In a face with both, the edge is opposite to the third corner.
  const int away = a > 0 ? 0 : (b > 1 ? 1 : 2), third = 6 - a - b - away;
  const std::size_t f = at(view_.tetrahedra.side[4 * t + at(away)]);
  return view_.triangles.side[3 * f + at(third > away ? third - 1 : third)];
}

// What a tetrahedron outside of the complex adds to its void, but for the flaps on its faces.
void Union3::measure_void(std::size_t t, CellRecord& out) const {
  const Id* corner = view_.tetrahedra.corner + 4 * t;
  out.hole.volume = out.volume;
  for (int k = 0; k < 4; ++k) {
    if (!has_vertex(corner[k])) continue;
    out.hole.sphere(balls_.square(corner[k]), balls_.radius(corner[k]), 2.0 * kPi);
  }
  for (int k = 0; k < 6; ++k) {
    const Id i = corner[kEdge[k][0]], j = corner[kEdge[k][1]];
    if (view_.edges.has[out.e[k]]) out.hole.edge(balls_, balls_.lens(i, j), i, j, out.angle[k]);
  }
}

CellRecord Union3::cell(std::size_t t) const {
  const Id* corner = view_.tetrahedra.corner + 4 * t;
  CellRecord out{};
  const Place3 p[4] = {balls_.place(corner[0]), balls_.place(corner[1]), balls_.place(corner[2]),
                       balls_.place(corner[3])};
  Vector normal[4];
  const Vector u = p[1] - p[0], v = p[2] - p[0], w = p[3] - p[0];
  const double sizes = norm(u) * norm(v) * norm(w);
  double det = dot(cross(u, v), w);
  const bool thin = !(std::fabs(det) > kThin * sizes);
  if (thin) det = volume_accurate(p[0], p[1], p[2], p[3]);
  for (int k = 0; k < 4; ++k) {  // inward
    const Place3 &a = p[kFaceOf[k][0]], &b = p[kFaceOf[k][1]], &c = p[kFaceOf[k][2]];
    const Vector along = b - a, across = c - a;
    normal[k] = cross(along, across);
    // Two far corners may almost coincide.
    if (thin ||
        !(dot(normal[k], normal[k]) > kThin * kThin * dot(along, along) * dot(across, across))) {
      normal[k] = normal_accurate(a, b, c);
    }
    if ((k % 2 == 0) == (det > 0.0)) normal[k] = {-normal[k].x, -normal[k].y, -normal[k].z};
  }
  const double size = std::fabs(det);
  const bool inside = view_.tetrahedra.has[t];
  out.hollow = inside ? -1 : view_.hole[t];
  out.volume = size / 6.0;
  for (int k = 0; k < 4; ++k) out.v[k] = corner[k];
  for (int k = 0; k < 6; ++k) {
    const int a = kEdge[k][0], b = kEdge[k][1];
    out.e[k] = cell_edge(t, k);
    if (inside ? state_[at(out.e[k])] == kSpanned : !view_.edges.has[out.e[k]]) {
      if (inside) out.e[k] = -1;
      continue;
    }
    int c = 0;
    while (c == a || c == b) ++c;
    const int d = 6 - a - b - c;
    out.angle[k] = std::atan2(size * norm(p[b] - p[a]), -dot(normal[c], normal[d]));
  }
  if (inside) {
    balls_.share_cell(corner, normal, size, out.share);
  } else {
    measure_void(t, out);
  }
  return out;
}

void Union3::add_tetrahedra() {
  in_waves<CellRecord>(
      view_.tetrahedra.count, job_, 0.5,
      [&](std::size_t t, std::vector<CellRecord>& records) {
        if (view_.tetrahedra.has[t] || view_.hole[t] >= 0) records.push_back(cell(t));
      },
      [&](const CellRecord& record) {
        if (record.hollow >= 0) {
          out_.hole_contents[at(record.hollow)] += record.hole.volume;
          out_.hole_borders[at(record.hollow)] += record.hole.area;
          for (const Id e : record.e) edge_hollow_[at(e)] = record.hollow;
          return;
        }
        for (int k = 0; k < 4; ++k) out_.contents[balls_.row(record.v[k])] += record.share[k];
        for (int k = 0; k < 6; ++k) {
          if (record.e[k] >= 0) turn_[at(record.e[k])] -= record.angle[k];
        }
        total_ += record.volume;
      });
}

void Union3::add_edges() {
  for (std::size_t e = 0; e < view_.edges.count; ++e) {
    if ((e & 0xffff) == 0) job_.poll();
    if (!view_.edges.has[e] || state_[e] == kSpanned) continue;
    const Id* end = view_.edges.corner + 2 * e;
    const Lens lens = balls_.lens(end[0], end[1]);
    const double turn = std::max(0.0, std::min(2.0 * kPi, turn_[e]));
    const double disc = lens.circle * lens.circle * turn / 6.0;
    for (std::size_t k = 0; k < 2; ++k) {
      out_.contents[balls_.row(end[k])] += lens.from[k] * disc;
      out_.borders[balls_.row(end[k])] += lens.from[k] * turn;
    }
    total_ += lens.length * disc;
  }
}

void Union3::add_vertices() {
  Buffer<bool> open(view_.centres.balls);
  std::fill(open.begin(), open.end(), false);
  Buffer<bool> joined(view_.centres.balls);
  std::fill(joined.begin(), joined.end(), false);
  for (std::size_t e = 0; e < view_.edges.count; ++e) {
    if (!view_.edges.has[e]) continue;
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t v = balls_.row(view_.edges.corner[2 * e + k]);
      joined[v] = true;
      if (state_[e] != kSpanned) open[v] = true;
    }
  }
  for (std::size_t v = 0; v < view_.centres.balls; ++v) {
    double& area = out_.borders[v];
    const double radius = balls_.radius(static_cast<Id>(v));
    if (!view_.has_vertex[v] || (joined[v] && !open[v])) {
      area = 0.0;
    } else {
      area = std::max(0.0, radius * (2.0 * kPi * euler_[v] * radius + area));
      area = std::min(area, 4.0 * kPi * radius * radius);
    }
    const double cone = radius * area / 3.0;
    out_.contents[v] = std::max(0.0, out_.contents[v] + cone);
    total_ += cone;
  }
}

// Each sphere's part of a void's boundary has as many pieces, less holes, as the tetrahedra,
// triangles and edges of the void around its vertex tell.
void Union3::finish_voids() {
  auto add = [&](Id hollow, Id v, double sign) {
    if (!has_vertex(v)) return;
    const double area = sign * 2.0 * kPi * balls_.square(v);
    out_.hole_borders[at(hollow)] += area;
    out_.hole_contents[at(hollow)] -= balls_.radius(v) * area / 3.0;
  };
  for (std::size_t f = 0; f < view_.triangles.count; ++f) {
    const Id t = view_.cofaces[2 * f];
    if (view_.triangles.has[f] || t < 0 || view_.hole[t] < 0) continue;
    for (std::size_t k = 0; k < 3; ++k) add(view_.hole[t], view_.triangles.corner[3 * f + k], -1.0);
  }
  for (std::size_t e = 0; e < view_.edges.count; ++e) {
    if (view_.edges.has[e] || edge_hollow_[e] < 0) continue;
    for (std::size_t k = 0; k < 2; ++k) add(edge_hollow_[e], view_.edges.corner[2 * e + k], 1.0);
  }
  out_.trim_holes();
}

UnionMeasures Union3::run() {
  count();
  job_.advance(0.05);
  add_triangles();
  add_tetrahedra();
  add_edges();
  add_vertices();
  if (view_.holes > 0) finish_voids();
  out_.content = total_.value();
  return std::move(out_);
}

}  // namespace

UnionMeasures union3(const UnionView& view, Job& job) { return Union3(view, job).run(); }

}  // namespace alphamesh
