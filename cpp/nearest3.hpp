// The nearest of many triangles: a tree of boxes over triangles in spatial order.
#pragma once

#include <cstddef>
#include <cstdint>

#include "box_tree.hpp"
#include "predicates3.hpp"

namespace alphamesh {

struct Triangle3 {
  Point3 a, b, c;
};

struct Box3 {
  Point3 low, high;
};

using TriangleTree3 = BoxTree<Triangle3, Box3>;
using TriangleTreeView3 = BoxTreeView<Triangle3, Box3>;
using Nearest3 = Nearest<Point3>;

// `corners` (k, 3) are rows of points.
TriangleTree3 triangle_tree3(const double* points, const std::int32_t* corners, std::size_t k,
                             Job& job);

Nearest3 nearest3(const TriangleTreeView3& tree, const double* queries, std::size_t q, Job& job);

}  // namespace alphamesh
