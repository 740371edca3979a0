// The kernels that take a finished triangulation of space: surfaces and queries.
#pragma once

#include <vector>

#include "output3.hpp"
#include "proof.hpp"

namespace trust {

// A filtration that has been proved, with what follows from it.
struct Tetrahedra {
  const Cloud& cloud;
  const std::vector<double>& queries;
  const alphamesh::Filtration3& f;
  const std::vector<Row<4>>& tetrahedra;
  const std::vector<Row<3>>& triangles;
  const alphamesh::Buffer<Id>& tetrahedron_triangles;
  const Geometry& g;
};

// The vertex of a tetrahedron that one of its triangles lacks.
inline Id apex_of(const Row<4>& tetrahedron, const Row<3>& triangle) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (tetrahedron[k] != triangle[k]) return tetrahedron[k];
  }
  return tetrahedron[3];
}

void prove_solid(const Tetrahedra& tetrahedra, alphamesh::Job& job);

}  // namespace trust
