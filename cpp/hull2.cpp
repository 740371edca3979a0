#include "hull2.hpp"

#include <algorithm>
#include <vector>

#include "predicates2.hpp"
#include "spatial_sort.hpp"

namespace alphamesh {
namespace {

struct Entry {
  Point2 p;
  std::int32_t row;
};

bool before(const Entry& a, const Entry& b) { return a.p < b.p || (a.p == b.p && a.row < b.row); }

constexpr std::size_t kDirections = 8;

// How far a point lies in each of eight directions, counter-clockwise from the right.
// Rounding is harmless: whatever points win, what their polygon surrounds is inside.
void heights(Point2 p, double (&h)[kDirections]) {
  h[0] = p.x;
  h[1] = p.x + p.y;
  h[2] = p.y;
  h[3] = p.y - p.x;
  for (std::size_t k = 0; k < 4; ++k) h[k + 4] = -h[k];
}

// The cloud, brought into the range of exact products.
class Source {
 public:
  Source(const double* xy, std::size_t n, Job& job)
      : xy_(xy), n_(n), factor_(range_exponent<Plane>(xy, n, job)) {}
  std::size_t size() const { return n_; }
  Point2 operator[](std::size_t i) const {
    return {factor_ * xy_[2 * i], factor_ * xy_[2 * i + 1]};
  }

 private:
  const double* xy_;
  std::size_t n_;
  PowerOfTwo factor_;
};

struct Extremes {
  double height[kDirections];
  Point2 point[kDirections];
};

Extremes extremes_of(const Source& source, std::size_t begin, std::size_t end) {
  Extremes e;
  std::fill(e.height, e.height + kDirections, -HUGE_VAL);
  for (std::size_t i = begin; i < end; ++i) {
    const Point2 p = source[i];
    double h[kDirections];
    heights(p, h);
    for (std::size_t k = 0; k < kDirections; ++k) {
      if (h[k] <= e.height[k]) continue;
      e.height[k] = h[k];
      e.point[k] = p;
    }
  }
  return e;
}

// A convex polygon of extreme points, counter-clockwise; too few to surround anything if flat.
std::vector<Point2> extreme_polygon(const Source& source, Job& job) {
  const Parts parts(source.size(), job);
  std::vector<Extremes> found(parts.count());
  job.run(parts.count(),
          [&](std::size_t i) { found[i] = extremes_of(source, parts.begin(i), parts.end(i)); });
  std::vector<Point2> polygon;
  for (std::size_t k = 0; k < kDirections; ++k) {
    const auto best = std::max_element(
        found.begin(), found.end(),
        [k](const Extremes& a, const Extremes& b) { return a.height[k] < b.height[k]; });
    if (polygon.empty() || !(best->point[k] == polygon.back())) polygon.push_back(best->point[k]);
  }
  while (polygon.size() > 1 && polygon.front() == polygon.back()) polygon.pop_back();
  return polygon;
}

// Left of all sides beyond the bound of rounding. Where the polygon is not convex, for
// ties of heights, such a point is surrounded all the same.
bool surely_inside(const std::vector<Point2>& polygon, Point2 p) {
  Point2 a = polygon.back();
  for (const Point2 b : polygon) {
    const double l = (a.x - p.x) * (b.y - p.y), r = (a.y - p.y) * (b.x - p.x);
    if (!(l - r > kBound2 * (std::fabs(l) + std::fabs(r)))) return false;
    a = b;
  }
  return true;
}

// The points that may be on the hull, in lexicographic order, without repeats.
std::vector<Entry> candidates(const Source& source, Job& job) {
  const std::vector<Point2> polygon = extreme_polygon(source, job);
  const Parts parts(source.size(), job);
  std::vector<std::vector<Entry>> found(parts.count());
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      const Point2 p = source[i];
      if (polygon.size() > 2 && surely_inside(polygon, p)) continue;
      found[part].push_back({p, static_cast<std::int32_t>(i)});
    }
    std::sort(found[part].begin(), found[part].end(), before);
  });
  std::vector<Entry> all;
  for (const std::vector<Entry>& part : found) {
    job.poll();
    const auto middle = static_cast<std::ptrdiff_t>(all.size());
    all.insert(all.end(), part.begin(), part.end());
    std::inplace_merge(all.begin(), all.begin() + middle, all.end(), before);
  }
  const auto same = [](const Entry& a, const Entry& b) { return a.p == b.p; };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  return all;
}

// Andrew's monotone chain over [first, last), turning left; the last point is left to the
// chain that follows.
template <class Iterator>
void append_chain(Iterator first, Iterator last, bool collinear, Job& job,
                  std::vector<Entry>& ring) {
  const std::size_t begin = ring.size();
  const int least = collinear ? 0 : 1;
  for (; first != last; ++first) {
    while (ring.size() > begin + 1 &&
           orient(ring[ring.size() - 2].p, ring.back().p, first->p, Lattice()) < least) {
      ring.pop_back();
    }
    ring.push_back(*first);
    if (ring.size() % 1024 == 0) job.poll();
  }
  ring.pop_back();
}

std::vector<Entry> ring_of(const std::vector<Entry>& points, bool collinear, Job& job) {
  std::vector<Entry> ring;
  append_chain(points.begin(), points.end(), collinear, job, ring);
  append_chain(points.rbegin(), points.rend(), collinear, job, ring);
  return ring;
}

}  // namespace

Buffer<std::int32_t> hull2(const double* xy, std::size_t n, bool collinear, Job& job) {
  if (n == 0) return {};
  const std::vector<Entry> points = candidates(Source(xy, n, job), job);
  std::vector<Entry> ring = points;
  if (points.size() > 1) {
    ring = ring_of(points, false, job);
    if (collinear) ring = ring.size() == 2 ? points : ring_of(points, true, job);
  }
  Buffer<std::int32_t> out(ring.size());
  std::transform(ring.begin(), ring.end(), out.begin(), [](const Entry& e) { return e.row; });
  return out;
}

}  // namespace alphamesh
