#include "output3.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "edges3.hpp"
#include "rules3.hpp"

namespace alphamesh {
namespace {

using Id = std::int32_t;
constexpr std::size_t kBlock = TetrahedronBlock::kSize;

void settle(Id& a, Id& b) {
  const Id low = std::min(a, b), high = std::max(a, b);
  a = low;
  b = high;
}

void write_triangle(const Id* row, const Id* v, Id* out) {
  for (int k = 0; k < 3; ++k) out[k] = row[v[k]];
  settle(out[0], out[1]);
  settle(out[1], out[2]);
  settle(out[0], out[1]);
}

// Turns vertices into rows of the input's numbers, ascending, in place.
void sort_rows(const SpatialOrder3& order, Buffer<Id>& tetrahedra, Job& job) {
  const Parts parts(tetrahedra.size() / 4, job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t t = parts.begin(part); t < parts.end(part); ++t) {
      Id* v = &tetrahedra[4 * t];
      for (int k = 0; k < 4; ++k) v[k] = order.row[static_cast<std::size_t>(v[k])];
      settle(v[0], v[1]);
      settle(v[2], v[3]);
      settle(v[0], v[2]);
      settle(v[1], v[3]);
      settle(v[1], v[2]);
    }
  });
}

// Fills the arrays of triangles, and the radii of tetrahedra; a part is a range of tetrahedra.
template <class Rule>
class Writer {
 public:
  using Tetrahedra = typename Rule::Tetrahedra;
  using Triangles = typename Rule::Triangles;

  Writer(const SpatialOrder3& order, const Rule& rule, const Compact3& mesh, Facets3<Rule>& facets,
         Filtration3& out, Job& job)
      : order_(order),
        rule_(rule),
        row_(order.row.data()),
        mesh_(mesh),
        facets_(facets),
        out_(out),
        job_(job),
        parts_(mesh.count, job, 1024) {}

  void tetrahedra();
  void triangles();

 private:
  void write_tetrahedra(std::size_t t, std::size_t end, Tetrahedra& block);
  std::size_t number_triangles(std::size_t lo, std::size_t hi);
  void write_triangles(const Id* owned, std::size_t count, std::size_t f, Triangles& block);
  void flush(Triangles& block, const std::size_t* at);

  const SpatialOrder3& order_;
  const Rule& rule_;
  const Id* row_;
  const Compact3& mesh_;
  Facets3<Rule>& facets_;
  Filtration3& out_;
  Job& job_;
  Parts parts_;
  Buffer<std::uint8_t> attached_;   // per tetrahedron, see TetrahedronBlock
  std::vector<std::size_t> first_;  // first triangle of each part
};

template <class Rule>
void Writer<Rule>::write_tetrahedra(std::size_t t, std::size_t end, Tetrahedra& block) {
  for (std::size_t i = t; i < end; ++i) {
    rule_.push(block, &mesh_.vertex[4 * i]);
  }
  block.measure(order_.lattice, order_.exponent);
  std::copy(block.radius, block.radius + block.count, &out_.tetrahedron_radii[t]);
  std::copy(block.attached, block.attached + block.count, &attached_[t]);
  const auto* codes = Rule::codes(block);
  for (std::size_t i = 0; i < block.count; ++i) facets_.of[t + i].code = codes[i];
  block.count = 0;
}

// Counts the triangles of each tetrahedron of a part, from 0.
template <class Rule>
std::size_t Writer<Rule>::number_triangles(std::size_t lo, std::size_t hi) {
  std::size_t triangles = 0;
  for (std::size_t t = lo; t < hi; ++t) {
    const Id* code = &mesh_.neighbor[4 * t];
    int before[4], count = 0;
    for (int k = 0; k < 4; ++k) {
      before[k] = count;
      count += Facets3<Rule>::owns(t, code[k]);
    }
    auto& of = facets_.of[t];
    of.first = static_cast<Id>(triangles);
    of.before = static_cast<std::uint8_t>((before[1] << 2) | (before[2] << 4) | (before[3] << 6));
    of.met = 0;
    triangles += static_cast<std::size_t>(count);
  }
  return triangles;
}

template <class Rule>
void Writer<Rule>::tetrahedra() {
  out_.tetrahedron_radii = Buffer<double>(mesh_.count);
  attached_ = Buffer<std::uint8_t>(mesh_.count);
  facets_.of = Buffer<typename Facets3<Rule>::Of>(mesh_.count);
  first_.assign(parts_.count() + 1, 0);
  job_.run(parts_.count(), [&](std::size_t part) {
    Tetrahedra block;
    const std::size_t hi = parts_.end(part);
    for (std::size_t t = parts_.begin(part); t < hi; t += kBlock) {
      write_tetrahedra(t, std::min(t + kBlock, hi), block);
    }
    first_[part + 1] = number_triangles(parts_.begin(part), hi);
    job_.advance(0.1 / static_cast<double>(parts_.count()));
  });
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
}

template <class Rule>
void Writer<Rule>::flush(Triangles& block, const std::size_t* at) {
  block.measure(order_.lattice, order_.exponent);
  for (std::size_t i = 0; i < block.count; ++i) {
    double& radius = out_.triangle_radii[at[i]];
    radius = std::min(radius, block.radius[i]);
  }
  block.count = 0;
}

