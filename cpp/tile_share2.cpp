#include "tile_share2.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "blocks2.hpp"

namespace alphamesh {
namespace {

using Id = std::int32_t;
constexpr double kInf = std::numeric_limits<double>::infinity();

template <class T>
void sort3(T& a, T& b, T& c) {
  const T low = std::min(a, b), high = std::max(a, b), mid = std::min(high, c);
  c = std::max(high, c);
  a = std::min(low, mid);
  b = std::max(low, mid);
}

// Twice the area; computed again where it cancels.
double doubled_area(Point2 a, Point2 b, Point2 c) {
  const double l = (b.x - a.x) * (c.y - a.y), r = (c.x - a.x) * (b.y - a.y);
  const double area = std::fabs(l - r);
  if (8.0 * kEps * (std::fabs(l) + std::fabs(r)) <= 1e-13 * area) return area;
  return std::fabs(cross_accurate(a, b, c));
}

// Points are numbered along the curve here, triangles as in the mesh. S is Plane or
// WeightedPlane.
template <class Row, class S>
class Maker {
 public:
  Maker(const double* v, const Row* rows, const SpatialOrder<S>& order, Mesh2& mesh,
        const TileBox<2>& box, double radius)
      : order_(order),
        mesh_(mesh),
        p_(order.points.data()),
        limit_(radius),
        row_(order.size),
        place_(order.size),
        radius_(mesh.triangles),
        area_(mesh.triangles),
        known_(mesh.triangles),
        vertices_(order.size),
        cells_(mesh.triangles) {
    for (std::size_t i = 0; i < order.size; ++i) {
      const auto at = static_cast<std::size_t>(order.row[i]);
      const double* p = order.exponent == 0 ? &p_[i].x : v + 2 * at;  // along the curve
      const bool inside = box.holds(p);
      row_[i] = rows[at];
      place_[i] = static_cast<std::uint8_t>(inside | ((!inside | box.near(p)) << 2));
      if (inside & !kWeighted & (0.0 <= radius)) place_[i] |= kKnown;
    }
  }

  TileShare2<Row> make(const TileWeights& weights, Job& job) {
    if (kWeighted) {
      least_ = Buffer<double>(order_.size);
      std::fill(least_.begin(), least_.end(), kInf);
    }
    measure_triangles(job);
    measure_edges(job);
    if (kWeighted) find_vertices(weights, job);
    auto known = [&](std::size_t i) { return (place_[i] & kKnown) != 0; };
    auto shared = [&](std::size_t i) { return (place_[i] & kShared) != 0; };
    out_.components = label_components(vertices_, row_.data(), order_.size, known, shared, job);
    label_regions(job);
    return std::move(out_);
  }

 private:
  static constexpr bool kWeighted = std::is_same_v<S, WeightedPlane>;
  // Bits of place_: in the tile; known to it, as a vertex; perhaps known to others.
  bool inside(Id v) const { return (place_[static_cast<std::size_t>(v)] & 1) != 0; }
  static constexpr std::uint8_t kKnown = 2, kShared = 4;
  // Bits of known_; with all corners in the tile.
  static constexpr std::uint8_t kCell = 1, kInner = 2;

  bool first_inside(Id a, Id b) const { return inside(lexicographic(p_[a], p_[b]) ? a : b); }

  bool mine(Id a, Id b) const {
    const bool in = inside(a);
    return in == inside(b) ? in : first_inside(a, b);
  }

  bool mine(Id a, Id b, Id c) const {
    const int in = inside(a) + inside(b) + inside(c);
    if (in == 0 || in == 3) return in == 3;
    const Id first = lexicographic(p_[a], p_[b]) ? a : b;
    return first_inside(first, c);
  }

  void measure_triangles(Job& job) {
    out_.triangles = Columns<Row>(3, mesh_.triangles);
    out_.triangle_radii = Columns<double>(1, mesh_.triangles);
    typename Blocks<S>::Triangles block;
    std::size_t at[TriangleBlock::kSize];
    auto flush = [&] {
      block.measure(order_.lattice, order_.exponent);
      for (std::size_t i = 0; i < block.count; ++i) {
        mesh_.slot[8 * at[i] + 7] = Blocks<S>::code(block, i);
        radius_[at[i]] = block.radius[i];
        if (block.radius[i] <= limit_) keep_triangle(at[i]);
      }
      block.count = 0;
      job.poll();
    };
    for (std::size_t t = 0; t < mesh_.triangles; ++t) {
      const Id* v = &mesh_.slot[8 * t];
      known_[t] = 0;
      area_[t] = 0.0;
      radius_[t] = kInf;
      mesh_.slot[8 * t + 7] = Blocks<S>::kNone;
      if (v[2] == Mesh2::kInfinity) continue;
      at[block.count] = t;
      block.push(p_[v[0]], p_[v[1]], p_[v[2]]);
      if (block.count == TriangleBlock::kSize) flush();
    }
    flush();
    out_.triangle_radii.count = out_.triangles.count;
  }

