#include "union3.hpp"

#include <algorithm>
#include <cmath>

#include "predicates3.hpp"
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
// Below this share of their greatest possible value, normals and volumes are computed again
// with twice the digits.
constexpr double kThin = 1.0 / 128.0;

// The corners of an edge or a face, and the ends of the edge opposite to a corner.
constexpr int kFace[4][3] = {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}};
constexpr int kOther[3][2] = {{1, 2}, {0, 2}, {0, 1}};
constexpr int kEdge[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

std::size_t at(Id i) { return static_cast<std::size_t>(i); }

// Two balls: the distances of their radical plane from the two centres, and the radius of
// the circle in which the spheres meet.
struct Lens {
  double length, from[2], circle;
};

// Three balls: half angles of the arcs that each cuts from the circle of the other two,
// angles at which the other two cross on its sphere, and how much of the triangle belongs
// to it; the height above the triangle at which the spheres meet, and the triangle's area.
struct Flap {
  Lens lens[3];
  double half[3], turn[3], share[3], height, area;
};

struct FlapRecord {
  Id v[3], e[3];
  double half[3], turn[3], share[3], volume;
};

struct CellRecord {
  Id v[4], e[6];  // edges: -1 where the angle is not asked for
  Id hollow;
  double share[4], angle[6], volume, area;
};

class Union3 {
 public:
  Union3(const BallsView& view, Job& job);
  UnionOfBalls3 run();

 private:
  Point3 point(Id v) const {
    const double* p = view_.points + 3 * at(v);
    return {p[0], p[1], p[2]};
  }
  double weight(Id v) const { return view_.weights != nullptr ? view_.weights[v] : 0.0; }
  Lens lens(Id i, Id j) const;
  Flap flap(const Id* corner) const;
  int open_sides(std::size_t f) const;
  void count();
  void add_triangles();
  void add_tetrahedra();
  void add_edges();
  void add_vertices();
  CellRecord cell(std::size_t t) const;
  void share_cell(const Id* corner, const Vector* normal, double det, CellRecord& out) const;
  void measure_void(std::size_t t, CellRecord& out) const;
  void finish_voids();
  Id cell_edge(std::size_t t, int k) const;

  const BallsView& view_;
  Job& job_;
  UnionOfBalls3 out_;
  CarefulSum total_;
  Buffer<double> square_, radius_;  // of each ball
  Buffer<Id> euler_;                // Euler characteristic of each sphere's part of the boundary
  Buffer<std::uint8_t> state_;      // of each edge: kSpanned, kOpen
  Buffer<double> turn_;             // of each edge: how much of its circle is on the boundary
  Buffer<Id> edge_hollow_;          // of each edge outside of the complex: its void
  static constexpr std::uint8_t kSpanned = 1, kOpen = 2;
};

Union3::Union3(const BallsView& view, Job& job)
    : view_(view),
      job_(job),
      square_(view.n),
      radius_(view.n),
      euler_(view.n),
      state_(view.edge_count),
      turn_(view.edge_count),
      edge_hollow_(view.void_count > 0 ? view.edge_count : 0) {
  out_.volumes = Buffer<double>(view.n);
  out_.surface_areas = Buffer<double>(view.n);
  out_.void_volumes = Buffer<double>(view.void_count);
  out_.void_areas = Buffer<double>(view.void_count);
  std::fill(out_.volumes.begin(), out_.volumes.end(), 0.0);
  std::fill(out_.surface_areas.begin(), out_.surface_areas.end(), 0.0);
  std::fill(out_.void_volumes.begin(), out_.void_volumes.end(), 0.0);
  std::fill(out_.void_areas.begin(), out_.void_areas.end(), 0.0);
  std::fill(euler_.begin(), euler_.end(), 2);
  std::fill(state_.begin(), state_.end(), std::uint8_t{0});
  std::fill(turn_.begin(), turn_.end(), 2.0 * kPi);
  std::fill(edge_hollow_.begin(), edge_hollow_.end(), -1);
  for (std::size_t v = 0; v < view.n; ++v) {
    square_[v] = std::max(0.0, weight(static_cast<Id>(v)) + view.power);
    radius_[v] = std::sqrt(square_[v]);
  }
}

Lens Union3::lens(Id i, Id j) const {
  Lens out{};
  out.length = norm(point(j) - point(i));
  const double lean = (weight(i) - weight(j)) / out.length;
  out.from[0] = 0.5 * (out.length + lean);
  out.from[1] = 0.5 * (out.length - lean);
  // From the smaller ball, less cancels.
  const int k = square_[at(i)] <= square_[at(j)] ? 0 : 1;
  const double r = radius_[at(k == 0 ? i : j)], h = std::fabs(out.from[k]);
  out.circle = std::sqrt(std::max(0.0, (r - h) * (r + h)));
  return out;
}

// Angles come from the cosine and the sine of one half angle, that on the smallest circle:
// where two spheres hardly touch, errors of theirs cancel only if they are the same.
Flap Union3::flap(const Id* corner) const {
  Flap out{};
  const Point3 p[3] = {point(corner[0]), point(corner[1]), point(corner[2])};
  Vector normal = cross(p[1] - p[0], p[2] - p[0]);
  for (int k = 0; k < 3; ++k) out.lens[k] = lens(corner[kOther[k][0]], corner[kOther[k][1]]);
  double size = norm(normal);
  if (!(size > kThin * out.lens[2].length * out.lens[1].length)) {
    size = norm(normal_accurate(p[0], p[1], p[2]));
  }
  out.area = 0.5 * size;
  double away[3];  // of the centre from each edge
  int least = 0;
  for (int k = 0; k < 3; ++k) {
    const int a = kOther[k][0], b = kOther[k][1];
    const Lens& side = out.lens[k];
    const Vector u = p[k] - p[a], v = p[k] - p[b], w = p[b] - p[a];
    double top = dot(u, v);
    if (view_.weights != nullptr) {
      const double wa = weight(corner[a]), along = dot(u, w) / dot(w, w);
      top += (wa - weight(corner[k])) - along * (wa - weight(corner[b]));
    }
    away[k] = 0.5 * side.length * (top / size);
    if (side.circle < out.lens[least].circle) least = k;
  }
  const double smallest = out.lens[least].circle;
  const double cosine =
      smallest > 0.0 ? std::max(-1.0, std::min(1.0, away[least] / smallest)) : 1.0;
  const double sine = std::sqrt((1.0 - std::fabs(cosine)) * (1.0 + std::fabs(cosine)));
  out.height = smallest * sine;
  double c[3], s[3];  // cosines and sines of the half angles, but for a factor
  for (int k = 0; k < 3; ++k) {
    const double circle = out.lens[k].circle;
    c[k] = k == least || circle == 0.0 ? (k == least ? cosine : 1.0) : away[k] / circle;
    s[k] = k == least || circle == 0.0 ? (k == least ? sine : 0.0) : out.height / circle;
    out.half[k] = std::atan2(s[k], c[k]);
  }
  for (int k = 0; k < 3; ++k) {
    const int a = kOther[k][0], b = kOther[k][1];  // corners; as edges, those at corner k
    const int e = out.lens[a].circle <= out.lens[b].circle ? a : b;
    const Lens& side = out.lens[e];
    // Along edge e from corner k on: where the third corner is, how high it is above.
    const int other = e == a ? b : a;
    const double x = dot(p[e] - p[k], p[other] - p[k]) / side.length, y = size / side.length;
    const double h = side.from[kOther[e][0] == k ? 0 : 1];
    out.turn[k] = std::atan2(radius_[at(corner[k])] * y * s[e], side.circle * x - h * y * c[e]);
    const double ha = out.lens[b].from[kOther[b][0] == k ? 0 : 1];  // towards corner a
    const double hb = out.lens[a].from[kOther[a][0] == k ? 0 : 1];
    out.share[k] = 0.5 * (ha * away[b] + hb * away[a]);
  }
  return out;
}

// Sides of a triangle without a tetrahedron of the complex.
int Union3::open_sides(std::size_t f) const {
  int open = 2;
  for (std::size_t k = 0; k < 2; ++k) {
    const Id t = view_.triangle_tetrahedra[2 * f + k];
    if (t >= 0 && view_.has_tetrahedron[t]) --open;
  }
  return open;
}

// The boundary on a sphere is what the link of its vertex leaves of it.
void Union3::count() {
  for (std::size_t e = 0; e < view_.edge_count; ++e) {
    if (!view_.has_edge[e]) continue;
    for (std::size_t k = 0; k < 2; ++k) --euler_[at(view_.edges[2 * e + k])];
  }
  job_.poll();
  for (std::size_t f = 0; f < view_.triangle_count; ++f) {
    if (!view_.has_triangle[f]) continue;
    const std::uint8_t state = open_sides(f) > 0 ? kSpanned | kOpen : kSpanned;
    for (std::size_t k = 0; k < 3; ++k) {
      ++euler_[at(view_.triangles[3 * f + k])];
      state_[at(view_.triangle_edges[3 * f + k])] |= state;
    }
  }
  job_.poll();
  for (std::size_t t = 0; t < view_.tetrahedron_count; ++t) {
    if (!view_.has_tetrahedron[t]) continue;
    for (std::size_t k = 0; k < 4; ++k) --euler_[at(view_.tetrahedra[4 * t + k])];
  }
  for (std::size_t e = 0; e < view_.edge_count; ++e) {
    if (view_.has_edge[e] && state_[e] == 0) state_[e] = kOpen;
  }
}

void Union3::add_triangles() {
  in_waves<FlapRecord>(
      view_.triangle_count, job_, 0.4,
      [&](std::size_t f, std::vector<FlapRecord>& records) {
        if (!view_.has_triangle[f]) return;
        const int open = open_sides(f);
        if (open == 0) return;
        const Flap flap = this->flap(view_.triangles + 3 * f);
        FlapRecord record{};
        for (std::size_t k = 0; k < 3; ++k) {
          record.v[k] = view_.triangles[3 * f + k];
          record.e[k] = view_.triangle_edges[3 * f + k];
          record.half[k] = open * flap.half[k];
          record.turn[k] = open * flap.turn[k];
          record.share[k] = open * flap.share[k] * flap.height / 3.0;
        }
        record.volume = open * flap.area * flap.height / 3.0;
        records.push_back(record);
      },
      [&](const FlapRecord& record) {
        for (int k = 0; k < 3; ++k) {
          const std::size_t v = at(record.v[k]);
          turn_[at(record.e[k])] -= record.half[k];
          out_.surface_areas[v] -= radius_[v] * record.turn[k];
          out_.volumes[v] += record.share[k];
        }
        total_ += record.volume;
      });
}

// The edge between two corners of a tetrahedron.
Id Union3::cell_edge(std::size_t t, int k) const {
  const int a = kEdge[k][0], b = kEdge[k][1];
  // In a face with both, the edge is opposite to the third corner.
  const int away = a > 0 ? 0 : (b > 1 ? 1 : 2), third = 6 - a - b - away;
  const std::size_t f = at(view_.tetrahedron_triangles[4 * t + at(away)]);
  return view_.triangle_edges[3 * f + at(third > away ? third - 1 : third)];
}

// What each corner has of a tetrahedron: pyramids from the corner over the kites between it,
// its edges' and the faces' centres, as high as the tetrahedron's centre. Of slivers the
// centre is known poorly along their normal; that is small as long as all faces see the same
// centre, found from the largest face, and none beyond the point where its spheres meet.
void Union3::share_cell(const Id* corner, const Vector* normal, double det, CellRecord& out) const {
  int best = 0;
  double size_sq[4];
  for (int k = 0; k < 4; ++k) {
    size_sq[k] = dot(normal[k], normal[k]);
    if (size_sq[k] > size_sq[best]) best = k;
  }
  const Point3 p[4] = {point(corner[0]), point(corner[1]), point(corner[2]), point(corner[3])};
  double reach[4][4];  // g[i][j]: from i, how far the radical plane is along j - i, times length
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) {
      const Vector u = p[j] - p[i];
      const double half = 0.5 * dot(u, u);
      const double lean = 0.5 * (weight(corner[i]) - weight(corner[j]));
      reach[i][j] = half + lean;
      reach[j][i] = half - lean;
    }
  }
  // Seen from the corner nearest to the one across: the two may almost coincide.
  int turn = 0;
  double nearest = HUGE_VAL;
  for (int m = 0; m < 3; ++m) {
    const Vector u = p[best] - p[kFace[best][m]];
    if (dot(u, u) >= nearest) continue;
    nearest = dot(u, u);
    turn = m;
  }
  const int a = kFace[best][turn], b = kFace[best][(turn + 1) % 3], c = kFace[best][(turn + 2) % 3];
  const Vector u = p[b] - p[a], v = p[c] - p[a], q = p[best] - p[a];
  const Vector n = normal[best];
  const Vector turned = cross(u, v);
  const double side = dot(turned, n) < 0.0 ? -1.0 : 1.0;
  const Vector vn = cross(v, n), nu = cross(n, u);
  const double x = side * reach[a][b] / size_sq[best], y = side * reach[a][c] / size_sq[best];
  const Vector foot{x * vn.x + y * nu.x, x * vn.y + y * nu.y, x * vn.z + y * nu.z};
  const double most =
      std::sqrt(std::max(0.0, square_[at(corner[a])] - dot(foot, foot)) / size_sq[best]);
  double rise = (reach[a][best] - dot(foot, q)) / det;  // over the length of the normal
  rise = std::max(-most, std::min(most, rise));
  const Vector centre{foot.x + rise * n.x, foot.y + rise * n.y, foot.z + rise * n.z};
  for (int f = 0; f < 4; ++f) {
    const int first = kFace[f][0];
    const Vector shift = p[first] - p[a];
    const Vector here{centre.x - shift.x, centre.y - shift.y, centre.z - shift.z};
    const double height = dot(here, normal[f]) / size_sq[f];
    for (int m = 0; m < 3; ++m) {
      const int i = kFace[f][m], j = kFace[f][kOther[m][0]], k = kFace[f][kOther[m][1]];
      const Vector ij = p[j] - p[i], ik = p[k] - p[i], jk = p[k] - p[j];
      // The distance of the face's centre from each edge, times the normal over the edge.
      double off_ij = 0.5 * dot(ik, jk), off_ik = -0.5 * dot(ij, jk);
      if (view_.weights != nullptr) {
        const double across = dot(ij, ik), lean_ij = weight(corner[i]) - weight(corner[j]),
                     lean_ik = weight(corner[i]) - weight(corner[k]);
        off_ij += 0.5 * (lean_ik - lean_ij * (across / dot(ij, ij)));
        off_ik += 0.5 * (lean_ij - lean_ik * (across / dot(ik, ik)));
      }
      out.share[i] += height * (reach[i][j] * off_ij + reach[i][k] * off_ik) / 6.0;
    }
  }
}

