#include "output3.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <vector>

#include "values3.hpp"

namespace alphamesh {
namespace {

using Id = std::int32_t;
constexpr double kInf = std::numeric_limits<double>::infinity();

template <class Row>
void sort_row(Row* row, int count) {
  for (int i = 1; i < count; ++i) {
    for (int k = i; k > 0 && row[k] < row[k - 1]; --k) std::swap(row[k], row[k - 1]);
  }
}

// Fills the arrays of a filtration; a part is a range of tetrahedra.
class Writer {
 public:
  Writer(const SpatialOrder3& order, const Buffer<Tetrahedron>& mesh, Filtration3& out, Job& job)
      : order_(order),
        p_(order.points.data()),
        mesh_(mesh),
        count_(mesh.size()),
        out_(out),
        job_(job),
        parts_(count_, job, 1024),
        measure_(order.lattice, -order.exponent) {}

  void tetrahedra();
  void triangles();
  void edges();

 private:
  // Edges of a part, in blocks, as their number is not known beforehand.
  struct Edge {
    Id ends[2];
    double value;
  };
  static constexpr std::size_t kBlock = 1 << 14;
  struct Found {
    std::vector<Buffer<Edge>> block;
    std::size_t count = 0;
  };

  // A triangle belongs to the lower of its two tetrahedra, an edge to the lowest of all.
  bool owns(std::size_t t, int k) const {
    const Id code = mesh_[t].neighbor[k];
    return code < 0 || static_cast<std::size_t>(code >> 2) > t;
  }
  void write_triangle(std::size_t t, int k, std::size_t f);
  bool ring_value(std::size_t t, int i, int j, std::size_t lo, std::size_t hi, double* value);
  void part_edges(std::size_t lo, std::size_t hi, Found& found);

