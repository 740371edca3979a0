#include "solid.hpp"

#include "distance.hpp"
#include "locate3.hpp"
#include "nearest3.hpp"
#include "parts.hpp"
#include "surface3.hpp"

namespace trust {
namespace {

using alphamesh::Job;

class Solid {
 public:
  Solid(const Tetrahedra& tetrahedra, Job& job) : s_(tetrahedra), job_(job) {}

  void prove_surface();
  void prove_location();
  void prove_nearest();

 private:
  Id cell_apex(Id triangle, Id cell) const {
    return apex_of(s_.tetrahedra[static_cast<std::size_t>(cell)],
                   s_.triangles[static_cast<std::size_t>(triangle)]);
  }

  const Tetrahedra& s_;
  Job& job_;
  std::vector<char> inside_;
};

void Solid::prove_surface() {
  const double* radii = s_.f.tetrahedron_radii.data();
  std::vector<double> values(radii, radii + s_.tetrahedra.size());
  std::sort(values.begin(), values.end());
  const double radius = chosen_radius(values, s_.cloud.choice);
  for (std::size_t t = 0; t < s_.tetrahedra.size(); ++t) inside_.push_back(radii[t] <= radius);
  const bool* inside = reinterpret_cast<const bool*>(inside_.data());
  const auto skin = alphamesh::surface3(
      {s_.cloud.coordinates.data(), s_.cloud.n, s_.f.tetrahedra.data(), s_.tetrahedra.size(),
       s_.f.triangles.data(), s_.triangles.size(), s_.f.triangle_tetrahedra.data(),
       s_.tetrahedron_triangles.data(), inside},
      job_);
  const auto part = alphamesh::parts(s_.tetrahedra.size(), s_.f.triangle_tetrahedra.data(),
                                     s_.triangles.size(), inside, nullptr, job_);
  std::vector<Id> facets, region, before;
  for (std::size_t f = 0; f < s_.triangles.size(); ++f) {
    const Id s = s_.f.triangle_tetrahedra[2 * f], t = s_.f.triangle_tetrahedra[2 * f + 1];
    const Id a = s < 0 ? -1 : part[s], b = t < 0 ? -1 : part[t];
    require((a >= 0) != (b >= 0) || a == b, "parts that share a triangle are one");
    if ((a >= 0) == (b >= 0)) continue;
    facets.push_back(static_cast<Id>(f));
    region.push_back(std::max(a, b));
    before.push_back(-1 - std::min(a, b));
  }
  require(
      facets == std::vector<Id>(skin.triangle.data(), skin.triangle.data() + skin.triangle.size()),
      "facets are the triangles with one chosen tetrahedron");
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const std::size_t f = static_cast<std::size_t>(facets[i]);
    const Id* c = skin.corner.data() + 3 * i;
    require(std::set<Id>(c, c + 3) == std::set<Id>(s_.triangles[f].begin(), s_.triangles[f].end()),
            "corners are those of the triangle");
    const Id s = s_.f.triangle_tetrahedra[2 * f], t = s_.f.triangle_tetrahedra[2 * f + 1];
    const Id cell = s >= 0 && inside_[static_cast<std::size_t>(s)] != 0 ? s : t;
    require(s_.g.side(c[0], c[1], c[2], cell_apex(facets[i], cell)) < 0, "facets look outwards");
    for (std::size_t k = 0; k < 3; ++k) {
      const Id other = skin.across[3 * i + k];
      const Id from = c[(k + 1) % 3], to = c[(k + 2) % 3];
      bool back = false;
      for (std::size_t m = 0; m < 3; ++m) {
        const std::size_t o = 3 * static_cast<std::size_t>(other);
        if (skin.across[o + m] != static_cast<Id>(i)) continue;
        const bool meets =
            skin.corner[o + (m + 1) % 3] == to && skin.corner[o + (m + 2) % 3] == from;
        back |= meets && skin.vertex[o + (m + 1) % 3] == skin.vertex[3 * i + (k + 2) % 3] &&
                skin.vertex[o + (m + 2) % 3] == skin.vertex[3 * i + (k + 1) % 3];
      }
      require(back, "facets meet in opposite directions, at common vertices");
      require(skin.shell[i] == skin.shell[other], "a shell is connected");
      require(skin.row[skin.vertex[3 * i + k]] == c[k], "vertices stand for corners");
    }
  }
  std::map<Row<2>, int> edge_uses;  // of vertices: an edge of the surface has two facets
  for (std::size_t i = 0; i < facets.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Id v = skin.vertex[3 * i + (k + 1) % 3], w = skin.vertex[3 * i + (k + 2) % 3];
      ++edge_uses[{std::min(v, w), std::max(v, w)}];
    }
  }
  for (const auto& [edge, uses] : edge_uses) require(uses == 2, "the surface is a manifold");
  if (facets.empty()) return;
  const auto outer =
      alphamesh::outer_shells3(skin.shell.data(), region.data(), before.data(), facets.size());
  std::map<Id, std::set<Id>> outer_of;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    if (outer[skin.shell[i]]) outer_of[region[i]].insert(skin.shell[i]);
  }
  const std::set<Id> regions(region.begin(), region.end());
  require(outer_of.size() == regions.size(), "each region has an outer shell");
}