// What a tetrahedron outside of the complex adds to its void: itself, less what the balls
// have of it.
void Union3::measure_void(std::size_t t, CellRecord& out) const {
  const Id* corner = view_.tetrahedra + 4 * t;
  for (int k = 0; k < 4; ++k) {
    if (!view_.has_vertex[corner[k]]) continue;
    const double s = square_[at(corner[k])], r = radius_[at(corner[k])];
    out.area += 2.0 * kPi * s;
    out.volume -= 2.0 * kPi * s * r / 3.0;
  }
  auto edge = [&](const Lens& lens, Id i, Id j, double angle) {
    const double si = square_[at(i)], sj = square_[at(j)];
    const double ri = radius_[at(i)], rj = radius_[at(j)];
    out.area += (lens.from[0] * ri + lens.from[1] * rj) * angle;
    out.volume -= (lens.from[0] * si + lens.from[1] * sj) * angle / 3.0 +
                  lens.length * lens.circle * lens.circle * angle / 6.0;
  };
  for (int k = 0; k < 6; ++k) {
    const Id i = corner[kEdge[k][0]], j = corner[kEdge[k][1]];
    if (view_.has_edge[out.e[k]]) edge(lens(i, j), i, j, out.angle[k]);
  }
  for (int k = 0; k < 4; ++k) {
    const Id f = view_.tetrahedron_triangles[4 * t + at(k)];
    if (!view_.has_triangle[f]) continue;
    const Id* face = view_.triangles + 3 * at(f);
    const Flap flap = this->flap(face);
    out.volume -= flap.area * flap.height / 3.0;
    for (int m = 0; m < 3; ++m) {
      const double s = square_[at(face[m])], r = radius_[at(face[m])];
      edge(flap.lens[m], face[kOther[m][0]], face[kOther[m][1]], -flap.half[m]);
      out.area -= s * flap.turn[m];
      out.volume += s * r * flap.turn[m] / 3.0;
    }
  }
}

