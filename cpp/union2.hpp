// Area and perimeter of a union of discs, disc by disc and hole by hole.
#pragma once

#include "parallel.hpp"
#include "balls.hpp"

namespace alphamesh {

UnionMeasures union2(const UnionView& view, Job& job);

}  // namespace alphamesh
