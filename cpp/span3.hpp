// How many dimensions a cloud in space has.
#pragma once

#include <cstdint>
#include <vector>

#include "parallel.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {

// The first points that span as much as all do, one more than the dimension of the cloud;
// positively oriented if they are four.
std::vector<std::int32_t> spanning_points(const SpatialOrder3& order, const Job& job);

}  // namespace alphamesh