CellRecord Union3::cell(std::size_t t) const {
  const Id* corner = view_.tetrahedra + 4 * t;
  CellRecord out{};
  const Point3 p[4] = {point(corner[0]), point(corner[1]), point(corner[2]), point(corner[3])};
  Vector normal[4];
  const Vector u = p[1] - p[0], v = p[2] - p[0], w = p[3] - p[0];
  const double sizes = norm(u) * norm(v) * norm(w);
  double det = dot(cross(u, v), w);
  const bool thin = !(std::fabs(det) > kThin * sizes);
  if (thin) det = volume_accurate(p[0], p[1], p[2], p[3]);
  for (int k = 0; k < 4; ++k) {  // inward
    const Point3 a = p[kFace[k][0]], b = p[kFace[k][1]], c = p[kFace[k][2]];
    normal[k] = thin ? normal_accurate(a, b, c) : cross(b - a, c - a);
    if ((k % 2 == 0) == (det > 0.0)) normal[k] = {-normal[k].x, -normal[k].y, -normal[k].z};
  }
  const double size = std::fabs(det);
  const bool inside = view_.has_tetrahedron[t];
  out.hollow = inside ? -1 : view_.hollow[t];
  out.volume = size / 6.0;
  for (int k = 0; k < 4; ++k) out.v[k] = corner[k];
  for (int k = 0; k < 6; ++k) {
    const int a = kEdge[k][0], b = kEdge[k][1];
    out.e[k] = cell_edge(t, k);
    if (inside ? state_[at(out.e[k])] == kSpanned : !view_.has_edge[out.e[k]]) {
      if (inside) out.e[k] = -1;
      continue;
    }
    int c = 0;
    while (c == a || c == b) ++c;
    const int d = 6 - a - b - c;
    out.angle[k] = std::atan2(size * norm(p[b] - p[a]), -dot(normal[c], normal[d]));
  }
  if (inside) {
    share_cell(corner, normal, size, out);
  } else {
    measure_void(t, out);
  }
  return out;
}

