// Unions of discs and of balls, measured by the core and held against their bounds.
#pragma once

#include <vector>

#include "output3.hpp"
#include "proof.hpp"

namespace trust {

// The simplices of a filtration in the plane or in space, with the value of each row: infinite
// where it is no vertex.
struct Filtered {
  const Cloud& cloud;
  const std::vector<double>& births;
  const alphamesh::Filtration2* plane;
  const alphamesh::Filtration3* space;
};

struct Measured {
  double total = 0.0;  // area, or volume
  std::vector<double> parts, borders, holes;
};

// The union at a radius. `cloud` is in range, see in_range().
Measured union_of(const Filtered& filtered, double radius, alphamesh::Job& job);

// Clouds are scaled for unions if they are much larger or smaller.
bool in_range(const Cloud& cloud, double radius);

void prove_union(const Cloud& cloud, double radius, const Measured& measured);
// The same points in reverse order.
void prove_same_union(const Measured& one, const Measured& reversed);

}  // namespace trust
