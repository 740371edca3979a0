#include "periodic_values.hpp"

#include <algorithm>
#include <cmath>

#include "big.hpp"
#include "orthosphere.hpp"
#include "predicates3.hpp"

namespace alphamesh {
namespace {

using Id = std::int32_t;
using Vector = Vector3<double>;

// Values outside of this range are computed again, scaled.
constexpr double kLarge = 0x1p900, kSmall = 0x1p-900;

struct Corner {
  Id row;
  int multiple[3];  // of the periods, from the anchor
  int place;        // in the simplex as it is listed
};

// What a simplex is and whose faces: bit k of `attached` if vertex k lies in or on the
// smallest sphere through the others.
struct Measure {
  double radius;
  unsigned attached;
};

class Measurer {
 public:
  explicit Measurer(const PeriodicBox& box) : box_(box), unscale_(-box.exponent) {}

  template <int K>
  Measure measure(const Layer& layer, std::size_t i) const;
  double vertex(Id row) const {
    return box_.weight == nullptr ? 0.0 : radius_of(-box_.weight[row], 0);
  }

 private:
  Dd difference(const Corner& a, const Corner& b, int axis) const {
    return two_diff(anchor(a, axis), anchor(b, axis)) + Dd{step(a, b, axis), 0.0};
  }
  // The same rounded to double, to hardly more than half a unit in the last place: what the
  // first sum loses is nothing where its terms cancel. So the sign is exact.
  double rounded_difference(const Corner& a, const Corner& b, int axis) const {
    const Dd t = two_diff(anchor(a, axis), anchor(b, axis)), s = two_sum(t.h, step(a, b, axis));
    return s.h + (s.l + t.l);
  }
  Big exact_difference(const Corner& a, const Corner& b, int axis) const {
    return Big(two_diff(anchor(a, axis), anchor(b, axis))) + Big(Dd{step(a, b, axis), 0.0});
  }
  double anchor(const Corner& c, int axis) const { return box_.anchor[3 * c.row + axis]; }
  // A product of a small number: exact but for three periods, which are never apart.
  double step(const Corner& a, const Corner& b, int axis) const {
    return (a.multiple[axis] - b.multiple[axis]) * box_.period[axis];
  }
  bool before(const Corner& a, const Corner& b) const;
  Dd change(const Corner& from, const Corner& to) const {
    if (box_.weight == nullptr) return {0.0, 0.0};
    return two_diff(box_.weight[from.row], box_.weight[to.row]);
  }
  // Of a power value that is to be multiplied by 4^exponent.
  double radius_of(double square, int exponent) const {
    const double root = std::copysign(std::sqrt(std::fabs(square)), square);
    return unscale_ * (PowerOfTwo(exponent) * root);
  }
  // Positions along the lexicographic order, so that a value does not depend on the rows.
  template <int K>
  bool measure_plainly(const Corner* c, Measure* out) const;
  template <int K>
  Measure measure_carefully(const Corner* c) const;
  template <int K>
  double exact_square(const Corner* c, int exponent) const;
  template <int K>
  int exact_side(const Corner* c, int k) const;
  Vector arrow(const Corner& from, const Corner& to) const {
    return {rounded_difference(to, from, 0), rounded_difference(to, from, 1),
            rounded_difference(to, from, 2)};
  }

