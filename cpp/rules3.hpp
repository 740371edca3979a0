// What filtrations of plain and of weighted clouds in space have apart: values of simplices, and
// which face is attached to which coface.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "power_values3.hpp"
#include "spatial_sort.hpp"
#include "values3.hpp"
#include "vertex_rows.hpp"

namespace alphamesh {

class PlainRule3 {
 public:
  using Id = std::int32_t;
  using Tetrahedra = TetrahedronBlock;
  using Triangles = FlatBlock;
  using Code = std::uint8_t;  // of the facets of a tetrahedron, see TetrahedronBlock

  explicit PlainRule3(const SpatialOrder3& order)
      : p_(order.points.data()), unscale_(-order.exponent) {}

  void push(Tetrahedra& block, const Id* v) const {
    block.push(p_[v[0]], p_[v[1]], p_[v[2]], p_[v[3]]);
  }
  void push(Triangles& block, Id a, Id b, Id c) const { block.push(p_[a], p_[b], p_[c]); }
  static const Code* codes(const Tetrahedra& block) { return block.obtuse; }
  // Whether vertex `apex` of the facet opposite to vertex `facet` has the edge across attached.
  static bool attached(Code code, int facet, int apex) {
    return ((code >> (2 * facet)) & 3) == apex;
  }
  static void meet(Id, Id) {}
  // The value of an edge that is not attached; no radius of a triangle is less than half of its
  // longest side, also as rounded, so that the least of them need not be asked for.
  template <class Least>
  double edge(Id u, Id v, Least&&) const {
    return unscale_ * (0.5 * norm(p_[v] - p_[u]));
  }

 private:
  const Point3* p_;
  PowerOfTwo unscale_;
};

class WeightedRule3 {
 public:
  using Id = std::int32_t;
  using Tetrahedra = PowerTetrahedra;
  using Triangles = PowerTriangles3;
  using Code = std::uint16_t;  // see PowerTetrahedra

  explicit WeightedRule3(const SpatialOrder3& order)
      : p_(order.points.data()),
        weight_(order.weight.data()),
        lattice_(order.lattice),
        exponent_(order.exponent),
        role_(order.size) {}

  // What each point is, once all edges have been met.
  Role role(std::size_t v) const { return role_[v].load(std::memory_order_relaxed); }

  void push(Tetrahedra& block, const Id* v) const {
    block.push(at(v[0]), at(v[1]), at(v[2]), at(v[3]));
  }
  void push(Triangles& block, Id a, Id b, Id c) const { block.push(at(a), at(b), at(c)); }
  static const Code* codes(const Tetrahedra& block) { return block.sides; }
  static bool attached(Code code, int facet, int apex) {
    return ((code >> (4 * facet + apex)) & 1) != 0;
  }
  // An edge has vertices; its orthocentre may lie beyond one of them.
  void meet(Id u, Id v) {
    set_role(u, orthocentre_side(at(u), at(v), lattice_) < 0);
    set_role(v, orthocentre_side(at(v), at(u), lattice_) < 0);
  }
  template <class Least>
  double edge(Id u, Id v, Least&& least) const {
    return std::min(power_radius(at(u), at(v), lattice_, exponent_), least());
  }

 private:
  Weighted3 at(Id v) const { return {p_[v], weight_[v]}; }
  void set_role(Id v, bool attached) {
    std::atomic<Role>& role = role_[static_cast<std::size_t>(v)];
    if (attached) {
      role.store(Role::kAttached, std::memory_order_relaxed);
    } else if (role.load(std::memory_order_relaxed) == Role::kNone) {
      Role none = Role::kNone;
      role.compare_exchange_strong(none, Role::kGabriel, std::memory_order_relaxed);
    }
  }

  const Point3* p_;
  const double* weight_;
  Lattice3 lattice_;
  int exponent_;
  std::vector<std::atomic<Role>> role_;
};

}  // namespace alphamesh
