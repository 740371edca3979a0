// Exact arithmetic on doubles: error-free transformations, double-double, expansions.
//
// Sources: Dekker 1971 (products), Knuth 1969 (sums), Shewchuk 1997 (expansions),
// Joldes, Muller & Popescu 2017 (error bounds of double-double operations).
// All of it supposes IEEE 754 doubles, rounding to nearest, and no contraction of
// a product and a sum into one instruction; selftest.cpp proves that on each build.
#pragma once

#include <cfloat>
#include <cmath>
#include <cstddef>

static_assert(FLT_EVAL_METHOD == 0, "intermediate results must be doubles");

namespace alphamesh {

// A sum of two doubles, h the sum rounded to nearest, l the rest.
struct Dd {
  double h, l;
};

inline Dd fast_two_sum(double a, double b) {  // needs |a| >= |b|
  const double s = a + b;
  return {s, b - (s - a)};
}

inline Dd two_sum(double a, double b) {
  const double s = a + b;
  const double bb = s - a;
  return {s, (a - (s - bb)) + (b - bb)};
}

inline Dd two_diff(double a, double b) {
  const double s = a - b;
  const double bb = a - s;
  return {s, (a - (s + bb)) + (bb - b)};
}

inline Dd split(double a) {
  const double c = 134217729.0 * a;  // 2^27 + 1
  const double h = c - (c - a);
  return {h, a - h};
}

inline Dd two_prod(double a, double b) {
  const double p = a * b;
  const Dd x = split(a), y = split(b);
  return {p, x.l * y.l - (((p - x.h * y.h) - x.l * y.h) - x.h * y.l)};
}

// Relative errors at most 3 u^2 (sum, barring cancellation) and 8 u^2 (product), u = 2^-53.
inline Dd operator+(Dd a, Dd b) {
  const Dd s = two_sum(a.h, b.h), t = two_sum(a.l, b.l);
  const Dd v = fast_two_sum(s.h, s.l + t.h);
  return fast_two_sum(v.h, t.l + v.l);
}

inline Dd operator-(Dd a) { return {-a.h, -a.l}; }
inline Dd operator-(Dd a, Dd b) { return a + (-b); }

inline Dd operator*(Dd a, Dd b) {
  const Dd p = two_prod(a.h, b.h);
  return fast_two_sum(p.h, p.l + (a.h * b.l + a.l * b.h));
}

// a - b, accurate where the larger parts cancel, too.
inline Dd wide_difference(Dd a, Dd b) {
  const Dd high = two_diff(a.h, b.h), low = two_diff(a.l, b.l);
  return low.h == 0.0 ? high : high + low;
}

// A double-double whose parts are left as they come (Lange & Rump, Faithfully rounded
// floating-point computations, 2020): half the operations for a few bits less. With M the
// same formula of magnitudes, |l| <= k u M and the error is at most c u^2 M, where
//   a difference of doubles has k = 1, c = 0,
//   a sum     k = max(k, k') + 1,  c = max(c, c') + 2 k,
//   a product k = k + k' + 1,      c = c + c' + k k' + 3 (k + k') + 1,
// leaving out higher powers of u.
struct Pair {
  double h, l;

  Pair() = default;
  Pair(double high, double low) : h(high), l(low) {}
  explicit Pair(Dd a) : h(a.h), l(a.l) {}
};

inline Pair operator+(Pair a, Pair b) {
  const Dd s = two_sum(a.h, b.h);
  return {s.h, s.l + (a.l + b.l)};
}

inline Pair operator-(Pair a, Pair b) {
  const Dd s = two_diff(a.h, b.h);
  return {s.h, s.l + (a.l - b.l)};
}

inline Pair operator*(Pair a, Pair b) {
  const Dd p = two_prod(a.h, b.h);
  return {p.h, p.l + (a.h * b.l + a.l * b.h)};
}

// An expansion: an exact sum of at most N doubles, about smallest first, no zeros.
// Capacities follow from the formulas, so they cannot be exceeded.
template <std::size_t N>
struct Expansion {
  double term[N];
  std::size_t size = 0;

