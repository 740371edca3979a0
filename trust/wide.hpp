// Whole numbers of any length, slow and obvious: what the predicates are held against.
// Nothing of the core is used here.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace trust {

// Sign and magnitude, 32 bits a digit, the lowest first, no zeros at the top.
class Wide {
 public:
  Wide() = default;

  // v must be a whole number after multiplication by 2^shift.
  static Wide of(double v, int shift) {
    Wide out;
    int exponent;
    const double fraction = std::frexp(v, &exponent);
    auto mantissa = static_cast<std::int64_t>(std::ldexp(std::fabs(fraction), 53));
    int e = exponent - 53 + shift;
    while (e < 0 && (mantissa & 1) == 0 && mantissa != 0) mantissa >>= 1, ++e;
    if (mantissa == 0) return out;
    if (e < 0) throw "not a whole number";
    out.negative_ = v < 0;
    out.digits_.assign(static_cast<std::size_t>(e / 32), 0u);
    unsigned __int128 rest = static_cast<unsigned __int128>(mantissa) << (e % 32);
    for (; rest != 0; rest >>= 32) out.digits_.push_back(static_cast<std::uint32_t>(rest));
    return out;
  }

  int sign() const { return digits_.empty() ? 0 : (negative_ ? -1 : 1); }

  friend Wide operator-(Wide a) {
    a.negative_ = !a.negative_;
    return a;
  }
  friend Wide operator-(const Wide& a, const Wide& b) { return a + (-b); }
  friend Wide operator+(const Wide& a, const Wide& b) {
    if (a.negative_ == b.negative_) {
      Wide out = added(a, b);
      out.negative_ = a.negative_;
      return out;
    }
    const int order = compare(a, b);
    if (order == 0) return {};
    Wide out = order > 0 ? subtracted(a, b) : subtracted(b, a);
    out.negative_ = order > 0 ? a.negative_ : b.negative_;
    return out;
  }
  friend Wide operator*(const Wide& a, const Wide& b) {
    Wide out;
    out.digits_.assign(a.digits_.size() + b.digits_.size(), 0u);
    for (std::size_t i = 0; i < a.digits_.size(); ++i) {
      std::uint64_t carry = 0;
      for (std::size_t j = 0; j < b.digits_.size(); ++j) {
        carry += static_cast<std::uint64_t>(a.digits_[i]) * b.digits_[j] + out.digits_[i + j];
        out.digits_[i + j] = static_cast<std::uint32_t>(carry);
        carry >>= 32;
      }
      out.digits_[i + b.digits_.size()] = static_cast<std::uint32_t>(carry);
    }
    out.negative_ = a.negative_ != b.negative_;
    out.trim();
    return out;
  }

 private:
  void trim() {
    while (!digits_.empty() && digits_.back() == 0) digits_.pop_back();
  }
  std::uint64_t digit(std::size_t i) const { return i < digits_.size() ? digits_[i] : 0; }

  static int compare(const Wide& a, const Wide& b) {
    if (a.digits_.size() != b.digits_.size()) return a.digits_.size() < b.digits_.size() ? -1 : 1;
    for (std::size_t i = a.digits_.size(); i-- > 0;) {
      if (a.digits_[i] != b.digits_[i]) return a.digits_[i] < b.digits_[i] ? -1 : 1;
    }
    return 0;
  }
  static Wide added(const Wide& a, const Wide& b) {
    Wide out;
    std::uint64_t carry = 0;
    const std::size_t n = a.digits_.size() > b.digits_.size() ? a.digits_.size() : b.digits_.size();
    for (std::size_t i = 0; i < n || carry != 0; ++i) {
      carry += a.digit(i) + b.digit(i);
      out.digits_.push_back(static_cast<std::uint32_t>(carry));
      carry >>= 32;
    }
    return out;
  }
  static Wide subtracted(const Wide& a, const Wide& b) {  // |a| > |b|
    Wide out;
    std::int64_t borrow = 0;
    for (std::size_t i = 0; i < a.digits_.size(); ++i) {
      std::int64_t d = static_cast<std::int64_t>(a.digit(i)) -
                       static_cast<std::int64_t>(b.digit(i)) - borrow;
      borrow = d < 0 ? 1 : 0;
      if (d < 0) d += std::int64_t{1} << 32;
      out.digits_.push_back(static_cast<std::uint32_t>(d));
    }
    out.trim();
    return out;
  }

  bool negative_ = false;
  std::vector<std::uint32_t> digits_;
};

}  // namespace trust
