// What unions of discs and of balls have in common: a complex with places for its vertices,
// which of its simplices the alpha complex has at one radius, and what is measured.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "memory.hpp"

namespace alphamesh {

// Balls of squared radii weights + power, no ball where that is negative. Their centres are
// the first `balls` places; in a periodic box, others are those of their copies.
struct Centres {
  const double* high;       // (places, d): coordinates
  const double* low;        // (places, d), to be added to these; or null
  const double* weights;    // (balls), or null
  const std::int32_t* row;  // (places): the ball of each, or null: all are centres
  std::size_t balls;
  double power;
};

struct Simplices {
  const std::int32_t* corner;  // (count, k + 1) places; copies in the order of the originals
  const std::int32_t* side;    // (count, k + 1): numbers of the faces opposite to corners
  const bool* has;             // (count)
  std::size_t count;
};

struct UnionView {
  Centres centres;
  const bool* has_vertex;  // (balls)
  Simplices edges, triangles, tetrahedra;
  const std::int32_t* cofaces;  // (facets, 2): the cells of each, -1 for none
  const std::int32_t* hole;     // (cells): number of the hole that each lies in, -1 for none
  std::size_t holes;

  // Sides of a facet without a cell of the complex, which `cells` are.
  int open_sides(std::size_t facet, const Simplices& cells) const {
    int open = 2;
    for (std::size_t k = 0; k < 2; ++k) {
      const std::int32_t c = cofaces[2 * facet + k];
      if (c >= 0 && cells.has[c]) --open;
    }
    return open;
  }
};

// Areas and perimeters in the plane, volumes and surface areas in space.
struct UnionMeasures {
  double content = 0.0;
  Buffer<double> contents, borders;            // (balls): in the power cell; of the boundary
  Buffer<double> hole_contents, hole_borders;  // (holes)

  UnionMeasures() = default;
  UnionMeasures(std::size_t balls, std::size_t holes)
      : contents(balls), borders(balls), hole_contents(holes), hole_borders(holes) {
    for (Buffer<double>* b : {&contents, &borders, &hole_contents, &hole_borders}) {
      std::fill(b->begin(), b->end(), 0.0);
    }
  }
  // What rounding left of nothing is not less than that.
  void trim_holes() {
    for (double& content : hole_contents) content = std::max(0.0, content);
    for (double& border : hole_borders) border = std::max(0.0, border);
  }
};

// By place.
class Balls {
 public:
  explicit Balls(const Centres& centres)
      : centres_(centres), square_(centres.balls), radius_(centres.balls) {
    for (std::size_t i = 0; i < centres.balls; ++i) {
      const double w = centres.weights != nullptr ? centres.weights[i] : 0.0;
      square_[i] = std::max(0.0, w + centres.power);
      radius_[i] = std::sqrt(square_[i]);
    }
  }

  std::size_t row(std::int32_t v) const {
    return static_cast<std::size_t>(centres_.row != nullptr ? centres_.row[v] : v);
  }
  bool weighted() const { return centres_.weights != nullptr; }
  double weight(std::int32_t v) const { return weighted() ? centres_.weights[row(v)] : 0.0; }
  double square(std::int32_t v) const { return square_[row(v)]; }
  double radius(std::int32_t v) const { return radius_[row(v)]; }

 protected:
  Centres centres_;

 private:
  Buffer<double> square_, radius_;
};

}  // namespace alphamesh
