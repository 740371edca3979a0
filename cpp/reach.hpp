// How far the spheres of cells reach: what lies beyond cannot change these cells.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "parallel.hpp"
#include "sites.hpp"

namespace alphamesh {

struct Reach {
  double lo[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};  // a box around all spheres, rounded outwards
  double hi[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  bool open = false;  // the hull is met, or a sphere could not be told: it may reach anywhere

  // Each sphere is that of the places where a site of weight `heaviest` would be in
  // conflict with the cell, `count` of D + 1 sites.
  template <int D>
  void add(const Sites& sites, const std::int32_t* cells, std::size_t count, double heaviest,
           const Job& job);
};

}  // namespace alphamesh
