// The peer CGAL as one function: its bare triangulation in space, points in spatial order.
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangulation = CGAL::Delaunay_triangulation_3<Kernel>;

extern "C" long cgal_delaunay3(const double* xyz, long n) {
  std::vector<Kernel::Point_3> points;
  points.reserve(static_cast<std::size_t>(n));
  for (long i = 0; i < n; ++i) points.emplace_back(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
  const Triangulation made(points.begin(), points.end());  // sorts them along a curve
  return static_cast<long>(made.number_of_finite_cells());
}
