// The nearest of many segments: a tree of boxes over segments in spatial order.
#pragma once

#include <cstddef>
#include <cstdint>

#include "box_tree.hpp"
#include "predicates2.hpp"

namespace alphamesh {

struct Segment2 {
  Point2 a, b;
};

struct Box2 {
  Point2 low, high;
};

using SegmentTree2 = BoxTree<Segment2, Box2>;
using SegmentTreeView2 = BoxTreeView<Segment2, Box2>;
using Nearest2 = Nearest<Point2>;

// `edges` (k, 2) are rows of points.
SegmentTree2 segment_tree2(const double* points, const std::int32_t* edges, std::size_t k,
                           Job& job);

Nearest2 nearest2(const SegmentTreeView2& tree, const double* queries, std::size_t q, Job& job);

}  // namespace alphamesh