void Union3::add_tetrahedra() {
  in_waves<CellRecord>(
      view_.tetrahedron_count, job_, 0.5,
      [&](std::size_t t, std::vector<CellRecord>& records) {
        if (view_.has_tetrahedron[t] || view_.hollow[t] >= 0) records.push_back(cell(t));
      },
      [&](const CellRecord& record) {
        if (record.hollow >= 0) {
          out_.void_volumes[at(record.hollow)] += record.volume;
          out_.void_areas[at(record.hollow)] += record.area;
          for (const Id e : record.e) edge_hollow_[at(e)] = record.hollow;
          return;
        }
        for (int k = 0; k < 4; ++k) out_.volumes[at(record.v[k])] += record.share[k];
        for (int k = 0; k < 6; ++k) {
          if (record.e[k] >= 0) turn_[at(record.e[k])] -= record.angle[k];
        }
        total_ += record.volume;
      });
}

void Union3::add_edges() {
  for (std::size_t e = 0; e < view_.edge_count; ++e) {
    if ((e & 0xffff) == 0) job_.poll();
    if (!view_.has_edge[e] || state_[e] == kSpanned) continue;
    const Id* end = view_.edges + 2 * e;
    const Lens lens = this->lens(end[0], end[1]);
    const double turn = std::max(0.0, std::min(2.0 * kPi, turn_[e]));
    const double disc = lens.circle * lens.circle * turn / 6.0;
    for (std::size_t k = 0; k < 2; ++k) {
      out_.volumes[at(end[k])] += lens.from[k] * disc;
      out_.surface_areas[at(end[k])] += lens.from[k] * turn;
    }
    total_ += lens.length * disc;
  }
}

