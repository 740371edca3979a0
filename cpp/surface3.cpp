#include "surface3.hpp"

#include <algorithm>
#include <vector>

#include "disjoint_sets.hpp"
#include "predicates3.hpp"
#include "radix_sort.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {
namespace {

using Id = std::int32_t;
constexpr Id kNone = -1;

// The lower number becomes the root, so that roots come in the order of the members.
void unite(DisjointSets& sets, Id a, Id b) {
  a = sets.root(a);
  b = sets.root(b);
  if (a != b) sets.join(std::max(a, b), std::min(a, b));
}

class Skin {
 public:
  Skin(const Solid3& solid, Job& job);

  Surface3 take() { return std::move(out_); }
  void connect(Job& job);
  void orient(Job& job);
  void number_vertices(Job& job);
  bool part_double_edges();
  void number_shells();

 private:
  const Id* vertices(Id t) const { return solid_.tetrahedra + 4 * static_cast<std::size_t>(t); }
  const Id* corners(Id f) const { return solid_.triangles + 3 * static_cast<std::size_t>(f); }
  const Id* cofaces(Id f) const {
    return solid_.triangle_tetrahedra + 2 * static_cast<std::size_t>(f);
  }
  bool chosen(Id t) const { return t != kNone && solid_.inside[t]; }
  Id inner(Id f) const { return chosen(cofaces(f)[0]) ? cofaces(f)[0] : cofaces(f)[1]; }
  Id partner(Id f, int side) const;
  Id begin(Id s) const { return out_.corner[s - s % 3 + (s + 1) % 3]; }
  Id end(Id s) const { return out_.corner[s - s % 3 + (s + 2) % 3]; }
  Id side_from(Id facet, Id row) const;
  // The side that begins at the same point as side s, one facet further around it.
  Id turned(Id s) const { return side_from(out_.across[s], begin(s)); }
  Id back(Id s) const { return side_from(out_.across[s], end(s)); }
  bool part(const std::vector<Id>& group);

  const Solid3& solid_;
  Surface3 out_;
  Buffer<Id> facet_of_;  // per triangle, kNone if it is no facet
};

Skin::Skin(const Solid3& solid, Job& job) : solid_(solid), facet_of_(solid.triangle_count) {
  Id count = 0;
  for (std::size_t f = 0; f < solid.triangle_count; ++f) {
    if ((f & 0xffff) == 0) job.poll();
    const Id* t = cofaces(static_cast<Id>(f));
    facet_of_[f] = chosen(t[0]) != chosen(t[1]) ? count++ : kNone;
  }
  const auto k = static_cast<std::size_t>(count);
  out_.triangle = Buffer<Id>(k);
  out_.corner = Buffer<Id>(3 * k);
  out_.across = Buffer<Id>(3 * k);
  for (std::size_t f = 0; f < solid.triangle_count; ++f) {
    if (facet_of_[f] == kNone) continue;
    const auto i = static_cast<std::size_t>(facet_of_[f]);
    out_.triangle[i] = static_cast<Id>(f);
    std::copy_n(corners(static_cast<Id>(f)), 3, out_.corner.data() + 3 * i);
  }
}

// From a facet through the chosen tetrahedra around one of its edges, the one opposite to
// corner `side`, to the facet at the other end of that wedge.
Id Skin::partner(Id f, int side) const {
  const Id a = corners(f)[side == 0 ? 1 : 0], b = corners(f)[side == 2 ? 1 : 2];
  Id behind = corners(f)[side];  // of the triangle that was left, the corner off the edge
  for (Id t = inner(f);;) {
    const Id* v = vertices(t);
    int out = 0, ahead = 0;
    for (int k = 0; k < 4; ++k) {
      if (v[k] == behind) {
        out = k;
      } else if (v[k] != a && v[k] != b) {
        ahead = k;
      }
    }
    const Id g = solid_.tetrahedron_triangles[4 * static_cast<std::size_t>(t) + out];
    if (facet_of_[g] != kNone) return facet_of_[g];
    behind = v[ahead];
    t = cofaces(g)[0] == t ? cofaces(g)[1] : cofaces(g)[0];
  }
}

void Skin::connect(Job& job) {
  const Parts parts(out_.triangle.size(), job, 4096);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      for (int side = 0; side < 3; ++side) {
        out_.across[3 * i + side] = partner(out_.triangle[i], side);
      }
    }
  });
}

