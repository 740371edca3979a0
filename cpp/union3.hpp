// Volume and surface area of a union of balls, ball by ball and void by void.
#pragma once

#include "parallel.hpp"
#include "balls.hpp"

namespace alphamesh {

UnionMeasures union3(const UnionView& view, Job& job);

}  // namespace alphamesh
