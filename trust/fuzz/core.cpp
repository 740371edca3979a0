// What libFuzzer calls: bytes become a cloud, all kernels run on it, and their results are
// proved in whole numbers. Whatever is not the refusal of bad coordinates is a finding.
#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdint>

#include "box.hpp"
#include "exact.hpp"
#include "plane.hpp"
#include "space.hpp"
#include "spatial_sort.hpp"

namespace trust {
namespace {

// The points, places between two of them, and one beyond.
std::vector<double> queries_of(const Cloud& cloud) {
  std::vector<double> out;
  const std::size_t d = cloud.dimension;
  for (std::size_t i = 0; i < cloud.n; ++i) {
    out.insert(out.end(), cloud.row(i), cloud.row(i) + d);
    for (std::size_t k = 0; k < d && i != 0; ++k) {
      out.push_back(0.5 * cloud.row(i)[k] + 0.5 * cloud.row(i - 1)[k]);
    }
  }
  for (std::size_t k = 0; k < d && cloud.n != 0; ++k) {
    out.push_back(2.0 * cloud.row(0)[k] - cloud.row(cloud.n - 1)[k]);
  }
  for (double& v : out) v = std::isfinite(v) ? v : 0.0;
  return out;
}

// Whether a cloud is refused is decided by its scales alone, as the documents say.
bool allowed(const Cloud& cloud) {
  const bool weighted = !cloud.weights.empty();
  int low = INT_MAX, high = INT_MIN;  // binary digits of any number
  for (double v : cloud.coordinates) {
    if (!std::isfinite(v)) return false;
    if (v == 0.0) continue;
    low = std::min(low, lowest_bit(v));
    high = std::max(high, std::ilogb(v) + 1);
  }
  for (double w : cloud.weights) {  // by their roots
    if (!std::isfinite(w)) return false;
    if (w == 0.0) continue;
    low = std::min(low, static_cast<int>(std::floor(0.5 * lowest_bit(w))));
    high = std::max(high, static_cast<int>(std::ceil(0.5 * (std::ilogb(w) + 1))));
  }
  return low == INT_MAX || high - low <= (cloud.dimension == 2 && !weighted ? 490 : 325);
}

void run(const Cloud& cloud) {
  if (cloud.periodic) {
    prove_box(cloud);
    return;
  }
  bool refused = false;
  try {
    const std::vector<double> queries = queries_of(cloud);
    if (cloud.dimension == 2) {
      prove_plane(cloud, queries);
    } else {
      prove_space(cloud, queries);
    }
  } catch (const alphamesh::BadCoordinates&) {
    refused = true;
  }
  require(refused || allowed(cloud), "a cloud beyond the range is refused");
  require(!refused || !allowed(cloud), "a cloud within the range is not refused");
}

}  // namespace
}  // namespace trust

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  trust::run(trust::Decoder(data, size).decode());
  return 0;
}
