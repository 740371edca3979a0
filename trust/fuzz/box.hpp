// All kernels of periodic boxes on one cloud, their results proved; aborts if one is wrong.
#pragma once

#include "decode.hpp"

namespace trust {

// Does nothing with clouds beyond the range of boxes, which are refused before the kernels.
void prove_box(const Cloud& cloud);

}  // namespace trust
