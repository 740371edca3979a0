#include "nearest3.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spatial_sort.hpp"

namespace alphamesh {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Vector = Vector3<double>;

Box3 joined(const Box3& a, const Box3& b) {
  return {
      {std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z)},
      {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y), std::max(a.high.z, b.high.z)}};
}

Box3 box_of(const Triangle3& t) { return joined(joined({t.a, t.a}, {t.b, t.b}), {t.c, t.c}); }

double squared(const Vector& v) { return dot(v, v); }

inline double squared(const Point3& p, const Box3& b) {
  const double x = std::max(0.0, std::max(b.low.x - p.x, p.x - b.high.x));
  const double y = std::max(0.0, std::max(b.low.y - p.y, p.y - b.high.y));
  const double z = std::max(0.0, std::max(b.low.z - p.z, p.z - b.high.z));
  return x * x + y * y + z * z;
}

// Seen from the nearer end, so that long segments are no less accurate than short ones.
double squared(Point3 p, Point3 a, Point3 b) {
  const Vector d = b - a, from_a = p - a, from_b = p - b;
  if (dot(from_a, d) <= 0.0) return squared(from_a);
  if (dot(from_b, d) >= 0.0) return squared(from_b);
  const double a_sq = squared(from_a), b_sq = squared(from_b);
  return squared(cross(d, a_sq < b_sq ? from_a : from_b)) / squared(d);
}

// The normal (b - a) x (c - a), computed again where it cancels.
Vector normal(const Triangle3& t) {
  const Vector u = t.b - t.a, v = t.c - t.a, n = cross(u, v);
  const bool thin = squared(n) < 0x1p-40 * squared(u) * squared(v);
  return thin ? normal_accurate(t.a, t.b, t.c) : n;
}

// Whether the foot of the perpendicular from p to the plane lies in the triangle (Ericson,
// Real-Time Collision Detection, 2005, section 5.1.5). Near its border it does not matter:
// the distances to the plane and to the side agree there.
bool above(Point3 p, const Triangle3& t, const Vector& n) {
  const Vector a = p - t.a, b = p - t.b, c = p - t.c;
  return dot(n, cross(t.b - t.a, a)) >= 0.0 && dot(n, cross(t.c - t.b, b)) >= 0.0 &&
         dot(n, cross(t.a - t.c, c)) >= 0.0 && squared(n) > 0.0;
}

double squared(const Point3& p, const Triangle3& t) {
  const Vector n = normal(t);
  if (above(p, t, n)) {
    const double height = dot(n, p - t.a);
    return height / squared(n) * height;
  }
  return std::min(squared(p, t.a, t.b), std::min(squared(p, t.b, t.c), squared(p, t.c, t.a)));
}

Point3 moved(Point3 p, const Vector& v, double share) {
  return {p.x + share * v.x, p.y + share * v.y, p.z + share * v.z};
}

// The nearest point of a segment, and how far it is to about 2^-50 of the distance.
Point3 nearest_on(Point3 a, Point3 b, Point3 p, double& distance) {
  const Vector d = b - a, from_a = p - a, from_b = p - b;
  if (dot(from_a, d) <= 0.0 || dot(from_b, d) >= 0.0) {
    const bool at_a = dot(from_a, d) <= 0.0;
    distance = norm(at_a ? from_a : from_b);
    return at_a ? a : b;
  }
  distance = norm(normal_accurate(a, b, p)) / norm(d);
  if (distance == 0.0) return p;
  const bool nearer_a = squared(from_a) < squared(from_b);
  const double share = dot(nearer_a ? from_a : from_b, d) / squared(d);
  return moved(nearer_a ? a : b, d, share);
}

Point3 nearest_on(const Triangle3& t, Point3 p, double& distance) {
  const Vector n = normal(t);
  if (above(p, t, n)) {
    const double height = volume_accurate(t.a, t.b, t.c, p);
    distance = std::fabs(height) / norm(n);
    return moved(p, n, -height / squared(n));
  }
  Point3 best{};
  distance = kInfinity;
  const Point3 ends[4] = {t.a, t.b, t.c, t.a};
  for (int i = 0; i < 3; ++i) {
    double other;
    const Point3 q = nearest_on(ends[i], ends[i + 1], p, other);
    if (other < distance) {
      distance = other;
      best = q;
    }
  }
  return best;
}

std::array<double, 3> place(Point3 p) { return {p.x, p.y, p.z}; }

struct Triangles {
  using Point = Point3;
  using Item = Triangle3;
  using Box = Box3;

  static Box box_of(const Item& item) { return alphamesh::box_of(item); }
  static Box joined(const Box& a, const Box& b) { return alphamesh::joined(a, b); }
  template <class T>
  static double squared(const Point& p, const T& what) {
    return alphamesh::squared(p, what);
  }
  static bool near(const Point& p, const Item& t, double sq) {
    return alphamesh::squared(p, alphamesh::box_of(t)) <= sq;
  }
  static Point nearest_on(const Item& item, const Point& p, double& distance) {
    return alphamesh::nearest_on(item, p, distance);
  }
};

}  // namespace

TriangleTree3 triangle_tree3(const double* points, const std::int32_t* corners, std::size_t k,
                             Job& job) {
  auto point = [&](std::int32_t row) {
    const double* p = points + 3 * static_cast<std::size_t>(row);
    return Point3{p[0], p[1], p[2]};
  };
  auto triangle = [&](std::size_t i) {
    return Triangle3{point(corners[3 * i]), point(corners[3 * i + 1]), point(corners[3 * i + 2])};
  };
  const auto order =
      along_curve<Space>(k, [&](std::size_t i) { return place(box_of(triangle(i)).low); }, job);
  return box_tree<Triangles>(k, order, triangle, job);
}

Nearest3 nearest3(const TriangleTreeView3& tree, const double* queries, std::size_t q, Job& job) {
  auto query = [&](std::size_t i) {
    return Point3{queries[3 * i], queries[3 * i + 1], queries[3 * i + 2]};
  };
  const auto order = along_curve<Space>(q, [&](std::size_t i) { return place(query(i)); }, job);
  return nearest_items<Triangles>(tree, q, order, query, 512, job);
}

}  // namespace alphamesh
