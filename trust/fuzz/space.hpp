// All kernels of space on one cloud, their results proved; aborts if one is wrong.
#pragma once

#include <vector>

#include "decode.hpp"

namespace trust {

// Throws BadCoordinates as the core does. `queries` are places to look up.
void prove_space(const Cloud& cloud, const std::vector<double>& queries);

}  // namespace trust