void Union3::add_vertices() {
  Buffer<bool> open(view_.n);
  std::fill(open.begin(), open.end(), false);
  Buffer<bool> joined(view_.n);
  std::fill(joined.begin(), joined.end(), false);
  for (std::size_t e = 0; e < view_.edge_count; ++e) {
    if (!view_.has_edge[e]) continue;
    for (std::size_t k = 0; k < 2; ++k) {
      joined[at(view_.edges[2 * e + k])] = true;
      if (state_[e] != kSpanned) open[at(view_.edges[2 * e + k])] = true;
    }
  }
  for (std::size_t v = 0; v < view_.n; ++v) {
    double& area = out_.surface_areas[v];
    if (!view_.has_vertex[v] || (joined[v] && !open[v])) {
      area = 0.0;
    } else {
      area = std::max(0.0, radius_[v] * (2.0 * kPi * euler_[v] * radius_[v] + area));
      area = std::min(area, 4.0 * kPi * square_[v]);
    }
    const double cone = radius_[v] * area / 3.0;
    out_.volumes[v] = std::max(0.0, out_.volumes[v] + cone);
    total_ += cone;
  }
}

// Each sphere's part of a void's boundary has as many pieces, less holes, as the tetrahedra,
// triangles and edges of the void around its vertex tell.
void Union3::finish_voids() {
  auto add = [&](Id hollow, Id v, double sign) {
    if (!view_.has_vertex[v]) return;
    const double area = sign * 2.0 * kPi * square_[at(v)];
    out_.void_areas[at(hollow)] += area;
    out_.void_volumes[at(hollow)] -= radius_[at(v)] * area / 3.0;
  };
  for (std::size_t f = 0; f < view_.triangle_count; ++f) {
    const Id t = view_.triangle_tetrahedra[2 * f];
    if (view_.has_triangle[f] || t < 0 || view_.hollow[t] < 0) continue;
    for (std::size_t k = 0; k < 3; ++k) add(view_.hollow[t], view_.triangles[3 * f + k], -1.0);
  }
  for (std::size_t e = 0; e < view_.edge_count; ++e) {
    if (view_.has_edge[e] || edge_hollow_[e] < 0) continue;
    for (std::size_t k = 0; k < 2; ++k) add(edge_hollow_[e], view_.edges[2 * e + k], 1.0);
  }
  for (double& volume : out_.void_volumes) volume = std::max(0.0, volume);
  for (double& area : out_.void_areas) area = std::max(0.0, area);
}

UnionOfBalls3 Union3::run() {
  count();
  job_.advance(0.05);
  add_triangles();
  add_tetrahedra();
  add_edges();
  add_vertices();
  if (view_.void_count > 0) finish_voids();
  out_.volume = total_.value();
  return std::move(out_);
}

}  // namespace

UnionOfBalls3 union3(const BallsView& view, Job& job) { return Union3(view, job).run(); }

}  // namespace alphamesh