  void push(double t) {
    if (t != 0.0) term[size++] = t;
  }
  double estimate() const {
    double s = 0.0;
    for (std::size_t i = 0; i < size; ++i) s += term[i];
    return s;
  }
  // Exact. The plain sum settles it nearly always, as the terms hardly overlap; its
  // rounding error is below (size - 1) u times the sum of the magnitudes.
  int sign() const {
    double s = 0.0, magnitude = 0.0;
    for (std::size_t i = 0; i < size; ++i) {
      s += term[i];
      magnitude += std::fabs(term[i]);
    }
    if (std::fabs(s) > static_cast<double>(size) * 0x1p-52 * magnitude) return s > 0.0 ? 1 : -1;
    return distilled_sign();
  }

 private:
  // Shewchuk's GROW-EXPANSION, term by term: nonoverlapping whatever the terms are, so
  // that the sign of the largest one is the sign of the sum.
  int distilled_sign() const {
    double e[N];
    std::size_t m = 0;
    for (std::size_t i = 0; i < size; ++i) {
      double carry = term[i];
      std::size_t kept = 0;
      for (std::size_t k = 0; k < m; ++k) {
        const Dd s = two_sum(carry, e[k]);
        if (s.l != 0.0) e[kept++] = s.l;
        carry = s.h;
      }
      if (carry != 0.0) e[kept++] = carry;
      m = kept;
    }
    return m == 0 ? 0 : (e[m - 1] > 0.0 ? 1 : -1);
  }
};

inline Expansion<2> expansion(Dd a) {
  Expansion<2> e;
  e.push(a.l);
  e.push(a.h);
  return e;
}

// Shewchuk's FAST-EXPANSION-SUM with elimination of zeros.
template <std::size_t A, std::size_t B>
Expansion<A + B> operator+(const Expansion<A>& a, const Expansion<B>& b) {
  Expansion<A + B> out;
  std::size_t i = 0, j = 0;
  double carry = 0.0;
  while (i < a.size || j < b.size) {
    const double x = i < a.size ? a.term[i] : 0.0, y = j < b.size ? b.term[j] : 0.0;
    const bool left = j == b.size || (i < a.size && ((y > x) == (y > -x)));  // |x| < |y|
    const Dd s = two_sum(carry, left ? x : y);
    (left ? i : j) += 1;
    out.push(s.l);
    carry = s.h;
  }
  out.push(carry);
  return out;
}

template <std::size_t A>
Expansion<A> operator-(Expansion<A> a) {
  for (std::size_t i = 0; i < a.size; ++i) a.term[i] = -a.term[i];
  return a;
}

template <std::size_t A, std::size_t B>
Expansion<A + B> operator-(const Expansion<A>& a, const Expansion<B>& b) {
  return a + (-b);
}

// Shewchuk's SCALE-EXPANSION with elimination of zeros.
template <std::size_t A>
Expansion<2 * A> scale(const Expansion<A>& a, double b) {
  Expansion<2 * A> out;
  if (a.size == 0) return out;
  Dd q = two_prod(a.term[0], b);
  out.push(q.l);
  double carry = q.h;
  for (std::size_t i = 1; i < a.size; ++i) {
    const Dd t = two_prod(a.term[i], b);
    const Dd s = two_sum(carry, t.l);
    out.push(s.l);
    const Dd r = two_sum(t.h, s.h);
    out.push(r.l);
    carry = r.h;
  }
  out.push(carry);
  return out;
}

template <std::size_t A, std::size_t B>
Expansion<2 * A * B> operator*(const Expansion<A>& a, const Expansion<B>& b) {
  Expansion<2 * A * B> sum;
  for (std::size_t i = 0; i < b.size; ++i) {
    const Expansion<2 * A * B + 2 * A> next = sum + scale(a, b.term[i]);
    sum.size = next.size;  // at most 2 A (i + 1)
    for (std::size_t k = 0; k < next.size; ++k) sum.term[k] = next.term[k];
  }
  return sum;
}

}  // namespace alphamesh
