#include "sites.hpp"

#include <algorithm>
#include <cstddef>

#include "big.hpp"

namespace alphamesh {
namespace {

using Id = Sites::Id;

template <class R>
R determinant2(const R* a, const R* b) {
  return a[0] * b[1] - a[1] * b[0];
}

template <class R>
R determinant3(const R* a, const R* b, const R* c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// Of D rows of D numbers.
template <int D, class R>
R determinant(const R (*row)[3]) {
  if constexpr (D == 1) return row[0][0];
  if constexpr (D == 2) return determinant2(row[0], row[1]);
  if constexpr (D == 3) return determinant3(row[0], row[1], row[2]);
}

// Positive if q lies within: rows are the vertices as seen from q, `lift` their squared
// distances less weights.
template <int D, class R>
R lifted_determinant(const R (*row)[3], const R* lift) {
  if constexpr (D == 1) {
    return lift[0] * row[1][0] - lift[1] * row[0][0];
  } else if constexpr (D == 2) {
    return lift[0] * determinant2(row[1], row[2]) + lift[1] * determinant2(row[2], row[0]) +
           lift[2] * determinant2(row[0], row[1]);
  } else {
    const R even = lift[1] * determinant3(row[0], row[2], row[3]) +
                   lift[3] * determinant3(row[0], row[1], row[2]);
    const R odd = lift[0] * determinant3(row[1], row[2], row[3]) +
                  lift[2] * determinant3(row[0], row[1], row[3]);
    return odd - even;
  }
}

// What the terms of a determinant may add up to, and how much more if every number in a
// column is off by `slack`.
struct Magnitude {
  double terms, spread;
};

template <int D>
Magnitude magnitude_of(const double* most, double slack) {
  double m[3];
  for (int k = 0; k < D; ++k) m[k] = most[k] + slack;
  if constexpr (D == 1) return {m[0], slack};
  if constexpr (D == 2) return {2.0 * m[0] * m[1], 2.0 * slack * (m[0] + m[1])};
  if constexpr (D == 3)
    return {6.0 * m[0] * m[1] * m[2], 6.0 * slack * (m[0] * m[1] + m[1] * m[2] + m[2] * m[0])};
}

double power_of(double unit, int exponent) {
  double p = 1.0;
  for (int k = 0; k < exponent; ++k) p *= unit;
  return p;
}

int sign_of(Dd v) { return alphamesh::sign_of(v.h); }

}  // namespace

void Sites::set(Id i, const Dd* position, double weight) {
  const auto at = static_cast<std::size_t>(i);
  high_[at] = {position[0].h, position[1].h, position[2].h};
  low_[at] = {position[0].l, position[1].l, position[2].l};
  weight_[at] = weight;
  for (int k = 0; k < 3; ++k) most_low_ = std::max(most_low_, std::fabs(position[k].l));
}

Dd Sites::difference(Id a, Id b, int axis) const {
  const Dd upper = two_diff(coordinate(high(a), axis), coordinate(high(b), axis));
  if (most_low_ == 0.0) return upper;
  const Point3 &p = low_[static_cast<std::size_t>(a)], &q = low_[static_cast<std::size_t>(b)];
  return upper + two_diff(coordinate(p, axis), coordinate(q, axis));
}

Big Sites::exact_difference(Id a, Id b, int axis) const {
  const Point3 &p = low_[static_cast<std::size_t>(a)], &q = low_[static_cast<std::size_t>(b)];
  return Big(two_diff(coordinate(high(a), axis), coordinate(high(b), axis))) +
         Big(two_diff(coordinate(p, axis), coordinate(q, axis)));
}

bool Sites::less(Id a, Id b) const {
  for (int k = 0; k < 3; ++k) {
    const int s = sign_of(difference(a, b, k));
    if (s != 0) return s < 0;
  }
  return false;
}

template <int D>
int Sites::orient(const Id* v, const int* axes) const {
  double row[D][3], most[3] = {0.0, 0.0, 0.0};
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) {
      const int axis = D == 3 ? k : axes[k];
      row[i][k] = coordinate(high(v[i + 1]), axis) - coordinate(high(v[0]), axis);
      most[k] = std::max(most[k], std::fabs(row[i][k]));
    }
  }
  const double value = determinant<D, double>(row);
  const Magnitude size = magnitude_of<D>(most, 2.0 * most_low_);
  if (std::fabs(value) > 16.0 * kEps * size.terms + 2.0 * size.spread) {
    return alphamesh::sign_of(value);
  }
  if (most_low_ == 0.0 && size.terms < 0x1p53 * power_of(unit_, D)) {
    return alphamesh::sign_of(value);
  }
  Dd fine[D][3];
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) fine[i][k] = difference(v[i + 1], v[0], axes[k]);
  }
  const double better = determinant<D, Dd>(fine).h, bound = 0x1p-95 * size.terms;
  if (std::fabs(better) > bound) return alphamesh::sign_of(better);
  if (std::fabs(better) + bound < power_of(unit_, D)) return 0;
  Big exact[D][3];
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) exact[i][k] = exact_difference(v[i + 1], v[0], axes[k]);
  }
  return determinant<D, Big>(exact).sign();
}

