#include "reach.hpp"

#include <algorithm>

#include "orthosphere.hpp"

namespace alphamesh {

// Barycentric parts are sums of products of size most^(D - 1) highest at worst, with errors
// below 2^-95 of that; divided by a determinant above 2^-60 most^D they are off by less than
// 2^-35 highest / most, each times an arm.
template <int D>
void Reach::add(const Sites& sites, const std::int32_t* cells, std::size_t count, double heaviest,
                const Job& job) {
  constexpr double kMargin = 0x1p-30;
  for (std::size_t i = 0; i < count; ++i) {
    if ((i & 0xfff) == 0) job.poll();
    const std::int32_t* v = cells + (D + 1) * i;
    Dd arm[D][3], change[D];
    double most = 0.0, highest = 0.0;
    for (int j = 0; j < D; ++j) {
      for (int k = 0; k < 3; ++k) arm[j][k] = sites.difference(v[j + 1], v[0], k);
      change[j] = two_diff(sites.weight(v[0]), sites.weight(v[j + 1]));
    }
    const Orthosphere<D, Dd> sphere(arm, change);
    for (int j = 0; j < D; ++j) {
      most = std::max(most, sphere.gram[j][j].h);
      highest = std::max(highest, sphere.gram[j][j].h + std::fabs(change[j].h));
    }
    const double determinant = sphere.determinant.h;
    if (!(determinant > 0x1p-60 * std::pow(most, D))) {
      open = true;
      continue;
    }
    double centre[3] = {0.0, 0.0, 0.0}, size = highest / std::sqrt(most);
    for (int j = 0; j < D; ++j) {
      const double share = 0.5 * (sphere.part[j + 1].h / determinant);
      for (int k = 0; k < 3; ++k) centre[k] += share * arm[j][k].h;
      size += std::fabs(share) * std::sqrt(sphere.gram[j][j].h);
    }
    const double square =
        centre[0] * centre[0] + centre[1] * centre[1] + centre[2] * centre[2];
    const double power = square - sites.weight(v[0]) + heaviest;
    const double radius = std::sqrt(std::max(0.0, power)) + kMargin * size;
    for (int k = 0; k < 3; ++k) {
      const double at = coordinate(sites.high(v[0]), k) + centre[k];
      const double around = (1.0 + kMargin) * radius + kMargin * std::fabs(at);
      lo[k] = std::min(lo[k], at - around);
      hi[k] = std::max(hi[k], at + around);
    }
  }
}

template void Reach::add<1>(const Sites&, const std::int32_t*, std::size_t, double, const Job&);
template void Reach::add<2>(const Sites&, const std::int32_t*, std::size_t, double, const Job&);
template void Reach::add<3>(const Sites&, const std::int32_t*, std::size_t, double, const Job&);

}  // namespace alphamesh