  const PeriodicBox& box_;
  PowerOfTwo unscale_;
};

bool Measurer::before(const Corner& a, const Corner& b) const {
  for (int k = 0; k < 3; ++k) {
    const double d = rounded_difference(a, b, k);
    if (d != 0.0) return d < 0.0;
  }
  return false;
}

template <int K>
Measure Measurer::measure(const Layer& layer, std::size_t i) const {
  Corner c[K + 1];
  for (int j = 0; j <= K; ++j) {
    const std::size_t at = (K + 1) * i + static_cast<std::size_t>(j);
    c[j].row = layer.row[at];
    c[j].place = j;
    for (int k = 0; k < 3; ++k) {
      c[j].multiple[k] =
          layer.offset[3 * at + static_cast<std::size_t>(k)] +
          box_.shift[3 * static_cast<std::size_t>(c[j].row) + static_cast<std::size_t>(k)];
    }
  }
  for (int j = 1; j <= K; ++j) {  // insertion sort
    for (int k = j; k > 0 && before(c[k], c[k - 1]); --k) std::swap(c[k], c[k - 1]);
  }
  Measure sorted;
  if (!measure_plainly<K>(c, &sorted)) sorted = measure_carefully<K>(c);
  Measure out{sorted.radius, 0};
  for (int j = 0; j <= K; ++j) out.attached |= (sorted.attached >> j & 1u) << c[j].place;
  return out;
}

double square(const Vector& v) { return dot(v, v); }

template <>
bool Measurer::measure_plainly<1>(const Corner* c, Measure* out) const {
  if (box_.weight != nullptr) return false;
  *out = {unscale_ * (0.5 * norm(arrow(c[0], c[1]))), 0};
  return true;
}

// As FlatBlock::evaluate().
template <>
bool Measurer::measure_plainly<2>(const Corner* c, Measure* out) const {
  if (box_.weight != nullptr) return false;
  const Vector u = arrow(c[0], c[1]), v = arrow(c[1], c[2]), w = arrow(c[2], c[0]);
  const double u2 = square(u), v2 = square(v), w2 = square(w);
  const double angle[3] = {-dot(u, w), -dot(u, v), -dot(v, w)};
  const double longest = std::max(u2, std::max(v2, w2));
  for (const double a : angle) {
    if (std::fabs(a) <= 8.0 * kEps * longest) return false;
  }
  const Vector n = cross(u, w);
  const double terms = std::fabs(u.y * w.z) + std::fabs(u.z * w.y) + std::fabs(u.z * w.x) +
                       std::fabs(u.x * w.z) + std::fabs(u.x * w.y) + std::fabs(u.y * w.x);
  const double det = norm(n), radius_sq = 0.25 * ((u2 / det) * (v2 / det) * w2);
  if (!(det * 16.0 >= terms && radius_sq < kLarge && radius_sq > kSmall)) return false;
  out->radius = unscale_ * std::sqrt(std::max(radius_sq, 0.25 * longest));
  out->attached =
      (angle[0] < 0.0 ? 1u : 0u) | (angle[1] < 0.0 ? 2u : 0u) | (angle[2] < 0.0 ? 4u : 0u);
  return true;
}

// As TetrahedronBlock::evaluate().
template <>
bool Measurer::measure_plainly<3>(const Corner* c, Measure* out) const {
  if (box_.weight != nullptr) return false;
  const Vector a = arrow(c[0], c[1]), b = arrow(c[0], c[2]), d = arrow(c[0], c[3]);
  const double a2 = square(a), b2 = square(b), d2 = square(d);
  const Vector bd = cross(b, d), da = cross(d, a), ab = cross(a, b);
  const double w = dot(a, bd), product_sq = a2 * b2 * d2;
  const Vector n{a2 * bd.x + b2 * da.x + d2 * ab.x, a2 * bd.y + b2 * da.y + d2 * ab.y,
                 a2 * bd.z + b2 * da.z + d2 * ab.z};
  const double most = std::max(a2, std::max(b2, d2));
  const double inverse = 0.5 / w, flat = 1.0 / 128.0;
  const double radius_sq = square({n.x * inverse, n.y * inverse, n.z * inverse});
  if (!(w * w > flat * flat * product_sq && radius_sq > flat * flat * most && radius_sq < kLarge &&
        radius_sq > kSmall && product_sq < kLarge && product_sq > kSmall)) {
    return false;
  }
  const double side[4] = {2.0 * w * w - (dot(n, bd) + dot(n, da) + dot(n, ab)), dot(n, bd),
                          dot(n, da), dot(n, ab)};
  const double bound = 640.0 * kEps * std::sqrt(product_sq) * (most * std::sqrt(most));
  out->attached = 0;
  for (unsigned k = 0; k < 4; ++k) {
    const double sign = side[k];
    if (!(std::fabs(sign) > bound)) return false;
    if (sign < 0.0) out->attached |= 1u << k;
  }
  out->radius = unscale_ * std::sqrt(radius_sq);
  return true;
}

// What to take out, as a power of two, so that products of eight lengths stay within range. Roots
// of the changes of weights may be longer than all arms, by a factor of 2^270.
template <int K>
int exponent_of(const Dd (*arm)[3], const Dd* change) {
  double length = 0.0, most = 0.0;
  for (int i = 0; i < K; ++i) {
    for (int k = 0; k < 3; ++k) length = std::max(length, std::fabs(arm[i][k].h));
    most = std::max(most, std::fabs(change[i].h));
  }
  const int arms = std::ilogb(length);  // no two sites are at one place
  return most == 0.0 ? arms : std::max(arms, std::min(std::ilogb(most) / 2, arms + 100));
}

Dd scaled(const PowerOfTwo& factor, Dd v) { return {factor * v.h, factor * v.l}; }

template <int K>
Measure Measurer::measure_carefully(const Corner* c) const {
  Dd arm[K][3], changes[K];
  double most = 0.0, highest = 0.0, diagonal = 1.0;
  for (int i = 0; i < K; ++i) {
    for (int k = 0; k < 3; ++k) arm[i][k] = difference(c[i + 1], c[0], k);
    changes[i] = change(c[0], c[i + 1]);
  }
  const int exponent = exponent_of<K>(arm, changes);
  const PowerOfTwo factor(-exponent), factor_sq(-2 * exponent);
  for (int i = 0; i < K; ++i) {
    for (int k = 0; k < 3; ++k) arm[i][k] = scaled(factor, arm[i][k]);
    changes[i] = scaled(factor_sq, changes[i]);
  }
  const Orthosphere<K, Dd> sphere(arm, changes);
  for (int i = 0; i < K; ++i) {
    const double weights =
        box_.weight == nullptr
            ? 0.0
            : factor_sq * (std::fabs(box_.weight[c[0].row]) + std::fabs(box_.weight[c[i + 1].row]));
    most = std::max(most, sphere.gram[i][i].h);
    highest = std::max(highest, sphere.gram[i][i].h + weights);
    diagonal *= sphere.gram[i][i].h;
  }
  Measure out{0.0, 0};
  double power = 1.0;
  for (int i = 1; i < K; ++i) power *= most;
  const double bound = 0x1p-85 * power * (most + highest);
  bool on = false;
  for (int k = 0; k <= K; ++k) {
    const double part = sphere.part[k].h;
    const int s = std::fabs(part) > bound ? sign_of(part) : exact_side<K>(c, k);
    out.attached |= (s <= 0 ? 1u : 0u) << k;
    on = on || s == 0;
  }
  if (box_.weight == nullptr && K == 2 && on) {
    // A right angle: as the edge opposite to it, to the last bit.
    const double side = std::max(square(arrow(c[1], c[2])),
                                 std::max(square(arrow(c[0], c[1])), square(arrow(c[0], c[2]))));
    out.radius = unscale_ * (0.5 * std::sqrt(side));
    return out;
  }
  const double determinant = sphere.determinant.h;
  Dd sum{0.0, 0.0};
  double terms = 0.0;
  for (int i = 0; i < K; ++i) {
    const Dd term = sphere.part[i + 1] * sphere.lift[i];
    sum = sum + term;
    terms += std::fabs(term.h);
  }
  if (box_.weight != nullptr) {
    const Dd own = sphere.determinant * Dd{factor_sq * (-4.0 * box_.weight[c[0].row]), 0.0};
    sum = sum + own;
    terms += std::fabs(own.h);
  }
  double part_terms = power * (most + highest) * highest;
  if (determinant > 0x1p-40 * diagonal && std::fabs(sum.h) > 0x1p-40 * terms &&
      terms > 0x1p-40 * part_terms) {
    out.radius = radius_of(0.25 * (sum.h / determinant), exponent);
  } else {
    out.radius = radius_of(exact_square<K>(c, exponent), exponent);
  }
  return out;
}

// The power value over 4^exponent, from exact numerator and denominator.
template <int K>
double Measurer::exact_square(const Corner* c, int exponent) const {
  const Big factor(Dd{std::ldexp(1.0, -exponent), 0.0});
  Big arm[K][3], changes[K];
  for (int i = 0; i < K; ++i) {
    for (int k = 0; k < 3; ++k) arm[i][k] = factor * exact_difference(c[i + 1], c[0], k);
    changes[i] = factor * (factor * Big(change(c[0], c[i + 1])));
  }
  const Orthosphere<K, Big> sphere(arm, changes);
  Big sum;
  for (int i = 0; i < K; ++i) sum = sum + sphere.part[i + 1] * sphere.lift[i];
  if (box_.weight != nullptr) {
    sum =
        sum + sphere.determinant * (factor * (factor * Big(Dd{-4.0 * box_.weight[c[0].row], 0.0})));
  }
  return 0.25 * (sum.estimate() / sphere.determinant.estimate());
}

template <int K>
int Measurer::exact_side(const Corner* c, int k) const {
  Big arm[K][3], changes[K];
  for (int i = 0; i < K; ++i) {
    for (int m = 0; m < 3; ++m) arm[i][m] = exact_difference(c[i + 1], c[0], m);
    changes[i] = Big(change(c[0], c[i + 1]));
  }
  return Orthosphere<K, Big>(arm, changes).part[k].sign();
}

// The least value of the cofaces of each simplex, and whether one of them attaches it.
struct Bounds {
  Buffer<double> least;
  Buffer<std::uint8_t> attached;

