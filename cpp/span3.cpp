#include "span3.hpp"

#include <utility>

namespace alphamesh {
namespace {

using Id = std::int32_t;

bool collinear(Point3 a, Point3 b, Point3 c) {
  const Lattice none;
  return orient({a.x, a.y}, {b.x, b.y}, {c.x, c.y}, none) == 0 &&
         orient({a.y, a.z}, {b.y, b.z}, {c.y, c.z}, none) == 0 &&
         orient({a.z, a.x}, {b.z, b.x}, {c.z, c.x}, none) == 0;
}

}  // namespace

std::vector<Id> spanning_points(const SpatialOrder3& order, const Job& job) {
  const auto n = static_cast<Id>(order.size);
  const Point3* p = order.points.data();
  std::vector<Id> found;
  for (Id i = 0; i < n && found.size() < 4; ++i) {
    if ((i & 0xfff) == 0) job.poll();
    if (found.size() == 2 && collinear(p[found[0]], p[found[1]], p[i])) continue;
    if (found.size() == 3) {
      const int side = orient3(p[found[0]], p[found[1]], p[found[2]], p[i], order.lattice);
      if (side == 0) continue;
      if (side < 0) std::swap(found[0], found[1]);
    }
    found.push_back(i);
  }
  return found;
}

}  // namespace alphamesh
