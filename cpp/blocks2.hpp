// Values of triangles and edges, with weights and without, behind one face.
#pragma once

#include <cstddef>
#include <cstdint>

#include "power2.hpp"
#include "power_values2.hpp"
#include "sheet.hpp"
#include "spatial_sort.hpp"
#include "values2.hpp"

namespace alphamesh {

// What evaluates triangles and edges, and how triangles tell that edge k is attached: without
// weights, it is the one opposite to the obtuse angle.
template <class S>
struct Blocks;

struct PlainBlocks {
  static constexpr std::int32_t kNone = TriangleBlock::kNoEdge;
  static bool attached(std::int32_t code, std::int32_t k) { return code == k; }
  template <class Triangles>
  static std::int32_t code(const Triangles& block, std::size_t i) {
    return block.obtuse[i];
  }
  template <class Edges>
  static double radius(const Edges& block, std::size_t i) {
    return block.half_length[i];
  }
  template <class Edges>
  static void measure(Edges& block, std::size_t count, const Lattice&) {
    block.measure(count);
  }
};

template <>
struct Blocks<Plane> : PlainBlocks {
  using Triangles = TriangleBlock;
  using Edges = EdgeBlock;
};

template <>
struct Blocks<Sheet> : PlainBlocks {
  using Triangles = SheetTriangles;
  using Edges = SheetEdges;
};

template <class P>
struct PowerBlocks {
  using Triangles = PowerTriangles<P>;
  using Edges = PowerEdges<P>;
  static constexpr std::int32_t kNone = 0;
  static bool attached(std::int32_t code, std::int32_t k) { return ((code >> k) & 1) != 0; }
  static std::int32_t code(const Triangles& block, std::size_t i) { return block.attached[i]; }
  static double radius(const Edges& block, std::size_t i) { return block.radius[i]; }
  static void measure(Edges& block, std::size_t count, const Lattice& lattice) {
    block.measure(count, lattice);
  }
};

template <>
struct Blocks<WeightedPlane> : PowerBlocks<Point2> {};

template <>
struct Blocks<WeightedSheet> : PowerBlocks<SheetPoint> {};

}  // namespace alphamesh
