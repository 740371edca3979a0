#include "reach.hpp"

#include <algorithm>

#include "orthosphere.hpp"

namespace alphamesh {

namespace {

double head(double v) { return v; }
double head(Dd v) { return v.h; }

double take(Dd v, double) { return v.h + v.l; }
Dd take(Dd v, Dd) { return v; }

struct Ball {
  double centre[3];  // from the first vertex
  double radius;
};

// False if the cell is too flat for this arithmetic. Barycentric parts are sums of products
// of size most^(D - 1) highest at worst. In doubles they are off by less than 2^-45 of that,
// in double-double by less than 2^-95; divided by a determinant that is not below `flat`
// most^D, with `flat` 2^-20 or 2^-60, by less than 2^-25 highest / most, each times an arm.
template <int D, class R>
bool ball_of(const Sites& sites, const std::int32_t* v, double heaviest, double flat, Ball* out) {
  constexpr double kMargin = 0x1p-20;
  R arm[D][3], change[D];
  double most = 0.0, highest = 0.0;
  for (int j = 0; j < D; ++j) {
    for (int k = 0; k < 3; ++k) arm[j][k] = take(sites.difference(v[j + 1], v[0], k), R());
    change[j] = take(two_diff(sites.weight(v[0]), sites.weight(v[j + 1])), R());
  }
  const Orthosphere<D, R> sphere(arm, change);
  for (int j = 0; j < D; ++j) {
    most = std::max(most, head(sphere.gram[j][j]));
    highest = std::max(highest, head(sphere.gram[j][j]) + std::fabs(head(change[j])));
  }
  const double determinant = head(sphere.determinant);
  double least = flat;
  for (int j = 0; j < D; ++j) least *= most;
  if (!(determinant > least)) return false;
  double size = highest / std::sqrt(most);
  std::fill(out->centre, out->centre + 3, 0.0);
  for (int j = 0; j < D; ++j) {
    const double share = 0.5 * (head(sphere.part[j + 1]) / determinant);
    for (int k = 0; k < 3; ++k) out->centre[k] += share * head(arm[j][k]);
    size += std::fabs(share) * std::sqrt(head(sphere.gram[j][j]));
  }
  const double* c = out->centre;
  const double power = c[0] * c[0] + c[1] * c[1] + c[2] * c[2] - sites.weight(v[0]) + heaviest;
  out->radius = (1.0 + kMargin) * std::sqrt(std::max(0.0, power)) + kMargin * size;
  return true;
}

}  // namespace

template <int D>
void Reach::add(const Sites& sites, const std::int32_t* cells, std::size_t count, double heaviest,
                const Job& job) {
  for (std::size_t i = 0; i < count; ++i) {
    if ((i & 0xfff) == 0) job.poll();
    const std::int32_t* v = cells + (D + 1) * i;
    Ball ball;
    if (!ball_of<D, double>(sites, v, heaviest, 0x1p-20, &ball) &&
        !ball_of<D, Dd>(sites, v, heaviest, 0x1p-60, &ball)) {
      open = true;
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      const double at = coordinate(sites.high(v[0]), k), around = 0x1p-50 * std::fabs(at);
      lo[k] = std::min(lo[k], at + (ball.centre[k] - ball.radius) - around);
      hi[k] = std::max(hi[k], at + (ball.centre[k] + ball.radius) + around);
    }
  }
}

template void Reach::add<1>(const Sites&, const std::int32_t*, std::size_t, double, const Job&);
template void Reach::add<2>(const Sites&, const std::int32_t*, std::size_t, double, const Job&);
template void Reach::add<3>(const Sites&, const std::int32_t*, std::size_t, double, const Job&);

}  // namespace alphamesh