  void keep_triangle(std::size_t t) {
    const Id* v = &mesh_.slot[8 * t];
    if (!mine(v[0], v[1], v[2])) return;
    const bool inner = inside(v[0]) & inside(v[1]) & inside(v[2]);
    known_[t] = inner ? kCell | kInner : kCell;
    area_[t] = doubled_area(p_[v[0]], p_[v[1]], p_[v[2]]);
    Row a = row_[v[0]], b = row_[v[1]], c = row_[v[2]];
    sort3(a, b, c);
    const std::size_t to = out_.triangles.count++;
    out_.triangles.column(0)[to] = a;
    out_.triangles.column(1)[to] = b;
    out_.triangles.column(2)[to] = c;
    out_.triangle_radii.column(0)[to] = radius_[t];
  }

  void measure_edges(Job& job) {
    const std::size_t most = mesh_.triangles / 2 * 3;
    out_.edges = Columns<Row>(2, most);
    out_.edge_radii = Columns<double>(1, most);
    out_.edge_kinds = Columns<std::int8_t>(1, most);
    const PowerOfTwo unscale(-order_.exponent);
    typename Blocks<S>::Edges block;
    Id h[EdgeBlock::kSize];
    for (std::size_t t = 0; t < mesh_.triangles;) {
      std::size_t count = 0;
      for (const std::size_t end = std::min(t + TriangleBlock::kSize, mesh_.triangles); t < end;
           ++t) {
        count += collect(t, h + count);
      }
      for (std::size_t i = 0; i < count; ++i) {
        block.set(i, p_[mesh_.origin(h[i])], p_[mesh_.origin(Mesh2::next(h[i]))]);
        const auto across = static_cast<std::size_t>(mesh_.twin(h[i]));
        prefetch(&mesh_.slot[across]);
        prefetch(&radius_[across / 8]);
      }
      Blocks<S>::measure(block, count, order_.lattice);
      for (std::size_t i = 0; i < count; ++i) {
        keep_edge(h[i], unscale * Blocks<S>::radius(block, i));
      }
      job.poll();
    }
    out_.edge_radii.count = out_.edge_kinds.count = out_.edges.count;
  }

  // Each edge is met at the lower one of its half-edges, without a branch; of a ghost's,
  // only the one on the hull is an edge.
  std::size_t collect(std::size_t t, Id* h) const {
    const Id base = static_cast<Id>(8 * t);
    const bool real = mesh_.origin(base + 2) != Mesh2::kInfinity;
    std::size_t count = 0;
    h[count] = base;
    count += base < mesh_.twin(base);
    h[count] = base + 1;
    count += real & (base + 1 < mesh_.twin(base + 1));
    h[count] = base + 2;
    count += real & (base + 2 < mesh_.twin(base + 2));
    return count;
  }

  void keep_edge(Id h, double own) {
    const Id g = mesh_.twin(h), base = Mesh2::base(h), other = Mesh2::base(g);
    const std::size_t s = static_cast<std::size_t>(base) / 8,
                      t = static_cast<std::size_t>(other) / 8;
    const bool attached = Blocks<S>::attached(mesh_.slot[base + 7], h & 3) |
                          Blocks<S>::attached(mesh_.slot[other + 7], g & 3);
    const double enter = std::min(radius_[s], radius_[t]);
    const double value[2] = {std::min(own, enter), enter};
    const Id u = mesh_.origin(h), v = mesh_.origin(Mesh2::next(h));
    if (!(value[attached] <= limit_)) return;
    if (kWeighted) {
      double &first = least_[static_cast<std::size_t>(u)],
             &second = least_[static_cast<std::size_t>(v)];
      first = std::min(first, value[attached]);
      second = std::min(second, value[attached]);
    }
    if (!mine(u, v)) return;
    const bool here = radius_[s] <= limit_, there = radius_[t] <= limit_;
    const std::size_t to = out_.edges.count++;
    out_.edges.column(0)[to] = std::min(row_[u], row_[v]);
    out_.edges.column(1)[to] = std::max(row_[u], row_[v]);
    out_.edge_radii.column(0)[to] = value[attached];
    out_.edge_kinds.column(0)[to] = static_cast<std::int8_t>(1 + here + there);
    place_[static_cast<std::size_t>(u)] |= kKnown;
    place_[static_cast<std::size_t>(v)] |= kKnown;
    join(vertices_, u, v);
    known_[s] |= here;
    known_[t] |= there;
    if (here & there) join(cells_, static_cast<Id>(s), static_cast<Id>(t));
    if (here != there) add_boundary(here ? h : g);
  }

