#include "tile_share3.hpp"

#include <algorithm>
#include <cmath>

#include "predicates3.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {
namespace {

using Id = std::int32_t;
constexpr int kEnds[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

// Six times the volume; computed again where it cancels.
double sixfold_volume(Point3 a, Point3 b, Point3 c, Point3 d) {
  const Vector3<double> u = b - a, v = c - a, w = d - a;
  const double xy = u.x * v.y, yx = u.y * v.x, yz = u.y * v.z, zy = u.z * v.y;
  const double zx = u.z * v.x, xz = u.x * v.z;
  const double volume = std::fabs((yz - zy) * w.x + (zx - xz) * w.y + (xy - yx) * w.z);
  const double sum = (std::fabs(yz) + std::fabs(zy)) * std::fabs(w.x) +
                     (std::fabs(zx) + std::fabs(xz)) * std::fabs(w.y) +
                     (std::fabs(xy) + std::fabs(yx)) * std::fabs(w.z);
  if (16.0 * kEps * sum <= 1e-13 * volume) return volume;
  return std::fabs(volume_accurate(a, b, c, d));
}

// The edges of the complex between some vertices, each at its lower end.
class EdgeIndex {
 public:
  // What is there and has both ends in `wanted`.
  template <class There>
  EdgeIndex(std::size_t n, const Id* edges, std::size_t count, const std::uint8_t* wanted,
            std::uint8_t bit, There&& there)
      : first_(n + 1, 0) {
    auto each = [&](auto&& use) {
      for (std::size_t e = 0; e < count; ++e) {
        const auto a = static_cast<std::size_t>(edges[2 * e]);
        const auto b = static_cast<std::size_t>(edges[2 * e + 1]);
        if ((wanted[a] & wanted[b] & bit) != 0 && there(e)) use(a, edges[2 * e + 1]);
      }
    };
    each([&](std::size_t a, Id) { ++first_[a + 1]; });
    for (std::size_t i = 0; i < n; ++i) first_[i + 1] += first_[i];
    other_.resize(static_cast<std::size_t>(first_[n]));
    state_.resize(other_.size(), 0);
    std::vector<Id> next(first_.begin(), first_.end() - 1);
    each([&](std::size_t a, Id b) { other_[static_cast<std::size_t>(next[a]++)] = b; });
  }

  // The place of the edge from a to b > a, -1 if it is not there.
  Id find(Id a, Id b) const {
    const auto i = static_cast<std::size_t>(a);
    for (Id k = first_[i]; k < first_[i + 1]; ++k) {
      if (other_[static_cast<std::size_t>(k)] == b) return k;
    }
    return -1;
  }
  std::uint8_t& state(Id place) { return state_[static_cast<std::size_t>(place)]; }

 private:
  std::vector<Id> first_, other_;
  std::vector<std::uint8_t> state_;
};

template <class Row>
class Maker {
 public:
  Maker(const TileView3<Row>& view, const TileBox<3>& box, double radius, Job& job)
      : view_(view),
        limit_(radius),
        exponent_(range_exponent<Space>(view.points, view.n, job)),
        p_(view.n),
        place_(view.n),
        free_(view.tetrahedron_count),
        known_(view.tetrahedron_count),
        vertices_(view.n),
        cells_(view.tetrahedron_count) {
    const TileVertices vertices = view.vertices(radius);
    const PowerOfTwo factor(exponent_);
    for (std::size_t i = 0; i < view.n; ++i) {
      const double* p = view.points + 3 * i;
      const bool inside = i < view.real && box.holds(p);
      p_[i] = {factor * p[0], factor * p[1], factor * p[2]};
      place_[i] = inside ? kInside | (box.near(p) ? kShared : 0) : kShared;
      if (inside && vertices.has(i)) place_[i] |= kKnown;
    }
  }

  TileShare3<Row> make(Job& job) {
    keep_tetrahedra(job);
    keep_edges(job);
    EdgeIndex index(view_.n, view_.edges, view_.edge_count, place_.data(), kOpen,
                    [&](std::size_t e) { return view_.edge_radii[e] <= limit_; });
    DisjointSets fronts(4 * free_count_);
    keep_triangles(fronts, index, job);
    link_along(fronts, index, job);
    auto known = [&](std::size_t i) { return has(i, kKnown); };
    auto shared = [&](std::size_t i) { return has(i, kShared); };
    out_.components = label_components(vertices_, view_.rows, view_.n, known, shared, job);
    label_regions(job);
    label_fronts(fronts, job);
    return std::move(out_);
  }

 private:
  // Bits of place_: in the tile; known to it, as a vertex; perhaps known to others; at the
  // corner of a tetrahedron that is not in the complex.
  static constexpr std::uint8_t kInside = 1, kKnown = 2, kShared = 4, kOpen = 8;
  // Bits of known_: the tetrahedron matters; it is the tile's.
  static constexpr std::uint8_t kCell = 1, kMine = 2;

  bool has(std::size_t v, std::uint8_t bit) const { return (place_[v] & bit) != 0; }
  bool inside(Id v) const { return has(static_cast<std::size_t>(v), kInside); }

  int count_inside(const Id* v, int corners) const {
    int count = 0;
    for (int i = 0; i < corners; ++i) count += inside(v[i]);
    return count;
  }

  // Whether the lexicographically first vertex is in the tile.
  bool mine(const Id* v, int corners) const {
    const int in = count_inside(v, corners);
    if (in == 0 || in == corners) return in != 0;
    Id first = v[0];
    for (int i = 1; i < corners; ++i) {
      if (p_[static_cast<std::size_t>(v[i])] < p_[static_cast<std::size_t>(first)]) first = v[i];
    }
    return inside(first);
  }

  Row row(Id v) const { return view_.rows[v]; }
  const Point3& point(Id v) const { return p_[static_cast<std::size_t>(v)]; }

  // Adds a simplex to its table.
  void emit(const Id* v, int corners, double radius, Columns<Row>& table, Columns<double>& radii) {
    const std::size_t to = table.count++;
    for (int i = 0; i < corners; ++i) table.column(static_cast<std::size_t>(i))[to] = row(v[i]);
    radii.column(0)[to] = radius;
    ++radii.count;
  }

  void keep_tetrahedra(Job& job) {
    out_.tetrahedra = Columns<Row>(4, view_.tetrahedron_count);
    out_.tetrahedron_radii = Columns<double>(1, view_.tetrahedron_count);
    for (std::size_t t = 0; t < view_.tetrahedron_count; ++t) {
      if ((t & 0xffff) == 0) job.poll();
      const Id* v = view_.tetrahedra + 4 * t;
      known_[t] = 0;
      free_[t] = -1;
      if (view_.tetrahedron_radii[t] <= limit_) {
        if (!mine(v, 4)) continue;
        known_[t] = kCell | kMine;
        emit(v, 4, view_.tetrahedron_radii[t], out_.tetrahedra, out_.tetrahedron_radii);
      } else if (count_inside(v, 4) != 0) {
        free_[t] = static_cast<Id>(free_count_++);
        for (int i = 0; i < 4; ++i) place_[static_cast<std::size_t>(v[i])] |= kOpen;
      }
    }
  }

  void keep_edges(Job& job) {
    out_.edges = Columns<Row>(2, view_.edge_count);
    out_.edge_radii = Columns<double>(1, view_.edge_count);
    for (std::size_t e = 0; e < view_.edge_count; ++e) {
      if ((e & 0xffff) == 0) job.poll();
      const Id* v = view_.edges + 2 * e;
      if (!(view_.edge_radii[e] <= limit_) || !mine(v, 2)) continue;
      emit(v, 2, view_.edge_radii[e], out_.edges, out_.edge_radii);
      place_[static_cast<std::size_t>(v[0])] |= kKnown;
      place_[static_cast<std::size_t>(v[1])] |= kKnown;
      join(vertices_, v[0], v[1]);
    }
  }

  void keep_triangles(DisjointSets& fronts, EdgeIndex& index, Job& job) {
    out_.triangles = Columns<Row>(3, view_.triangle_count);
    out_.triangle_radii = Columns<double>(1, view_.triangle_count);
    out_.triangle_kinds = Columns<std::int8_t>(1, view_.triangle_count);
    for (std::size_t f = 0; f < view_.triangle_count; ++f) {
      if ((f & 0xffff) == 0) job.poll();
      const Id* v = view_.triangles + 3 * f;
      const int in = count_inside(v, 3);
      if (in == 0) continue;
      const Id* cofaces = view_.triangle_tetrahedra + 2 * f;
      if (view_.triangle_radii[f] <= limit_) {
        if (mine(v, 3)) keep_triangle(v, cofaces, view_.triangle_radii[f]);
        if (in != 3) name_sides(v, cofaces, index);
      } else if (cofaces[0] >= 0 && cofaces[1] >= 0) {
        for (int i = 0; i < 3; ++i) {
          if (inside(v[i])) join(fronts, node(cofaces[0], v[i]), node(cofaces[1], v[i]));
        }
      }
    }
  }

  bool cell_there(Id t) const { return t >= 0 && view_.tetrahedron_radii[t] <= limit_; }

  void keep_triangle(const Id* v, const Id* cofaces, double radius) {
    const bool here = cell_there(cofaces[0]), there = cell_there(cofaces[1]);
    emit(v, 3, radius, out_.triangles, out_.triangle_radii);
    out_.triangle_kinds.column(0)[out_.triangle_kinds.count++] =
        static_cast<std::int8_t>(1 + here + there);
    if (here) known_[static_cast<std::size_t>(cofaces[0])] |= kCell;
    if (there) known_[static_cast<std::size_t>(cofaces[1])] |= kCell;
    if (here && there) join(cells_, cofaces[0], cofaces[1]);
    if (here == there) return;
    const Id t = cofaces[here ? 0 : 1], a = apex(t, v);
    const bool turned = side(v, a) > 0;
    out_.boundary.insert(out_.boundary.end(), {v[0], v[turned ? 2 : 1], v[turned ? 1 : 2], a});
    out_.boundary_regions.push_back(t);  // for now
  }

  // The corner of a tetrahedron that is not in one of its triangles; both ascend.
  Id apex(Id t, const Id* v) const {
    const Id* corner = view_.tetrahedra + 4 * static_cast<std::size_t>(t);
    int i = 0;
    while (i < 3 && corner[i] == v[i]) ++i;
    return corner[i];
  }

  int side(const Id* v, Id apex) const {
    return orient3(point(v[0]), point(v[1]), point(v[2]), point(apex), Lattice3());
  }

  // The corner of a free tetrahedron at one of its vertices.
  Id node(Id t, Id v) const {
    const Id* corner = view_.tetrahedra + 4 * static_cast<std::size_t>(t);
    Id i = 0;
    while (corner[i] != v) ++i;
    return 4 * free_[static_cast<std::size_t>(t)] + i;
  }

  // The free sides of a triangle that other tiles know, too; its edges are not alone.
  void name_sides(const Id* v, const Id* cofaces, EdgeIndex& index) {
    for (int k = 0; k < 3; ++k) {
      const Id a = v[k == 0], b = v[k == 2 ? 1 : 2];
      if (inside(a) == inside(b)) continue;
      const Id place = index.find(a, b);
      if (place >= 0) index.state(place) = 1;
    }
    for (int k = 0; k < 2; ++k) {
      const Id t = cofaces[k];
      if (t < 0 || cell_there(t)) continue;
      const auto facing = static_cast<Row>(side(v, apex(t, v)));
      for (int i = 0; i < 3; ++i) {
        if (inside(v[i])) name({row(v[0]), row(v[1]), row(v[2]), facing}, node(t, v[i]));
      }
    }
  }

  void name(std::initializer_list<Row> key, Id node) {
    out_.fronts.keys.insert(out_.fronts.keys.end(), key);
    out_.fronts.labels.push_back(node);  // for now
  }

  // Links corners of one tetrahedron that an edge of the complex faces, and names edges that
  // are in no triangle of the complex, once: all around such an edge is joined.
  void link_along(DisjointSets& fronts, EdgeIndex& index, Job& job) {
    for (std::size_t t = 0; t < view_.tetrahedron_count; ++t) {
      if ((t & 0xffff) == 0) job.poll();
      if (free_[t] < 0) continue;
      const Id* v = view_.tetrahedra + 4 * t;
      for (const auto& end : kEnds) {
        const Id a = v[end[0]], b = v[end[1]], corner = 4 * free_[t];
        if (!inside(a) && !inside(b)) continue;
        const Id place = index.find(a, b);
        if (place < 0) continue;
        if (inside(a) && inside(b)) {
          join(fronts, corner + end[0], corner + end[1]);
        } else if (index.state(place) == 0) {
          index.state(place) = 1;
          name({row(a), row(b), Row{-1}, Row{0}}, corner + end[inside(a) ? 0 : 1]);
        }
      }
    }
  }

  void label_regions(Job& job) {
    Buffer<Id> label(view_.tetrahedron_count);
    TileBorder<Row>& border = out_.regions;
    for (std::size_t t = 0; t < view_.tetrahedron_count; ++t) {
      if ((t & 0xffff) == 0) job.poll();
      if (known_[t] == 0) continue;
      const Id root = cells_.root(static_cast<Id>(t));
      if (root == static_cast<Id>(t)) {
        label[t] = border.count++;
        out_.region_sizes.push_back(0.0);
      } else {
        label[t] = label[static_cast<std::size_t>(root)];
      }
      const Id* v = view_.tetrahedra + 4 * t;
      if ((known_[t] & kMine) != 0) {
        out_.region_sizes[static_cast<std::size_t>(label[t])] +=
            sixfold_volume(point(v[0]), point(v[1]), point(v[2]), point(v[3]));
      }
      if (count_inside(v, 4) == 4) continue;
      border.keys.insert(border.keys.end(), {row(v[0]), row(v[1]), row(v[2]), row(v[3])});
      border.labels.push_back(label[t]);
    }
    for (Id& region : out_.boundary_regions) region = label[static_cast<std::size_t>(region)];
    for (double& size : out_.region_sizes) size = std::ldexp(size / 6.0, -3 * exponent_);
  }

  void label_fronts(DisjointSets& fronts, Job& job) {
    Buffer<Id> label(4 * free_count_);
    TileBorder<Row>& border = out_.fronts;
    for (std::size_t t = 0; t < view_.tetrahedron_count; ++t) {
      if ((t & 0xffff) == 0) job.poll();
      if (free_[t] < 0) continue;
      for (Id i = 0; i < 4; ++i) {
        const auto v =
            static_cast<std::size_t>(view_.tetrahedra[4 * t + static_cast<std::size_t>(i)]);
        if (!has(v, kInside) || !has(v, kKnown)) continue;  // with weights, some are not there
        const Id at = 4 * free_[t] + i, root = fronts.root(at);
        label[static_cast<std::size_t>(at)] =
            root == at ? border.count++ : label[static_cast<std::size_t>(root)];
      }
    }
    for (Id& front : border.labels) front = label[static_cast<std::size_t>(front)];
  }

  const TileView3<Row>& view_;
  double limit_;
  int exponent_;
  Buffer<Point3> p_;  // scaled
  Buffer<std::uint8_t> place_;
  Buffer<Id> free_;  // numbers of tetrahedra that are not in the complex, at the tile's vertices
  std::size_t free_count_ = 0;
  Buffer<std::uint8_t> known_;
  DisjointSets vertices_, cells_;
  TileShare3<Row> out_;
};

}  // namespace

template <class Row>
TileShare3<Row> tile_share3(const TileView3<Row>& view, const TileBox<3>& box, double radius,
                            Job& job) {
  return Maker<Row>(view, box, radius, job).make(job);
}

template TileShare3<std::int32_t> tile_share3(const TileView3<std::int32_t>&, const TileBox<3>&,
                                              double, Job&);
template TileShare3<std::int64_t> tile_share3(const TileView3<std::int64_t>&, const TileBox<3>&,
                                              double, Job&);

}  // namespace alphamesh