// Turns the facets so that their tetrahedra lie behind them.
void Skin::orient(Job& job) {
  const PowerOfTwo factor(range_exponent<Space>(solid_.points, solid_.n, job));
  auto point = [&](Id row) {
    const double* p = solid_.points + 3 * static_cast<std::size_t>(row);
    return Point3{factor * p[0], factor * p[1], factor * p[2]};
  };
  const Parts parts(out_.triangle.size(), job, 4096);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      Id* c = out_.corner.data() + 3 * i;
      const Id* v = vertices(inner(out_.triangle[i]));
      Id apex = v[0];
      for (int k = 1; k < 4 && (apex == c[0] || apex == c[1] || apex == c[2]); ++k) apex = v[k];
      if (orient3(point(c[0]), point(c[1]), point(c[2]), point(apex), Lattice3()) > 0) {
        std::swap(c[1], c[2]);
        std::swap(out_.across[3 * i + 1], out_.across[3 * i + 2]);
      }
    }
  });
}

// Corners are one vertex if a way over facets and their common sides leads from one to
// the other around the point.
void Skin::number_vertices(Job& job) {
  const std::size_t k = out_.triangle.size();
  DisjointSets fans(3 * k);
  for (std::size_t i = 0; i < k; ++i) {
    if ((i & 0xfff) == 0) job.poll();
    for (std::size_t side = 0; side < 3; ++side) {
      const auto j = static_cast<std::size_t>(out_.across[3 * i + side]);
      if (j < i) continue;
      for (std::size_t end = 1; end < 3; ++end) {
        const std::size_t at = 3 * i + (side + end) % 3;
        const Id row = out_.corner[at];
        const Id* c = out_.corner.data() + 3 * j;
        const std::size_t other = 3 * j + (c[0] == row ? 0 : (c[1] == row ? 1 : 2));
        unite(fans, static_cast<Id>(at), static_cast<Id>(other));
      }
    }
  }
  std::vector<std::size_t> roots;
  for (std::size_t c = 0; c < 3 * k; ++c) {
    if (fans.root(static_cast<Id>(c)) == static_cast<Id>(c)) roots.push_back(c);
  }
  Buffer<std::uint64_t> order(roots.size());
  for (std::size_t r = 0; r < roots.size(); ++r) {
    order[r] = (std::uint64_t{static_cast<std::uint32_t>(out_.corner[roots[r]])} << 32) | roots[r];
  }
  radix_sort(order, 32, job);
  out_.vertex = Buffer<Id>(3 * k);
  out_.row = Buffer<Id>(roots.size());
  for (std::size_t v = 0; v < order.size(); ++v) {
    const auto c = static_cast<std::size_t>(static_cast<std::uint32_t>(order[v]));
    out_.vertex[c] = static_cast<Id>(v);
    out_.row[v] = out_.corner[c];
  }
  for (std::size_t c = 0; c < 3 * k; ++c) {
    out_.vertex[c] = out_.vertex[static_cast<std::size_t>(fans.root(static_cast<Id>(c)))];
  }
}

// Side 3 f + j leads from corner j + 1 of facet f to corner j + 2.
Id Skin::side_from(Id facet, Id row) const {
  const Id* c = out_.corner.data() + 3 * static_cast<std::size_t>(facet);
  const int k = c[0] == row ? 0 : (c[1] == row ? 1 : 2);
  return 3 * facet + (k + 2) % 3;
}

// Sides of one edge, each with another facet across, all from a common vertex to a common
// vertex. Of two that really lie in common fans at both ends, the facets change partners:
// then the fans are two at either end. Going around the first end, the next side is the
// nearest one, so that sheets do not cross.
bool Skin::part(const std::vector<Id>& group) {
  auto among = [&](Id s) { return std::find(group.begin(), group.end(), s) != group.end(); };
  bool changed = false;
  for (const Id first : group) {
    const Id home = back(first);
    for (Id s = turned(first); s != first; s = turned(s)) {
      if (!among(s)) continue;
      const Id goal = back(s);
      Id t = turned(home);
      while (t != home && t != goal) t = turned(t);
      if (t == home) continue;  // only one end is common
      std::swap(out_.across[first], out_.across[s]);
      out_.across[home] = s / 3;
      out_.across[goal] = first / 3;
      changed = true;
      break;
    }
  }
  return changed;
}