// The triangles that are facets owned[i] = 4t + k, from row f on: those that are attached
// enter with their first tetrahedron.
template <class Rule>
void Writer<Rule>::write_triangles(const Id* owned, std::size_t count, std::size_t f,
                                   Triangles& block) {
  std::size_t free[kBlock], at[kBlock];  // owned[free[i]] is not attached
  std::size_t frees = 0;
  auto measure = [&] {
    for (std::size_t i = 0; i < frees; ++i) {
      const std::size_t t = static_cast<std::size_t>(owned[free[i]] >> 2);
      const Id* v = &mesh_.vertex[4 * t];
      const int k = owned[free[i]] & 3;
      rule_.push(block, v[k == 0 ? 1 : 0], v[k <= 1 ? 2 : 1], v[k <= 2 ? 3 : 2]);
      at[i] = f + free[i];
    }
    flush(block, at);
    frees = 0;
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Id code = mesh_.neighbor[static_cast<std::size_t>(owned[i])];
    const std::size_t t = static_cast<std::size_t>(owned[i] >> 2);
    const std::size_t other = code < 0 ? t : static_cast<std::size_t>(code >> 2);
    const int k = owned[i] & 3, j = code < 0 ? k : code & 3;
    out_.triangle_radii[f + i] = std::min(out_.tetrahedron_radii[t], out_.tetrahedron_radii[other]);
    out_.triangle_tetrahedra[2 * (f + i)] = static_cast<Id>(t);
    out_.triangle_tetrahedra[2 * (f + i) + 1] = code < 0 ? -1 : code >> 2;
    const Id* v = &mesh_.vertex[4 * t];
    const Id corner[3] = {v[k == 0 ? 1 : 0], v[k <= 1 ? 2 : 1], v[k <= 2 ? 3 : 2]};
    write_triangle(row_, corner, &out_.triangles[3 * (f + i)]);
    free[frees] = i;
    frees += (((attached_[t] >> k) | (attached_[other] >> j)) & 1) == 0 ? 1 : 0;
    if (frees == kBlock) measure();
  }
  measure();
}

template <class Rule>
void Writer<Rule>::triangles() {
  const std::size_t count = first_.back();
  out_.triangles = Buffer<Id>(3 * count);
  out_.triangle_radii = Buffer<double>(count);
  out_.triangle_tetrahedra = Buffer<Id>(2 * count);
  job_.run(parts_.count(), [&](std::size_t part) {
    Triangles block;
    Id owned[4 * kBlock + 4];
    std::size_t f = first_[part];
    const std::size_t hi = parts_.end(part);
    for (std::size_t t = parts_.begin(part); t < hi;) {
      std::size_t found = 0;
      for (const std::size_t end = std::min(t + kBlock, hi); t < end; ++t) {
        facets_.of[t].first += static_cast<Id>(first_[part]);
        for (std::size_t k = 0; k < 4; ++k) {
          owned[found] = static_cast<Id>(4 * t + k);
          found += static_cast<std::size_t>(Facets3<Rule>::owns(t, mesh_.neighbor[4 * t + k]));
        }
      }
      write_triangles(owned, found, f, block);
      f += found;
    }
    job_.advance(0.1 / static_cast<double>(parts_.count()));
  });
}

}  // namespace

Filtration3 in_space(Filtration2&& flat) {
  Filtration3 f;
  f.triangle_tetrahedra = Buffer<Id>(2 * flat.triangle_radii.size());
  std::fill(f.triangle_tetrahedra.begin(), f.triangle_tetrahedra.end(), -1);
  f.triangles = std::move(flat.triangles);
  f.triangle_radii = std::move(flat.triangle_radii);
  f.edges = std::move(flat.edges);
  f.edge_radii = std::move(flat.edge_radii);
  return f;
}

template <class Rule>
Filtration3 filtration3(const SpatialOrder3& order, Compact3&& compact, Rule& rule, Job& job) {
  Filtration3 out;
  Compact3 mesh = std::move(compact);
  if (mesh.count == 0) return out;
  Facets3<Rule> facets;
  {
    Writer<Rule> writer(order, rule, mesh, facets, out, job);
    writer.tetrahedra();
    writer.triangles();
  }
  Edges3 edges = edges3<Rule>(order, mesh, facets, rule, out.triangle_radii, job);
  out.edges = std::move(edges.ends);
  out.edge_radii = std::move(edges.radii);
  sort_rows(order, mesh.vertex, job);
  out.tetrahedra = std::move(mesh.vertex);
  return out;
}

template Filtration3 filtration3<PlainRule3>(const SpatialOrder3&, Compact3&&, PlainRule3&, Job&);
template Filtration3 filtration3<WeightedRule3>(const SpatialOrder3&, Compact3&&, WeightedRule3&,
                                                Job&);

Filtration3 filtration3(const SpatialOrder3& order, Compact3&& mesh, Job& job) {
  PlainRule3 rule(order);
  return filtration3<PlainRule3>(order, std::move(mesh), rule, job);
}

}  // namespace alphamesh
