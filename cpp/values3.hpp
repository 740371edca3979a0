// Filtration values of tetrahedra, triangles and edges in space, and who is attached to whom.
#pragma once

#include <cstdint>

#include "predicates3.hpp"

namespace alphamesh {

// Vertices in an order that depends on the points alone, as the lexicographic one, so that a
// value is the same to the last bit wherever the simplex is met. Radii are 2^exponent times what
// they are in the coordinates given.
class Measure3 {
 public:
  Measure3(const Lattice3& lattice, int exponent)
      : lattice_(lattice), exponent_(exponent), unscale_(exponent) {}

  struct Solid {
    double radius;
    unsigned attached;  // bit k: vertex k lies in or on the smallest sphere through the others
  };
  struct Flat {
    double radius;
    int obtuse;  // the vertex with an obtuse angle, or 3
  };
  Solid tetrahedron(const Point3* p) const;
  Flat triangle(const Point3* p) const;
  double edge(Point3 a, Point3 b) const { return unscale_ * (0.5 * norm(a - b)); }

 private:
  double circumradius_carefully(const Point3* p) const;
  Flat triangle_carefully(const Point3* p, const double* side) const;  // squared, opposite

  const Lattice3& lattice_;
  int exponent_;
  PowerOfTwo unscale_;
};

}  // namespace alphamesh
