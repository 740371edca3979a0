// The nearest of many triangles: a tree of boxes over triangles in spatial order.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"
#include "predicates3.hpp"

namespace alphamesh {

struct Triangle3 {
  Point3 a, b, c;
};

struct Box3 {
  Point3 low, high;
};

// Eight triangles share a box, eight boxes the next one, up to a single one, the last.
struct TriangleTree3 {
  Buffer<Triangle3> triangles;  // in the order of a space-filling curve
  Buffer<std::int32_t> place;   // where each of them stood in the input
  Buffer<Box3> boxes;           // level after level
};

// `corners` (k, 3) are rows of points.
TriangleTree3 triangle_tree3(const double* points, const std::int32_t* corners, std::size_t k,
                             Job& job);

// A tree as it comes back from the caller.
struct TriangleTreeView3 {
  const Triangle3* triangles;
  const std::int32_t* place;
  std::size_t size;  // more than zero
  const Box3* boxes;
};

struct Nearest3 {
  Buffer<std::int32_t> place;  // (q,) the first of the nearest triangles, in input order
  Buffer<Point3> point;        // (q,) the nearest point on it
  Buffer<double> distance;     // (q,)
};

// The number of boxes of a tree over k triangles.
std::size_t box_count3(std::size_t k);

Nearest3 nearest3(const TriangleTreeView3& tree, const double* queries, std::size_t q, Job& job);

}  // namespace alphamesh
