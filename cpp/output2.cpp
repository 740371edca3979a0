#include "output2.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "blocks2.hpp"

namespace alphamesh {
namespace {

using Id = std::int32_t;
constexpr double kInf = std::numeric_limits<double>::infinity();

// Of two half-edges the lower one writes the edge; among a ghost's, only the one on the
// hull is an edge at all. Which ones do is a coin toss, so that they are collected
// without a branch.
int owned_edges(const Mesh2& mesh, std::size_t t, Id* owned) {
  const Id h = static_cast<Id>(8 * t);
  const bool real = !mesh.is_ghost(h);
  int count = 0;
  owned[count] = h;
  count += h < mesh.twin(h);
  owned[count] = h + 1;
  count += real & (h + 1 < mesh.twin(h + 1));
  owned[count] = h + 2;
  count += real & (h + 2 < mesh.twin(h + 2));
  return count;
}

// The first triangle of each part, and their number. Ghosts are found along the hull.
std::vector<std::size_t> number_parts(const Mesh2& mesh, const Parts& parts) {
  std::vector<std::size_t> ghosts(parts.count(), 0), first(parts.count() + 1, 0);
  Id g = mesh.ghost;
  do {
    ++ghosts[parts.holding(static_cast<std::size_t>(g) / 8)];
    g = mesh.ghost_after(g);
  } while (g != mesh.ghost);
  for (std::size_t i = 0; i < parts.count(); ++i) {
    first[i + 1] = first[i] + (parts.end(i) - parts.begin(i)) - ghosts[i];
  }
  return first;
}

// Calls use(t, id) for each triangle of a part; ghosts get the id -1. Ids are kept in
// the spare slot 8t + 3; 8t + 7 is for what tells which edges are attached, `none` for now.
// Returns the number of edges that the part writes.
template <class Use>
std::size_t number_triangles(Mesh2& mesh, const Parts& parts, std::size_t part, std::size_t first,
                             Id none, Use&& use) {
  auto id = static_cast<Id>(first);
  std::size_t edges = 0;
  Id owned[3];
  for (std::size_t t = parts.begin(part); t < parts.end(part); ++t) {
    const bool ghost = mesh.is_ghost(static_cast<Id>(8 * t));
    mesh.slot[8 * t + 3] = ghost ? -1 : id;
    mesh.slot[8 * t + 7] = none;
    edges += static_cast<std::size_t>(owned_edges(mesh, t, owned));
    if (!ghost) use(t, static_cast<std::size_t>(id++));
  }
  return edges;
}

// Turns counts (count[i + 1] of part i) into first rows.
void accumulate(std::vector<std::size_t>& count) {
  for (std::size_t i = 1; i < count.size(); ++i) count[i] += count[i - 1];
}

void sort3(Id* v) {
  const Id a = std::min(v[0], v[1]), b = std::max(v[0], v[1]);
  const Id c = std::min(b, v[2]);
  v[2] = std::max(b, v[2]);
  v[0] = std::min(a, c);
  v[1] = std::max(a, c);
}

void write_edge(const Id* row, Id u, Id v, Id* out) {
  const Id a = row[u], b = row[v];
  out[0] = std::min(a, b);
  out[1] = std::max(a, b);
}

// Writes the triangles of a part and returns how many edges it will write.
template <class S>
std::vector<std::size_t> write_triangles(const SpatialOrder<S>& order, Mesh2& mesh,
                                         const Parts& parts, const std::vector<std::size_t>& first,
                                         Filtration2& out, Job& job) {
  const Id* row = order.row.data();
  const auto* p = order.points.data();
  std::vector<std::size_t> edges(parts.count() + 1, 0);
  job.run(parts.count(), [&](std::size_t part) {
    typename Blocks<S>::Triangles block;
    std::size_t slot[TriangleBlock::kSize], written = first[part];
    auto flush = [&] {
      block.measure(order.lattice, order.exponent);
      for (std::size_t i = 0; i < block.count; ++i) {
        out.triangle_radii[written + i] = block.radius[i];
        mesh.slot[slot[i] + 7] = Blocks<S>::code(block, i);
      }
      written += block.count;
      block.count = 0;
    };
    auto use = [&](std::size_t t, std::size_t id) {
      const Id* v = &mesh.slot[8 * t];
      slot[block.count] = 8 * t;
      block.push(p[v[0]], p[v[1]], p[v[2]]);
      if (block.count == TriangleBlock::kSize) flush();
      Id* to = &out.triangles[3 * id];
      for (int i = 0; i < 3; ++i) to[i] = row[v[i]];
      sort3(to);
    };
    edges[part + 1] = number_triangles(mesh, parts, part, first[part], Blocks<S>::kNone, use);
    flush();
    job.advance(0.15 / static_cast<double>(parts.count()));
  });
  accumulate(edges);
  return edges;
}

// Writes the edges h[0] ... h[count - 1] from row e on.
template <class S>
class EdgeWriter {
 public:
  EdgeWriter(const SpatialOrder<S>& order, const Mesh2& mesh, Filtration2& out)
      : p_(order.points.data()),
        row_(order.row.data()),
        m_(mesh.slot.data()),
        lattice_(order.lattice),
        unscale_(-order.exponent),
        out_(out) {}

  void write(const Id* h, std::size_t count, std::size_t e) {
    for (std::size_t i = 0; i < count; ++i) {
      block_.set(i, p_[m_[h[i]]], p_[m_[m_[h[i] + 4]]]);
    }
    Blocks<S>::measure(block_, count, lattice_);
    for (std::size_t i = 0; i < count; ++i) {
      write_one(h[i], e + i, unscale_ * Blocks<S>::radius(block_, i));
    }
  }

