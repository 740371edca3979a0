// Proof, on the machine at hand, that arithmetic is what the exact code needs.
#pragma once

#include <string>

namespace alphamesh {

// Empty if all is well, else what is wrong.
std::string self_test();

}  // namespace alphamesh
