// Points whose coordinates are sums of two doubles, with weights: copies in periodic boxes.
//
// A copy of a point lies a whole number of periods away, which a double cannot hold in
// general. A sum of two always can. Decisions read filter, then double-double, then exact,
// as in predicates3.hpp.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "exact.hpp"
#include "memory.hpp"
#include "predicates3.hpp"

namespace alphamesh {

class Big;

class Sites {
 public:
  using Id = std::int32_t;

  explicit Sites(std::size_t n) : size_(n), high_(n), low_(n), weight_(n) {}

  std::size_t size() const { return size_; }
  const Point3& high(Id i) const { return high_[static_cast<std::size_t>(i)]; }
  double weight(Id i) const { return weight_[static_cast<std::size_t>(i)]; }
  void set(Id i, const Dd* position, double weight);
  // All coordinates are multiples of `unit`, all weights of its square (0: nothing known).
  void set_unit(double unit) { unit_ = unit; }

  // Rounded to double-double: its sign is exact.
  Dd difference(Id a, Id b, int axis) const;
  Big exact_difference(Id a, Id b, int axis) const;
  bool less(Id a, Id b) const;  // lexicographic

  // Signs for simplices of dimension D = 1, 2 or 3 along D of the axes.
  // orient: +1 if v[0 ... D] is positively oriented.
  template <int D>
  int orient(const Id* v, const int* axes) const;
  // Whether q is nearer, in power, to the orthocentre of v[0 ... D], positively oriented,
  // than these are. Ties are broken as by in_sphere_perturbed(). Distances are those of
  // space whatever D is.
  template <int D>
  bool conflict(const Id* v, Id q, const int* axes) const;

 private:
  template <int D>
  int conflict_carefully(const Id* v, Id q, const int* axes) const;
  template <int D>
  bool conflict_perturbed(const Id* v, Id q, const int* axes) const;

  std::size_t size_;
  Buffer<Point3> high_, low_;
  Buffer<double> weight_;
  double most_low_ = 0.0;  // the largest magnitude of a lower half
  double unit_ = 0.0;
};

inline double coordinate(const Point3& p, int axis) {
  return axis == 0 ? p.x : (axis == 1 ? p.y : p.z);
}

}  // namespace alphamesh
