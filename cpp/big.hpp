// Expansions of any length, for the rare decisions that double-double leaves open.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "exact.hpp"

namespace alphamesh {

class Big {
 public:
  Big() = default;
  explicit Big(Dd a) {
    push(a.l);
    push(a.h);
  }

  friend Big operator+(const Big& a, const Big& b) { return merged(a, b, 1.0); }
  friend Big operator-(const Big& a, const Big& b) { return merged(a, b, -1.0); }
  friend Big operator*(const Big& a, const Big& b) {
    if (a.terms_.size() < b.terms_.size()) return b * a;
    return a.times(b, 0, b.terms_.size());
  }

  // The same in as few terms as there are: Shewchuk's COMPRESS.
  Big compressed() const {
    if (terms_.empty()) return {};
    std::vector<double> upper;  // largest first
    double carry = terms_.back();
    for (std::size_t i = terms_.size() - 1; i-- > 0;) {
      const Dd s = two_sum(carry, terms_[i]);
      if (s.l != 0.0) upper.push_back(s.h);
      carry = s.l != 0.0 ? s.l : s.h;
    }
    Big out;
    while (!upper.empty()) {
      const Dd s = two_sum(upper.back(), carry);
      upper.pop_back();
      out.push(s.l);
      carry = s.h;
    }
    out.push(carry);
    return out;
  }
  // Times 2^e; what falls below the range of doubles is lost.
  Big scaled_by_power(int e) const {
    Big out;
    for (const double t : terms_) out.push(std::ldexp(t, e));
    return out;
  }

  double estimate() const {
    double s = 0.0;
    for (const double t : terms_) s += t;
    return s;
  }
  // Exact: the terms are distilled until the largest one has the sign of the sum.
  int sign() const {
    double s = 0.0, magnitude = 0.0;
    for (const double t : terms_) {
      s += t;
      magnitude += std::fabs(t);
    }
    if (std::fabs(s) > static_cast<double>(terms_.size()) * 0x1p-52 * magnitude) {
      return s > 0.0 ? 1 : -1;
    }
    std::vector<double> e;
    for (const double t : terms_) {  // Shewchuk's GROW-EXPANSION
      double carry = t;
      std::size_t kept = 0;
      for (const double x : e) {
        const Dd sum = two_sum(carry, x);
        if (sum.l != 0.0) e[kept++] = sum.l;
        carry = sum.h;
      }
      e.resize(kept);
      if (carry != 0.0) e.push_back(carry);
    }
    return e.empty() ? 0 : (e.back() > 0.0 ? 1 : -1);
  }

 private:
  void push(double t) {
    if (t != 0.0) terms_.push_back(t);
  }

  static Big merged(const Big& a, const Big& b, double sign) {
    Big out;
    out.terms_.reserve(a.terms_.size() + b.terms_.size() + 1);
    std::size_t i = 0, j = 0;
    double carry = 0.0;
    while (i < a.terms_.size() || j < b.terms_.size()) {
      const bool left = j == b.terms_.size() ||
                        (i < a.terms_.size() && std::fabs(a.terms_[i]) < std::fabs(b.terms_[j]));
      const Dd s = two_sum(carry, left ? a.terms_[i++] : sign * b.terms_[j++]);
      out.push(s.l);
      carry = s.h;
    }
    out.push(carry);
    return out;
  }

  Big scaled(double b) const {
    Big out;
    out.terms_.reserve(2 * terms_.size());
    double carry = 0.0;
    for (const double a : terms_) {
      const Dd p = two_prod(a, b), s = two_sum(carry, p.l), r = two_sum(p.h, s.h);
      out.push(s.l);
      out.push(r.l);
      carry = r.h;
    }
    out.push(carry);
    return out;
  }

  Big times(const Big& b, std::size_t from, std::size_t to) const {  // halving keeps sums short
    if (from == to) return {};
    if (to - from == 1) return scaled(b.terms_[from]);
    const std::size_t mid = from + (to - from) / 2;
    return times(b, from, mid) + times(b, mid, to);
  }

  std::vector<double> terms_;
};

}  // namespace alphamesh
