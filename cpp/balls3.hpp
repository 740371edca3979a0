// The pieces of a union of balls: of two, of three, and what a tetrahedron's corners have of it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "predicates3.hpp"
#include "balls.hpp"

namespace alphamesh {

// Two balls: the distances of their radical plane from the two centres, and the radius of
// the circle in which the spheres meet.
struct Lens {
  double length, from[2], circle;
};

// Three balls: half angles of the arcs that each cuts from the circle of the other two,
// angles at which the other two cross on its sphere, and how much of the triangle belongs
// to it; the height above the triangle at which the spheres meet, and the triangle's area.
struct Flap {
  Lens lens[3];
  double half[3], turn[3], share[3], height, area;
};

class Balls3 : public Balls {
 public:
  using Balls::Balls;

  Place3 place(std::int32_t v) const {
    const double* h = centres_.high + 3 * static_cast<std::size_t>(v);
    if (centres_.low == nullptr) return {{h[0], h[1], h[2]}, {0.0, 0.0, 0.0}};
    const double* l = centres_.low + 3 * static_cast<std::size_t>(v);
    return {{h[0], h[1], h[2]}, {l[0], l[1], l[2]}};
  }

  Lens lens(std::int32_t i, std::int32_t j) const;
  Flap flap(const std::int32_t* corner) const;
  // Normals point inwards and are twice as long as their faces are large; `det` is six times
  // the volume. Adds to share[0] ... share[3].
  void share_cell(const std::int32_t* corner, const Vector3<double>* normal, double det,
                  double* share) const;
};

// The corners of a face of a tetrahedron, by the corner across; those of an edge of a triangle.
constexpr int kFaceOf[4][3] = {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}};
constexpr int kEndsOf[3][2] = {{1, 2}, {0, 2}, {0, 1}};
// Below this share of their greatest possible value, normals and volumes are computed again
// with twice the digits.
constexpr double kThin = 1.0 / 128.0;

}  // namespace alphamesh