// Around an edge that is pinched, two sheets may have both of their ends in common, as fans
// that go there twice. There the facets before the same gap are joined instead. Returns
// whether there were such edges.
bool Skin::part_double_edges() {
  const std::size_t sides = out_.across.size(), count = out_.row.size();
  auto vertex_at = [&](std::size_t s, std::size_t step) {
    return out_.vertex[s - s % 3 + (s + step) % 3];
  };
  // Each edge has one side that leads to a higher vertex; here they stand by the lower one.
  std::vector<Id> first(count + 1, 0), rising(sides / 2);
  for (std::size_t s = 0; s < sides; ++s) {
    if (vertex_at(s, 1) < vertex_at(s, 2)) ++first[static_cast<std::size_t>(vertex_at(s, 1)) + 1];
  }
  for (std::size_t v = 0; v < count; ++v) first[v + 1] += first[v];
  std::vector<Id> next(first.begin(), first.end() - 1);
  for (std::size_t s = 0; s < sides; ++s) {
    if (vertex_at(s, 1) < vertex_at(s, 2)) {
      rising[static_cast<std::size_t>(next[static_cast<std::size_t>(vertex_at(s, 1))]++)] =
          static_cast<Id>(s);
    }
  }
  auto target = [&](Id s) { return vertex_at(static_cast<std::size_t>(s), 2); };
  std::vector<std::vector<Id>> groups;
  for (std::size_t v = 0; v < count; ++v) {
    const auto begin = rising.begin() + first[v], end = rising.begin() + first[v + 1];
    std::sort(begin, end,
              [&](Id s, Id t) { return target(s) != target(t) ? target(s) < target(t) : s < t; });
    for (auto i = begin; i != end;) {
      auto j = i;
      while (j != end && target(*j) == target(*i)) ++j;
      if (j - i > 1) groups.emplace_back(i, j);
      i = j;
    }
  }
  // In an order that does not depend on the numbers of the points.
  auto facets = [&](const std::vector<Id>& group) {
    std::vector<Id> all;
    for (const Id s : group) {
      all.push_back(s / 3);
      all.push_back(out_.across[s]);
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  std::vector<std::pair<std::vector<Id>, std::size_t>> order;
  for (std::size_t g = 0; g < groups.size(); ++g) order.emplace_back(facets(groups[g]), g);
  std::sort(order.begin(), order.end());
  bool changed = false;
  for (const auto& entry : order) {
    while (part(groups[entry.second])) changed = true;
  }
  return changed;
}

void Skin::number_shells() {
  const std::size_t k = out_.triangle.size();
  DisjointSets sets(k);
  for (std::size_t c = 0; c < 3 * k; ++c) unite(sets, static_cast<Id>(c / 3), out_.across[c]);
  out_.shell = Buffer<Id>(k);
  Id count = 0;
  for (std::size_t i = 0; i < k; ++i) {
    const auto root = static_cast<std::size_t>(sets.root(static_cast<Id>(i)));
    out_.shell[i] = root == i ? count++ : out_.shell[root];
  }
}

}  // namespace

Surface3 surface3(const Solid3& solid, Job& job) {
  Skin skin(solid, job);
  skin.connect(job);
  skin.orient(job);
  skin.number_vertices(job);
  if (skin.part_double_edges()) skin.number_vertices(job);
  skin.number_shells();
  return skin.take();
}

// Shells are disjoint closed surfaces. Each divides space, so that regions and parts of
// the complement form a tree with the shells as its edges: the shell of a region that
// leads towards infinity is its outer one. Parts before one shell are parts of one whole,
// connected where the solid is pinched.
Buffer<bool> outer_shells3(const std::int32_t* shell, const std::int32_t* region,
                           const std::int32_t* part, std::size_t k) {
  Id shells = 0, regions = 0, count = 1;
  for (std::size_t i = 0; i < k; ++i) {
    shells = std::max(shells, shell[i] + 1);
    regions = std::max(regions, region[i] + 1);
    count = std::max(count, part[i] + 1);
  }
  const auto s = static_cast<std::size_t>(shells), r = static_cast<std::size_t>(regions);
  const auto c = static_cast<std::size_t>(count);
  // Nodes: parts of the complement, then shells, which join them; regions stay apart.
  DisjointSets wholes(c + s);
  std::vector<Id> region_of(s);
  for (std::size_t i = 0; i < k; ++i) {
    unite(wholes, part[i], count + shell[i]);
    region_of[static_cast<std::size_t>(shell[i])] = region[i];
  }
  std::vector<std::vector<Id>> shells_of_region(r), shells_of_whole(c);
  for (Id i = 0; i < shells; ++i) {
    shells_of_region[static_cast<std::size_t>(region_of[static_cast<std::size_t>(i)])].push_back(i);
    shells_of_whole[static_cast<std::size_t>(wholes.root(count + i))].push_back(i);
  }
  Buffer<bool> outer(s);
  std::fill(outer.begin(), outer.end(), false);
  std::vector<Id> open{wholes.root(0)};
  std::vector<char> seen(r, 0);
  while (!open.empty()) {
    const auto whole = static_cast<std::size_t>(open.back());
    open.pop_back();
    for (const Id first : shells_of_whole[whole]) {
      const auto here = static_cast<std::size_t>(region_of[static_cast<std::size_t>(first)]);
      if (seen[here] != 0) continue;
      seen[here] = 1;
      outer[static_cast<std::size_t>(first)] = true;
      for (const Id next : shells_of_region[here]) {
        if (next != first) open.push_back(wholes.root(count + next));
      }
    }
  }
  return outer;
}

}  // namespace alphamesh