void Solid::prove_location() {
  std::vector<Id> label;
  for (std::size_t t = 0; t < s_.tetrahedra.size(); ++t)
    label.push_back(inside_[t] != 0 ? static_cast<Id>(t % 3) : -1);
  const std::size_t m = s_.queries.size() / 3;
  alphamesh::Located3 found;
  try {
    found = alphamesh::locate3(
        {s_.cloud.coordinates.data(), s_.cloud.n, s_.f.tetrahedra.data(), s_.tetrahedra.size(),
         s_.f.triangle_tetrahedra.data(), s_.tetrahedron_triangles.data(), label.data()},
        s_.queries.data(), m, job_);
  } catch (const alphamesh::BadCoordinates&) {
    return;  // queries and points are too far apart in scale
  }
  for (std::size_t q = 0; q < m; ++q) {
    const Id query = static_cast<Id>(s_.cloud.n + q);
    Id lowest = -1;
    bool all = true, strictly = false;
    int holding = 0;
    for (std::size_t t = 0; t < s_.tetrahedra.size(); ++t) {
      Row<4> v = s_.tetrahedra[t];
      const int turn = s_.g.side(v[0], v[1], v[2], v[3]);
      int least = 1;
      for (std::size_t k = 0; k < 4; ++k) {
        Row<4> replaced = v;
        replaced[k] = query;
        least =
            std::min(least, turn * s_.g.side(replaced[0], replaced[1], replaced[2], replaced[3]));
      }
      if (least < 0) continue;
      ++holding;
      strictly |= least > 0;
      if (label[t] < 0) {
        all = false;
      } else if (lowest < 0 || label[t] < lowest) {
        lowest = label[t];
      }
    }
    require(found.label[q] == lowest, "the lowest label of the tetrahedra that hold a point");
    if (lowest < 0) {
      require(found.side[q] == -1, "outside");
    } else if (strictly) {
      require(found.side[q] == 1, "inside of a tetrahedron");
    } else if (!all) {
      require(found.side[q] == 0, "where labelled and other tetrahedra meet");
    }
  }
}

void Solid::prove_nearest() {
  if (s_.triangles.empty()) return;
  long double size = 0;
  for (double v : s_.cloud.coordinates) size = std::max<long double>(size, std::fabs(v));
  // What is much larger or smaller is scaled before it comes here.
  if (!(size > 0x1p-60L && size < 0x1p60L)) return;
  const auto tree = alphamesh::triangle_tree3(s_.cloud.coordinates.data(), s_.f.triangles.data(),
                                              s_.triangles.size(), job_);
  require(tree.boxes.size() == alphamesh::box_count(s_.triangles.size()), "boxes are counted");
  const std::size_t m = s_.queries.size() / 3;
  const auto found = alphamesh::nearest3(
      {tree.items.data(), tree.place.data(), s_.triangles.size(), tree.boxes.data()},
      s_.queries.data(), m, job_);
  const long double slack = 1e-12L * size + 1e-300L;
  for (std::size_t q = 0; q < m; ++q) {
    const auto& p = s_.g.plain(static_cast<Id>(s_.cloud.n + q));
    long double least = HUGE_VALL;
    for (const auto& [a, b, c] : s_.triangles) {
      least = std::min(least, distance(p, s_.g.plain(a), s_.g.plain(b), s_.g.plain(c)));
    }
    require(found.place[q] >= 0 && static_cast<std::size_t>(found.place[q]) < s_.triangles.size(),
            "a triangle is nearest");
    const auto [a, b, c] = s_.triangles[static_cast<std::size_t>(found.place[q])];
    require(distance(p, s_.g.plain(a), s_.g.plain(b), s_.g.plain(c)) <= least + slack,
            "the nearest triangle");
    require(std::fabs(found.distance[q] - least) <= slack, "the distance of the nearest triangle");
  }
}

}  // namespace

void prove_solid(const Tetrahedra& tetrahedra, alphamesh::Job& job) {
  Solid solid(tetrahedra, job);
  solid.prove_surface();
  solid.prove_location();
  solid.prove_nearest();
}

}  // namespace trust