  explicit Bounds(std::size_t n) : least(n), attached(n) {
    std::fill(least.begin(), least.end(), HUGE_VAL);
    std::fill(attached.begin(), attached.end(), std::uint8_t{0});
  }
};

// Radii of a layer, below those of its cofaces; what they mean for its faces goes to `below`.
template <int K>
Buffer<double> radii_of(const Measurer& measurer, const Layer& layer, const Bounds& above,
                        Bounds& below, Job& job) {
  Buffer<double> radius(layer.count);
  Buffer<std::uint8_t> attached(layer.count);
  const Parts parts(layer.count, job, 1024);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      if ((i & 0x3ff) == 0) job.poll();
      const Measure m = measurer.measure<K>(layer, i);
      attached[i] = static_cast<std::uint8_t>(m.attached);
      radius[i] = above.attached[i] != 0 ? above.least[i] : std::min(m.radius, above.least[i]);
    }
    job.advance(0.05 / static_cast<double>(parts.count()));
  });
  for (std::size_t i = 0; i < layer.count; ++i) {
    for (std::size_t k = 0; k <= K; ++k) {
      const auto face = static_cast<std::size_t>(layer.face[(K + 1) * i + k]);
      below.least[face] = std::min(below.least[face], radius[i]);
      if ((attached[i] >> k & 1) != 0) below.attached[face] = 1;
    }
  }
  return radius;
}

}  // namespace

std::vector<Buffer<double>> periodic_radii(const PeriodicBox& box, const std::vector<Layer>& layers,
                                           Job& job) {
  const Measurer measurer(box);
  const std::size_t top = layers.size() - 1;
  std::vector<Buffer<double>> radii(top + 1);
  Bounds above(layers[top].count);
  for (std::size_t k = top; k > 0; --k) {
    Bounds below(layers[k - 1].count);
    if (k == 3) radii[3] = radii_of<3>(measurer, layers[3], above, below, job);
    if (k == 2) radii[2] = radii_of<2>(measurer, layers[2], above, below, job);
    if (k == 1) radii[1] = radii_of<1>(measurer, layers[1], above, below, job);
    above = std::move(below);
  }
  radii[0] = Buffer<double>(layers[0].count);
  for (std::size_t i = 0; i < layers[0].count; ++i) {
    const double own = measurer.vertex(layers[0].row[i]);
    radii[0][i] = above.attached[i] != 0 ? above.least[i] : std::min(own, above.least[i]);
  }
  return radii;
}

}  // namespace alphamesh
