// The nearest of many segments: a tree of boxes over segments in spatial order.
#pragma once

#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"
#include "predicates2.hpp"

namespace alphamesh {

struct Segment2 {
  Point2 a, b;
};

struct Box2 {
  Point2 low, high;
};

// Eight segments share a box, eight boxes the next one, up to a single one, the last.
struct SegmentTree2 {
  Buffer<Segment2> segments;   // in the order of a space-filling curve
  Buffer<std::int32_t> place;  // where each of them stood in the input
  Buffer<Box2> boxes;          // level after level
};

// `edges` (k, 2) are rows of points.
SegmentTree2 segment_tree2(const double* points, const std::int32_t* edges, std::size_t k,
                           Job& job);

// A tree as it comes back from the caller.
struct SegmentTreeView2 {
  const Segment2* segments;
  const std::int32_t* place;
  std::size_t size;  // more than zero
  const Box2* boxes;
};

struct Nearest2 {
  Buffer<std::int32_t> place;  // (q,) the first of the nearest segments, in input order
  Buffer<Point2> point;        // (q,) the nearest point on it
  Buffer<double> distance;     // (q,) zero exactly on the segment
};

// The number of boxes of a tree over k segments.
std::size_t box_count2(std::size_t k);

Nearest2 nearest2(const SegmentTreeView2& tree, const double* queries, std::size_t q, Job& job);

}  // namespace alphamesh