 private:
  void write_one(Id h, std::size_t e, double radius) {
    const Id g = m_[h + 4], base = Mesh2::base(h), other = Mesh2::base(g);
    const Id here = m_[base + 3], there = m_[other + 3];
    const double* radii = out_.triangle_radii.data();
    const bool attached =
        Blocks<S>::attached(m_[base + 7], h & 3) | Blocks<S>::attached(m_[other + 7], g & 3);
    const double enter = std::min(here < 0 ? kInf : radii[here], there < 0 ? kInf : radii[there]);
    const double value[2] = {std::min(radius, enter), enter};  // however they were rounded
    out_.edge_radii[e] = value[attached];
    write_edge(row_, m_[h], m_[g], &out_.edges[2 * e]);
    out_.edge_triangles[2 * e] = here < 0 ? there : here;
    out_.edge_triangles[2 * e + 1] = here < 0 ? -1 : there;
  }

  const typename S::Point* p_;
  const Id* row_;
  const Id* m_;
  Lattice lattice_;
  PowerOfTwo unscale_;
  Filtration2& out_;
  typename Blocks<S>::Edges block_;
};

template <class S>
void write_edges(const SpatialOrder<S>& order, const Mesh2& mesh, const Parts& parts,
                 const std::vector<std::size_t>& first, Filtration2& out, Job& job) {
  job.run(parts.count(), [&](std::size_t part) {
    EdgeWriter<S> writer(order, mesh, out);
    Id owned[EdgeBlock::kSize];
    std::size_t e = first[part];
    for (std::size_t t = parts.begin(part); t < parts.end(part);) {
      std::size_t count = 0;
      for (const std::size_t end = std::min(t + TriangleBlock::kSize, parts.end(part)); t < end;
           ++t) {
        count += static_cast<std::size_t>(owned_edges(mesh, t, owned + count));
      }
      writer.write(owned, count, e);
      e += count;
    }
    job.advance(0.15 / static_cast<double>(parts.count()));
  });
}

}  // namespace

template <class S>
Filtration2 filtration2(const SpatialOrder<S>& order, Mesh2& mesh, Job& job) {
  Filtration2 out;
  if (mesh.triangles == 0) return out;
  const Parts parts(mesh.triangles, job);
  const std::vector<std::size_t> first = number_parts(mesh, parts);
  const std::size_t triangles = first.back();
  const std::size_t edges = triangles + mesh.triangles / 2;  // Euler
  out.triangles = Buffer<Id>(3 * triangles);
  out.triangle_radii = Buffer<double>(triangles);
  const std::vector<std::size_t> first_edge = write_triangles(order, mesh, parts, first, out, job);
  out.edges = Buffer<Id>(2 * edges);
  out.edge_radii = Buffer<double>(edges);
  out.edge_triangles = Buffer<Id>(2 * edges);
  write_edges(order, mesh, parts, first_edge, out, job);
  return out;
}

template Filtration2 filtration2<Plane>(const SpatialOrder2&, Mesh2&, Job&);
template Filtration2 filtration2<Sheet>(const SpatialOrder<Sheet>&, Mesh2&, Job&);
template Filtration2 filtration2<WeightedPlane>(const SpatialOrder<WeightedPlane>&, Mesh2&, Job&);
template Filtration2 filtration2<WeightedSheet>(const SpatialOrder<WeightedSheet>&, Mesh2&, Job&);

Triangulation2 triangulation2(const SpatialOrder2& order, Mesh2& mesh, Job& job) {
  Triangulation2 out;
  if (mesh.triangles == 0) return out;
  const Parts parts(mesh.triangles, job);
  const std::vector<std::size_t> first = number_parts(mesh, parts);
  const std::size_t triangles = first.back();
  const Id* row = order.row.data();
  const Id* m = mesh.slot.data();
  if (triangles == 0) {
    out.edges = Buffer<Id>(2 * (order.size - 1));
    std::size_t e = 0;
    Id owned[3];
    for (std::size_t t = 0; t < mesh.triangles; ++t) {
      if (owned_edges(mesh, t, owned) == 0) continue;
      write_edge(row, m[owned[0]], m[mesh.twin(owned[0])], &out.edges[2 * e++]);
    }
    return out;
  }
  out.triangles = Buffer<Id>(3 * triangles);
  out.neighbors = Buffer<Id>(3 * triangles);
  job.run(parts.count(), [&](std::size_t part) {
    number_triangles(mesh, parts, part, first[part], 0, [](std::size_t, std::size_t) {});
  });
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t t = parts.begin(part); t < parts.end(part); ++t) {
      const Id id = m[8 * t + 3];
      if (id < 0) continue;
      // A vertex and the neighbour opposite to it, packed, are sorted as one.
      std::int64_t pair[3];
      for (std::size_t i = 0; i < 3; ++i) {
        const Id across = m[8 * t + 4 + (i + 1) % 3];
        const Id neighbor = m[Mesh2::base(across) + 3];
        pair[i] = (std::int64_t{row[m[8 * t + i]]} << 32) | static_cast<std::uint32_t>(neighbor);
      }
      std::sort(pair, pair + 3);
      for (std::size_t i = 0; i < 3; ++i) {
        out.triangles[3 * static_cast<std::size_t>(id) + i] = static_cast<Id>(pair[i] >> 32);
        out.neighbors[3 * static_cast<std::size_t>(id) + i] = static_cast<Id>(pair[i] & 0xffffffff);
      }
    }
  });
  return out;
}

}  // namespace alphamesh
