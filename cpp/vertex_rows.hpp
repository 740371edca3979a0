// Which points of a weighted cloud are vertices, since when, and which are hidden.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "memory.hpp"
#include "parallel.hpp"

namespace alphamesh {

// What a row of the input is. Gabriel: its point lies in its own power cell.
enum class Role : std::uint8_t { kNone, kGabriel, kAttached };

struct VertexRows {
  Buffer<std::int32_t> vertices;  // ascending
  Buffer<double> radii;
  Buffer<std::int32_t> hidden;  // ascending
};

struct EdgeView {
  const std::int32_t* rows;  // (count, 2)
  const double* radii;
  std::size_t count;
};

// Power values are shown as radii.
inline double signed_root(double power) {
  return power < 0.0 ? -std::sqrt(-power) : std::sqrt(power);
}

// `role`, `weight` and `representative` (null if all points are distinct) are for n rows of
// the input; one whose role is kNone is hidden, or a duplicate that is no lighter than its
// representative. A vertex that is attached has the least value of its edges.
VertexRows vertex_rows(const Role* role, const double* weight, const std::int32_t* representative,
                       std::size_t n, const EdgeView& edges, Job& job);

}  // namespace alphamesh
