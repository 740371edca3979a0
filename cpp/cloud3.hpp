// Clouds in space as the insertion of points sees them: plain or weighted. What a worker does
// with tetrahedra is the same; how a point is tested against one is decided here.
//
// Records are quick and may leave a decision open. Exact decisions are asked by the numbers of
// the points.
#pragma once

#include <cmath>
#include <cstdint>

#include "power3.hpp"
#include "predicates3.hpp"
#include "spatial_sort.hpp"
#include "sphere3.hpp"

namespace alphamesh {

// What is common: all but the sphere.
class Sites3 {
 public:
  using Id = std::int32_t;

  explicit Sites3(const SpatialOrder3& order)
      : p_(order.points.data()), lattice_(order.lattice), exact_(0x1p-49 * order.lattice.exact5) {}

  Point3 place(Id v) const { return p_[v]; }
  int orient(const Id* v) const {
    return orient3(p_[v[0]], p_[v[1]], p_[v[2]], p_[v[3]], lattice_);
  }

 protected:
  // Whether nothing was rounded on the way to a verdict.
  bool is_exact(Verdict verdict) const { return verdict.bound < exact_; }
  bool perturbed(const Id* v, Id q) const {
    return in_sphere_perturbed(p_[v[0]], p_[v[1]], p_[v[2]], p_[v[3]], p_[q], lattice_);
  }

  const Point3* p_;
  Lattice3 lattice_;
  double exact_;  // a bound below this means that nothing was rounded
};

class PlainCloud3 : public Sites3 {
 public:
  using Point = Point3;
  using Sphere = alphamesh::Sphere;
  using Arm = alphamesh::Arm;
  static constexpr bool kHides = false;  // each point is a vertex

  using Sites3::Sites3;
  Point point(Id v) const { return p_[v]; }
  Arm arm(Id v, Point q) const {
    const Vector3<double> d = p_[v] - q;
    const double square = dot(d, d);
    return {d.x, d.y, d.z, square, std::sqrt(square), v};
  }
  static Arm infinite_arm(Id v) { return {0.0, 0.0, 0.0, 1.0, 0.0, v}; }
  // Whether q is inside the sphere of the tetrahedron v, given what its record says.
  bool in_sphere(const Id* v, Id q, Verdict verdict) const {
    const int s = is_exact(verdict)
                      ? sign_of(verdict.value)
                      : in_sphere_exact(p_[v[0]], p_[v[1]], p_[v[2]], p_[v[3]], p_[q], lattice_);
    return s != 0 ? s > 0 : perturbed(v, q);
  }
};

// Ties are broken as without weights: the largest point is lifted most. Its lift counts for the
// affine hull of any points alike, so that no tetrahedron is flat; and a point that ties with
// others around it is below them then, as it is never the largest of them: hidden points are
// those whose power cell is empty, not those whose cell has but no inside.
class WeightedCloud3 : public Sites3 {
 public:
  using Point = Weighted3;
  using Sphere = PowerSphere;
  using Arm = PowerArm;
  static constexpr bool kHides = true;

  explicit WeightedCloud3(const SpatialOrder3& order)
      : Sites3(order), weight_(order.weight.data()) {}
  Point point(Id v) const { return {p_[v], weight_[v]}; }
  Arm arm(Id v, const Point& q) const {
    const Vector3<double> d = p_[v] - q;
    const double square = dot(d, d), weight = q.weight - weight_[v];
    return {d.x, d.y, d.z, square + weight, std::sqrt(square), square + std::fabs(weight), v};
  }
  static Arm infinite_arm(Id v) { return {0.0, 0.0, 0.0, 1.0, 0.0, 1.0, v}; }
  bool in_sphere(const Id* v, Id q, Verdict verdict) const {
    const int s = is_exact(verdict) ? sign_of(verdict.value)
                                    : in_power_sphere_exact(point(v[0]), point(v[1]), point(v[2]),
                                                            point(v[3]), point(q), lattice_);
    return s != 0 ? s > 0 : perturbed(v, q);
  }

 private:
  const double* weight_;
};

}  // namespace alphamesh