template <int D>
bool Sites::conflict(const Id* v, Id q, const int* axes) const {
  double row[D + 1][3], lift[D + 1], most[3] = {0.0, 0.0, 0.0}, highest = 0.0;
  const Point3 at = high(q);
  for (int i = 0; i <= D; ++i) {
    const Vector3<double> d = high(v[i]) - at;
    const double component[3] = {d.x, d.y, d.z};
    for (int k = 0; k < D; ++k) {
      row[i][k] = component[D == 3 ? k : axes[k]];
      most[k] = std::max(most[k], std::fabs(row[i][k]));
    }
    const double square = dot(d, d), change = weight(q) - weight(v[i]);
    lift[i] = square + change;
    highest = std::max(highest, square + std::fabs(weight(q)) + std::fabs(weight(v[i])));
  }
  // Lifts of up to three squares and two weights, each off by a few roundings, and by
  // slack (2 (x + y + z) + 3 slack) at most: (x + y + z)^2 <= 3 highest.
  const double slack = 2.0 * most_low_;
  const double length = D == 3 ? most[0] + most[1] + most[2] : std::sqrt(3.0 * highest);
  const double uncertain = slack * (2.0 * length + 3.0 * slack);
  const Magnitude size = magnitude_of<D>(most, slack);
  const double terms = (D + 1) * size.terms * (highest + uncertain);
  const double bound =
      32.0 * kEps * terms +
      2.0 * (D + 1) * (size.spread * (highest + uncertain) + size.terms * uncertain);
  const double value = lifted_determinant<D, double>(row, lift);
  if (std::fabs(value) > bound) return value > 0.0;
  int s = 0;
  if (most_low_ == 0.0 && terms < 0x1p53 * power_of(unit_, D + 2)) {
    s = alphamesh::sign_of(value);
  } else {
    s = conflict_carefully<D>(v, q, axes);
  }
  return s != 0 ? s > 0 : conflict_perturbed<D>(v, q, axes);
}

template <int D>
int Sites::conflict_carefully(const Id* v, Id q, const int* axes) const {
  Dd row[D + 1][3], lift[D + 1];
  double most[3] = {0.0, 0.0, 0.0}, highest = 0.0;
  for (int i = 0; i <= D; ++i) {
    const Dd d[3] = {difference(v[i], q, 0), difference(v[i], q, 1), difference(v[i], q, 2)};
    for (int k = 0; k < D; ++k) {
      row[i][k] = d[axes[k]];
      most[k] = std::max(most[k], std::fabs(row[i][k].h));
    }
    const Dd square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    lift[i] = square + two_diff(weight(q), weight(v[i]));
    highest = std::max(highest, square.h + std::fabs(weight(q)) + std::fabs(weight(v[i])));
  }
  const double value = lifted_determinant<D, Dd>(row, lift).h;
  const double bound = 0x1p-92 * (D + 1) * magnitude_of<D>(most, 0.0).terms * highest;
  if (std::fabs(value) > bound) return alphamesh::sign_of(value);
  if (std::fabs(value) + bound < power_of(unit_, D + 2)) return 0;
  Big arm[D + 1][3], exact[D + 1];
  for (int i = 0; i <= D; ++i) {
    Big d[3];
    for (int k = 0; k < 3; ++k) d[k] = exact_difference(v[i], q, k);
    for (int k = 0; k < D; ++k) arm[i][k] = d[axes[k]];
    exact[i] = d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + Big(two_diff(weight(q), weight(v[i])));
  }
  return lifted_determinant<D, Big>(arm, exact).sign();
}

// See in_sphere_perturbed().
template <int D>
bool Sites::conflict_perturbed(const Id* v, Id q, const int* axes) const {
  int order[D + 1];
  for (int i = 0; i <= D; ++i) order[i] = i;
  std::sort(order, order + D + 1, [&](int i, int j) { return less(v[j], v[i]); });
  for (const int i : order) {
    if (less(v[i], q)) return false;
    Id replaced[D + 1];
    std::copy(v, v + D + 1, replaced);
    replaced[i] = q;
    const int s = orient<D>(replaced, axes);
    if (s != 0) return s > 0;
  }
  return false;
}

template int Sites::orient<1>(const Id*, const int*) const;
template int Sites::orient<2>(const Id*, const int*) const;
template int Sites::orient<3>(const Id*, const int*) const;
template bool Sites::conflict<1>(const Id*, Id, const int*) const;
template bool Sites::conflict<2>(const Id*, Id, const int*) const;
template bool Sites::conflict<3>(const Id*, Id, const int*) const;

}  // namespace alphamesh