  void add_boundary(Id h) {
    for (const Id corner : {h, Mesh2::next(h), Mesh2::prev(h)}) {
      out_.boundary.push_back(order_.row[static_cast<std::size_t>(mesh_.origin(corner))]);
    }
    out_.boundary_regions.push_back(Mesh2::base(h) / 8);  // the triangle, for now
  }

  // A vertex that is attached has the least value of its edges, see vertex_rows().
  void find_vertices(const TileWeights& weights, Job& job) {
    out_.vertex_radii = Buffer<double>(weights.n);
    std::fill(out_.vertex_radii.begin(), out_.vertex_radii.end(), kInf);
    for (std::size_t i = 0; i < order_.size; ++i) {
      if ((i & 0xffff) == 0) job.poll();
      const auto at = static_cast<std::size_t>(order_.row[i]);
      if ((place_[i] & 1) == 0 || weights.role[at] == Role::kNone) continue;
      const bool gabriel = weights.role[at] == Role::kGabriel;
      const double radius = gabriel ? signed_root(0.0 - weights.weight[at]) : least_[i];
      if (!(radius <= limit_)) continue;
      out_.vertex_radii[at] = radius;
      place_[i] |= kKnown;
    }
  }

  void label_regions(Job& job) {
    Buffer<Id> label(mesh_.triangles);
    TileBorder<Row>& border = out_.regions;
    for (std::size_t t = 0; t < mesh_.triangles; ++t) {
      if ((t & 0xffff) == 0) job.poll();
      if (known_[t] == 0) continue;
      const Id root = cells_.root(static_cast<Id>(t));
      if (root == static_cast<Id>(t)) {
        label[t] = border.count++;
        out_.region_sizes.push_back(0.0);
      } else {
        label[t] = label[static_cast<std::size_t>(root)];
      }
      out_.region_sizes[static_cast<std::size_t>(label[t])] += area_[t];
      if ((known_[t] & kInner) != 0) continue;
      const Id* v = &mesh_.slot[8 * t];
      Row a = row_[v[0]], b = row_[v[1]], c = row_[v[2]];
      sort3(a, b, c);
      border.keys.insert(border.keys.end(), {a, b, c});
      border.labels.push_back(label[t]);
    }
    for (Id& region : out_.boundary_regions) region = label[static_cast<std::size_t>(region)];
    for (double& size : out_.region_sizes) size = std::ldexp(size, -2 * order_.exponent - 1);
  }

  const SpatialOrder<S>& order_;
  Mesh2& mesh_;
  const typename S::Point* p_;
  double limit_;
  Buffer<Row> row_;  // in the whole cloud
  Buffer<std::uint8_t> place_;
  Buffer<double> radius_, area_;  // infinite for ghosts; doubled, and zero unless the tile's
  Buffer<double> least_;          // of the edges at each point, with weights
  Buffer<std::uint8_t> known_;
  DisjointSets vertices_, cells_;
  TileShare2<Row> out_;
};

}  // namespace

template <class Row>
TileShare2<Row> tile_share2(const double* v, const Row* rows, const SpatialOrder2& order,
                            Mesh2& mesh, const TileBox<2>& box, double radius, Job& job) {
  return Maker<Row, Plane>(v, rows, order, mesh, box, radius).make({nullptr, nullptr, 0}, job);
}

template <class Row>
TileShare2<Row> tile_share2(const double* v, const Row* rows,
                            const SpatialOrder<WeightedPlane>& order, Mesh2& mesh,
                            const TileBox<2>& box, double radius, const TileWeights& weights,
                            Job& job) {
  return Maker<Row, WeightedPlane>(v, rows, order, mesh, box, radius).make(weights, job);
}

template TileShare2<std::int32_t> tile_share2(const double*, const std::int32_t*,
                                              const SpatialOrder2&, Mesh2&, const TileBox<2>&,
                                              double, Job&);
template TileShare2<std::int64_t> tile_share2(const double*, const std::int64_t*,
                                              const SpatialOrder2&, Mesh2&, const TileBox<2>&,
                                              double, Job&);
template TileShare2<std::int32_t> tile_share2(const double*, const std::int32_t*,
                                              const SpatialOrder<WeightedPlane>&, Mesh2&,
                                              const TileBox<2>&, double, const TileWeights&, Job&);
template TileShare2<std::int64_t> tile_share2(const double*, const std::int64_t*,
                                              const SpatialOrder<WeightedPlane>&, Mesh2&,
                                              const TileBox<2>&, double, const TileWeights&, Job&);

}  // namespace alphamesh
