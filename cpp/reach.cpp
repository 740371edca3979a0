#include "reach.hpp"

#include <algorithm>
#include <type_traits>

#include "big.hpp"
#include "centre3.hpp"
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

double value(Dd v) { return v.h; }
double value(const Big& v) { return v.estimate(); }

template <class R>
R arrow(const Sites& sites, std::int32_t from, std::int32_t to, int axis) {
  if constexpr (std::is_same_v<R, Big>) return sites.exact_difference(to, from, axis);
  if constexpr (std::is_same_v<R, Dd>) return sites.difference(to, from, axis);
}

// The same of four sites in space, by their volume instead of its square: slivers of nearly
// cospherical points, which crystals are full of, are thinner than doubles tell. Parts of
// double-double are off by less than 2^-95 of the magnitudes, so that the centre is by less
// than 2^-24 `size` unless the cell is flatter than `flat`; `flat` 0 is for exact numbers.
template <class R>
bool ball_of_sliver(const Sites& sites, const std::int32_t* v, double heaviest, double flat,
                    Ball* out) {
  constexpr double kMargin = 0x1p-20;
  Vector3<R> arm[3];
  R square[3], parts[3];
  double size = 0.0, lengths = 1.0;
  for (int j = 0; j < 3; ++j) {
    for (int k = 0; k < 3; ++k) parts[k] = arrow<R>(sites, v[0], v[j + 1], k);
    arm[j] = {parts[0], parts[1], parts[2]};
    const Dd change = two_diff(sites.weight(v[0]), sites.weight(v[j + 1]));
    const R own = dot(arm[j], arm[j]);
    square[j] = own + R(change);
    const double length = std::sqrt(value(own));
    size += length + std::fabs(change.h) / length;
    lengths *= length;
  }
  const Circumcentre<R> sphere(arm[0], arm[1], arm[2], square[0], square[1], square[2]);
  const double twice = 2.0 * value(sphere.volume);
  if (!(std::fabs(twice) > flat * lengths)) return false;
  const Vector3<R>& n = sphere.numerator;
  const double c[3] = {value(n.x) / twice, value(n.y) / twice, value(n.z) / twice};
  std::copy(c, c + 3, out->centre);
  const double square_sum = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
  const double power = square_sum - sites.weight(v[0]) + heaviest;
  out->radius =
      (1.0 + kMargin) * std::sqrt(std::max(0.0, power)) + kMargin * (size + std::sqrt(square_sum));
  return std::isfinite(out->radius);
}

template <int D>
bool certain_ball(const Sites& sites, const std::int32_t* v, double heaviest, Ball* out) {
  if (ball_of<D, double>(sites, v, heaviest, 0x1p-20, out)) return true;
  if constexpr (D == 3) {
    return ball_of_sliver<Dd>(sites, v, heaviest, 0x1p-68, out) ||
           ball_of_sliver<Big>(sites, v, heaviest, 0.0, out);
  } else {
    return ball_of<D, Dd>(sites, v, heaviest, 0x1p-60, out);
  }
}

}  // namespace

template <int D>
void Reach::add(const Sites& sites, const std::int32_t* cells, std::size_t count, double heaviest,
                const Job& job) {
  for (std::size_t i = 0; i < count; ++i) {
    if ((i & 0xfff) == 0) job.poll();
    const std::int32_t* v = cells + (D + 1) * i;
    Ball ball;
    if (!certain_ball<D>(sites, v, heaviest, &ball)) {
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
