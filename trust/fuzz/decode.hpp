// From the bytes of a fuzzer to a cloud, in encodings that make nasty ones likely.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace trust {

// Reads zeros beyond the end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool more() const { return at_ < size_; }
  std::uint8_t next() { return at_ < size_ ? data_[at_++] : 0; }
  int small() { return static_cast<std::int8_t>(next()); }
  double number() {
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | next();
    double v;
    std::memcpy(&v, &bits, sizeof v);
    return v;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

struct Cloud {
  std::size_t dimension = 2, n = 0;
  int threads = 1;
  bool again = false;      // build it once more, in reverse and with one thread
  std::size_t choice = 0;  // which value of the filtration is the radius
  std::vector<double> coordinates;
  std::vector<double> weights;  // empty for a cloud without
  bool periodic = false;
  double periods[3] = {0, 0, 0};  // of a periodic cloud, zero where it is open

  const double* row(std::size_t i) const { return coordinates.data() + dimension * i; }
};

// The same with its points in reverse order.
inline Cloud reversed(const Cloud& cloud) {
  Cloud out = cloud;
  std::reverse(out.weights.begin(), out.weights.end());
  out.coordinates.clear();
  for (std::size_t i = cloud.n; i-- > 0;) {
    out.coordinates.insert(out.coordinates.end(), cloud.row(i), cloud.row(i) + cloud.dimension);
  }
  return out;
}

enum class Encoding { whole, grid, ulps, exponents, repeated, raw, flat, round };
enum class Weighing { whole, grid, ulps, exponents, raw, lifted, above, equal };

class Decoder {
 public:
  Decoder(const std::uint8_t* data, std::size_t size) : bytes_(data, size) {}

  Cloud decode() {
    const std::uint8_t flags = bytes_.next(), how = bytes_.next();
    cloud_.dimension = (flags & 1) != 0 ? 3 : 2;
    cloud_.again = (flags & 2) != 0;
    cloud_.threads = 1 + (flags >> 2) % 3;
    encoding_ = static_cast<Encoding>(how % 8);
    const int exponent = bytes_.small() * ((how & 8) != 0 ? 8 : 1);
    cloud_.choice = bytes_.next();
    for (int& v : span_) v = encoding_ == Encoding::flat ? bytes_.small() : 0;
    const bool weighted = (how & 16) != 0;
    if (weighted) {
      const std::uint8_t weighing = bytes_.next();
      weighing_ = static_cast<Weighing>(weighing % 8);
      weight_exponent_ = (weighing >> 3) % 16 - 4;
    }
    cloud_.periodic = (how & 32) != 0;
    std::size_t most = cloud_.dimension == 2 ? 48 : 24;
    if (cloud_.periodic) {
      periods(how >> 6);
      most = cloud_.dimension == 2 ? 16 : 6;
    }
    while (bytes_.more() && cloud_.n < most) {
      point();
      if (weighted) cloud_.weights.push_back(weight());
      ++cloud_.n;
    }
    for (double& v : cloud_.coordinates) v = std::ldexp(v, exponent);
    for (double& v : cloud_.weights) v = std::ldexp(v, 2 * exponent);
    for (double& v : cloud_.periods) v = std::ldexp(v, exponent);
    return std::move(cloud_);
  }

 private:
  void point() {
    const std::size_t d = cloud_.dimension, before = cloud_.coordinates.size();
    if (encoding_ == Encoding::repeated && before != 0) {
      const std::uint8_t which = bytes_.next();
      if (which < 200) {  // a copy, one coordinate of which may have moved by an ulp or two
        const std::size_t from = d * (which % cloud_.n);
        for (std::size_t k = 0; k < d; ++k) {
          const double copied = cloud_.coordinates[from + k];
          cloud_.coordinates.push_back(copied);
        }
        const int move = bytes_.small();
        cloud_.coordinates[before + static_cast<std::size_t>(std::abs(move)) % d] =
            nudged(cloud_.coordinates[before + static_cast<std::size_t>(std::abs(move)) % d],
                   move % 5 - move % 2);
        return;
      }
    }
    if (encoding_ == Encoding::flat || encoding_ == Encoding::round) {
      together();
      return;
    }
    for (std::size_t k = 0; k < d; ++k) cloud_.coordinates.push_back(coordinate());
  }

  // One direction may be open, of those of a box in the plane.
  void periods(int open) {
    for (std::size_t k = 0; k < cloud_.dimension; ++k) {
      const std::uint8_t side = bytes_.next();
      if (open == static_cast<int>(k) + 1 || (open == 3 && k != side % 2)) continue;
      const double whole = 1 + side % 32;
      cloud_.periods[k] = side < 128 ? whole : side < 192 ? whole / 10 : nudged(whole, side % 3);
    }
    if (cloud_.periods[0] == 0 && cloud_.periods[1] == 0 && cloud_.periods[2] == 0) {
      cloud_.periods[cloud_.dimension - 1] = 4.0;
    }
  }

  double weight() {
    const double* p = cloud_.row(cloud_.n);
    const double square = p[0] * p[0] + p[1] * p[1] + (cloud_.dimension == 3 ? p[2] * p[2] : 0.0);
    switch (weighing_) {
      case Weighing::whole:
        return std::ldexp(bytes_.small(), weight_exponent_);
      case Weighing::grid:
        return std::ldexp(bytes_.next() % 4, weight_exponent_);
      case Weighing::ulps: {
        const int v = bytes_.small();
        return std::ldexp(nudged(0.1 * (v >> 4), (v & 15) - 8), weight_exponent_);
      }
      case Weighing::exponents: {
        const int mantissa = bytes_.small();
        return std::ldexp(mantissa, bytes_.small());
      }
      case Weighing::raw:
        return bytes_.number();
      case Weighing::lifted:  // all in one plane, but for rounding and ulps
        return nudged(square, bytes_.small() % 3);
      case Weighing::above:
        return square + std::ldexp(bytes_.small(), weight_exponent_);
      default:
        return nudged(std::ldexp(3, weight_exponent_), bytes_.next() < 200 ? 0 : 1);
    }
  }

  double coordinate() {
    switch (encoding_) {
      case Encoding::whole:
        return bytes_.small();
      case Encoding::grid:
        return bytes_.next() % 5;
      case Encoding::ulps: {
        const int v = bytes_.small();
        return nudged(0.1 * (v >> 4), (v & 15) - 8);
      }
      case Encoding::exponents: {
        const int mantissa = bytes_.small();
        return std::ldexp(mantissa, bytes_.small());
      }
      default:
        return bytes_.number();
    }
  }

  // Points whose coordinates depend on one another.
  void together() {
    const std::size_t d = cloud_.dimension;
    const int s = bytes_.small(), t = bytes_.small();
    if (encoding_ == Encoding::flat) {  // exactly on a line or, in space, on a plane
      for (std::size_t k = 0; k < d; ++k) {
        const int across = d == 3 ? t * span_[3 + k] : 0;
        cloud_.coordinates.push_back(s * span_[k] + across + span_[6 + k]);
      }
      if (t % 16 == 7) cloud_.coordinates.back() = nudged(cloud_.coordinates.back(), s % 3);
      return;
    }
    // Whole vectors of one length: 65^2 = (16, 63), (25, 60), (33, 56), (39, 52) and their like;
    // in space with a third coordinate, (2, 3, 6), (0, 0, 7) ... of length 7.
    static const int plane[5][2] = {{16, 63}, {25, 60}, {33, 56}, {39, 52}, {0, 65}};
    static const int space[2][3] = {{2, 3, 6}, {0, 0, 7}};
    int v[3];
    if (d == 2) {
      for (int k = 0; k < 2; ++k) v[k] = plane[(s & 7) % 5][(k + (s >> 3)) & 1];
    } else {
      for (int k = 0; k < 3; ++k) v[k] = space[s & 1][(k + (s >> 1 & 3)) % 3];
      if ((s & 8) != 0) std::swap(v[0], v[1]);
    }
    for (std::size_t k = 0; k < d; ++k) {
      const double sign = (t >> k & 1) != 0 ? -1.0 : 1.0;
      cloud_.coordinates.push_back(nudged(sign * v[k] + span_[k], (t & 0x70) == 0x70 ? 1 : 0));
    }
  }

  static double nudged(double v, int ulps) {
    for (; ulps > 0; --ulps) v = std::nextafter(v, HUGE_VAL);
    for (; ulps < 0; ++ulps) v = std::nextafter(v, -HUGE_VAL);
    return v;
  }

  Bytes bytes_;
  Cloud cloud_;
  Encoding encoding_ = Encoding::whole;
  Weighing weighing_ = Weighing::whole;
  int weight_exponent_ = 0;
  int span_[9] = {};
};

}  // namespace trust
