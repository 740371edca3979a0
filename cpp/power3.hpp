// Exact predicates and careful values of weighted points in space.
//
// A weight is a squared radius. Point p has the power |z - p|^2 - w at z; the orthocentre of a
// simplex is where the powers of its vertices are equal and least, and its power value is that
// power (Edelsbrunner & Shah 1996). All follows from the predicates without weights once squares
// of lengths are lifted: |a|^2 - (w_a - w_o) stands for |a|^2, o the origin. Only differences of
// weights count for decisions, so that equal weights cost no accuracy.
//
// Weights lie below 2^330 and are multiples of 2^-320, on a lattice of the square of its unit.
#pragma once

#include "predicates3.hpp"

namespace alphamesh {

struct Weighted3 : Point3 {
  double weight;
};

// Whether the power of e with respect to the sphere orthogonal to a, b, c, d (positively
// oriented) is negative (+1), zero or positive.
int in_power_sphere_exact(const Weighted3& a, const Weighted3& b, const Weighted3& c,
                          const Weighted3& d, const Weighted3& e, const Lattice3& lattice);
// Sign of the barycentric coordinate of the orthocentre of a positive tetrahedron that belongs to
// its vertex `k`: negative if the facet opposite to it is attached, zero if they share it.
int orthocentre_side_exact(const Weighted3* p, int k, const Lattice3& lattice);
// The same of the triangle a, b, c, for c.
int orthocentre_side_exact(const Weighted3& a, const Weighted3& b, const Weighted3& c,
                           const Lattice3& lattice);
// The same of the edge a, b, for b: negative if a is attached.
int orthocentre_side(const Weighted3& a, const Weighted3& b, const Lattice3& lattice);

// Signed roots of power values, sign(v) sqrt(|v|), times 2^exponent. The relative error is below
// 2^-48, also where the terms cancel and where the simplex is all but flat; zero is exact.
double tetrahedron_root(const Weighted3* p, const Lattice3& lattice, int exponent);
double triangle_root(const Weighted3* p, const Lattice3& lattice, int exponent);
double edge_root(const Weighted3& a, const Weighted3& b, const Lattice3& lattice, int exponent);

}  // namespace alphamesh