  const SpatialOrder3& order_;
  const Point3* p_;
  const Buffer<Tetrahedron>& mesh_;
  std::size_t count_;
  Filtration3& out_;
  Job& job_;
  Parts parts_;
  Measure3 measure_;
  Buffer<std::uint8_t> attached_;   // per tetrahedron, see Measure3::Solid
  Buffer<std::uint8_t> obtuse_;     // per facet 4t + k: position in t of its obtuse vertex, or k
  Buffer<std::uint8_t> done_;       // edges of a tetrahedron seen by a lower one of the same part
  Buffer<Id> facet_;                // per facet 4t + k: its triangle
  std::vector<std::size_t> first_;  // first triangle of each part
};

void Writer::tetrahedra() {
  out_.tetrahedra = Buffer<Id>(4 * count_);
  out_.tetrahedron_radii = Buffer<double>(count_);
  attached_ = Buffer<std::uint8_t>(count_);
  first_.assign(parts_.count() + 1, 0);
  job_.run(parts_.count(), [&](std::size_t part) {
    std::size_t triangles = 0;
    for (std::size_t t = parts_.begin(part); t < parts_.end(part); ++t) {
      const Id* v = mesh_[t].vertex;
      const Point3 p[4] = {p_[v[0]], p_[v[1]], p_[v[2]], p_[v[3]]};
      const Measure3::Solid m = measure_.tetrahedron(p);
      out_.tetrahedron_radii[t] = m.radius;
      attached_[t] = static_cast<std::uint8_t>(m.attached);
      Id* row = &out_.tetrahedra[4 * t];
      for (int k = 0; k < 4; ++k) {
        row[k] = order_.row[static_cast<std::size_t>(v[k])];
        triangles += owns(t, k) ? 1 : 0;
      }
      sort_row(row, 4);
    }
    first_[part + 1] = triangles;
    job_.advance(0.1 / static_cast<double>(parts_.count()));
  });
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
}

void Writer::write_triangle(std::size_t t, int k, std::size_t f) {
  const Tetrahedron& tet = mesh_[t];
  int at[3];  // positions in t, in lexicographic order as those of t are
  for (int i = 0, m = 0; i < 4; ++i) {
    if (i != k) at[m++] = i;
  }
  const Point3 p[3] = {p_[tet.vertex[at[0]]], p_[tet.vertex[at[1]]], p_[tet.vertex[at[2]]]};
  const Measure3::Flat m = measure_.triangle(p);
  const Id code = tet.neighbor[k];
  double least = out_.tetrahedron_radii[t];
  bool attached = (attached_[t] >> k & 1) != 0;
  facet_[4 * t + static_cast<std::size_t>(k)] = static_cast<Id>(f);
  obtuse_[4 * t + static_cast<std::size_t>(k)] =
      static_cast<std::uint8_t>(m.obtuse == 3 ? k : at[m.obtuse]);
  if (code >= 0) {
    const auto other = static_cast<std::size_t>(code >> 2);
    const int j = code & 3;
    least = std::min(least, out_.tetrahedron_radii[other]);
    attached = attached || (attached_[other] >> j & 1) != 0;
    facet_[static_cast<std::size_t>(code)] = static_cast<Id>(f);
    // The same three vertices stand in the same order on the other side.
    const int there = m.obtuse == 3 ? j : m.obtuse + (m.obtuse >= j ? 1 : 0);
    obtuse_[static_cast<std::size_t>(code)] = static_cast<std::uint8_t>(there);
  }
  out_.triangle_radii[f] = attached ? least : std::min(m.radius, least);
  out_.triangle_tetrahedra[2 * f] = static_cast<Id>(t);
  out_.triangle_tetrahedra[2 * f + 1] = code < 0 ? -1 : code >> 2;
  Id* row = &out_.triangles[3 * f];
  for (int i = 0; i < 3; ++i) row[i] = order_.row[static_cast<std::size_t>(tet.vertex[at[i]])];
  sort_row(row, 3);
}

void Writer::triangles() {
  const std::size_t count = first_.back();
  out_.triangles = Buffer<Id>(3 * count);
  out_.triangle_radii = Buffer<double>(count);
  out_.triangle_tetrahedra = Buffer<Id>(2 * count);
  facet_ = Buffer<Id>(4 * count_);
  obtuse_ = Buffer<std::uint8_t>(4 * count_);
  job_.run(parts_.count(), [&](std::size_t part) {
    std::size_t f = first_[part];
    for (std::size_t t = parts_.begin(part); t < parts_.end(part); ++t) {
      for (int k = 0; k < 4; ++k) {
        if (owns(t, k)) write_triangle(t, k, f++);
      }
    }
    job_.advance(0.1 / static_cast<double>(parts_.count()));
  });
}

// One bit for each edge of a tetrahedron, by the positions of its ends.
constexpr std::uint8_t kEdgeBit[4][4] = {
    {0, 1, 2, 4}, {1, 0, 8, 16}, {2, 8, 0, 32}, {4, 16, 32, 0}};

// Goes around the edge between the vertices at positions i and j of t. False if a lower
// tetrahedron has it. Those of the same part that are passed need not start again.
bool Writer::ring_value(std::size_t t, int i, int j, std::size_t lo, std::size_t hi,
                        double* value) {
  const Id u = mesh_[t].vertex[i], v = mesh_[t].vertex[j];
  int side[2];  // the other two positions
  for (int k = 0, m = 0; k < 4; ++k) {
    if (k != i && k != j) side[m++] = k;
  }
  bool attached = false;
  double least = kInf;
  for (int direction = 0; direction < 2; ++direction) {
    std::size_t s = t;
    int leave = side[direction], keep = side[1 - direction];  // facet to cross, its apex
    for (;;) {
      const std::size_t facet = 4 * s + static_cast<std::size_t>(leave);
      attached = attached || obtuse_[facet] == keep;
      least = std::min(least, out_.triangle_radii[static_cast<std::size_t>(facet_[facet])]);
      const Id code = mesh_[s].neighbor[leave], apex = mesh_[s].vertex[keep];
      if (code < 0) break;  // the hull: go around the other way too
      s = static_cast<std::size_t>(code >> 2);
      if (s == t) {
        *value = attached ? least
                          : std::min(measure_.edge(p_[std::min(u, v)], p_[std::max(u, v)]), least);
        return true;
      }
      if (s < t) return false;
      const int back = code & 3;
      int next = 0;
      while (mesh_[s].vertex[next] != apex) ++next;
      if (s >= lo && s < hi) {
        // The two positions that are not on the edge are `back` and `next`.
        int a = 0;
        while (a == back || a == next) ++a;
        const int b = 6 - back - next - a;
        done_[s] |= kEdgeBit[a][b];
      }
      leave = next;
      keep = back;
    }
  }
  *value =
      attached ? least : std::min(measure_.edge(p_[std::min(u, v)], p_[std::max(u, v)]), least);
  return true;
}

void Writer::part_edges(std::size_t lo, std::size_t hi, Found& found) {
  for (std::size_t t = lo; t < hi; ++t) {
    if (((t - lo) & 0x3fff) == 0) job_.poll();
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) {
        double value;
        if ((done_[t] & kEdgeBit[i][j]) != 0 || !ring_value(t, i, j, lo, hi, &value)) continue;
        const Id a = order_.row[static_cast<std::size_t>(mesh_[t].vertex[i])];
        const Id b = order_.row[static_cast<std::size_t>(mesh_[t].vertex[j])];
        if (found.count % kBlock == 0) found.block.emplace_back(kBlock);
        found.block.back()[found.count++ % kBlock] = {{std::min(a, b), std::max(a, b)}, value};
      }
    }
  }
}

void Writer::edges() {
  done_ = Buffer<std::uint8_t>(count_);
  std::fill(done_.begin(), done_.end(), std::uint8_t{0});
  std::vector<Found> found(parts_.count());
  job_.run(parts_.count(), [&](std::size_t part) {
    part_edges(parts_.begin(part), parts_.end(part), found[part]);
    job_.advance(0.2 / static_cast<double>(parts_.count()));
  });
  std::vector<std::size_t> first(parts_.count() + 1, 0);
  for (std::size_t i = 0; i < found.size(); ++i) first[i + 1] = first[i] + found[i].count;
  out_.edges = Buffer<Id>(2 * first.back());
  out_.edge_radii = Buffer<double>(first.back());
  job_.run(parts_.count(), [&](std::size_t part) {
    for (std::size_t i = 0; i < found[part].count; ++i) {
      const Edge& e = found[part].block[i / kBlock][i % kBlock];
      std::copy(e.ends, e.ends + 2, &out_.edges[2 * (first[part] + i)]);
      out_.edge_radii[first[part] + i] = e.value;
    }
  });
}

}  // namespace

Filtration3 filtration3(const SpatialOrder3& order, const Buffer<Tetrahedron>& mesh, Job& job) {
  Filtration3 out;
  if (mesh.size() == 0) return out;
  Writer writer(order, mesh, out, job);
  writer.tetrahedra();
  writer.triangles();
  writer.edges();
  return out;
}

}  // namespace alphamesh
