#include "spatial_sort2.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "radix_sort.hpp"

namespace alphamesh {
namespace {

// No product of four differences leaves the range of doubles, nor loses a bit at its
// lower end, if coordinates stay below 2^kTop and are multiples of 2^kBottom.
constexpr int kTop = 250;
constexpr int kBottom = -240;
constexpr int kMantissa = 52;
constexpr int kLatticeBits = 40;
constexpr int kNoUnit = std::numeric_limits<int>::max();  // all coordinates are zero

// Exponent of the least significant bit that is set.
int unit_exponent(double v) {
  if (v == 0.0) return kNoUnit;
  int e;
  const double m = std::frexp(std::fabs(v), &e);  // v = m 2^e, m in [1/2, 1)
  auto digits = static_cast<std::uint64_t>(std::ldexp(m, kMantissa + 1));
  e -= kMantissa + 1;
  while ((digits & 1u) == 0) {
    digits >>= 1;
    ++e;
  }
  return e;
}

struct Extent {
  double lo[2] = {HUGE_VAL, HUGE_VAL};
  double hi[2] = {-HUGE_VAL, -HUGE_VAL};
  double tiny = HUGE_VAL;  // least nonzero magnitude
  bool finite = true;

  void add(const Extent& o) {
    for (int k = 0; k < 2; ++k) {
      lo[k] = std::min(lo[k], o.lo[k]);
      hi[k] = std::max(hi[k], o.hi[k]);
    }
    tiny = std::min(tiny, o.tiny);
    finite = finite && o.finite;
  }
  double magnitude() const { return std::max(std::max(-lo[0], hi[0]), std::max(-lo[1], hi[1])); }
};

Extent extent_of(const double* xy, std::size_t begin, std::size_t end) {
  Extent e;
  double check = 0.0;  // becomes NaN once a coordinate is NaN or infinite
  for (std::size_t i = begin; i < end; ++i) {
    for (std::size_t k = 0; k < 2; ++k) {
      const double v = xy[2 * i + k];
      check += v - v;
      e.lo[k] = v < e.lo[k] ? v : e.lo[k];
      e.hi[k] = v > e.hi[k] ? v : e.hi[k];
      const double m = v == 0.0 ? HUGE_VAL : std::fabs(v);
      e.tiny = m < e.tiny ? m : e.tiny;
    }
  }
  e.finite = check == 0.0;
  return e;
}

Extent extent_of(const double* xy, std::size_t n, Job& job) {
  const Parts parts(n, job);
  std::vector<Extent> found(parts.count());
  job.run(parts.count(),
          [&](std::size_t i) { found[i] = extent_of(xy, parts.begin(i), parts.end(i)); });
  Extent all;
  for (const Extent& e : found) all.add(e);
  return all;
}

// The least exponent of a unit that all coordinates are multiples of; the search stops
// once it is `enough` or less.
int common_unit(const double* v, std::size_t n, int enough) {
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer
  int unit = kNoUnit;
  double inverse = 0.0, limit = 0.0;
  for (std::size_t i = 0; i < n && unit > enough; ++i) {
    // Testing against the unit found so far is cheap, and true for nearly all.
    const double q = v[i] * inverse;
    if (std::fabs(q) < limit && (q + kRound) - kRound == q) continue;
    const int found = unit_exponent(v[i]);
    if (found >= unit) continue;
    unit = found;
    if (std::abs(unit) < 1000) {
      inverse = std::ldexp(1.0, -unit);
      limit = 0x1p51;
    } else {
      limit = 0.0;
    }
  }
  return unit;
}

int common_unit(const double* xy, std::size_t n, int enough, Job& job) {
  const Parts parts(n, job);
  std::vector<int> found(parts.count());
  job.run(parts.count(), [&](std::size_t i) {
    const std::size_t begin = parts.begin(i);
    found[i] = common_unit(xy + 2 * begin, 2 * (parts.end(i) - begin), enough);
  });
  return *std::min_element(found.begin(), found.end());
}

struct Range {
  int exponent = 0;    // of the power of two that brings the cloud into range
  int unit = kNoUnit;  // exponent of the lattice, if there is one
};

Range range_of(const double* xy, std::size_t n, const Extent& extent, Job& job) {
  Range range;
  if (!extent.finite) throw BadCoordinates("a coordinate is NaN or infinite");
  const double magnitude = extent.magnitude();
  if (magnitude == 0.0) return range;
  const int top = std::ilogb(magnitude) + 1;
  const int lattice_limit = top - kLatticeBits;  // finer than this, it would not help
  const int unit = common_unit(xy, n, lattice_limit, job);
  if (unit > lattice_limit) range.unit = unit;
  // A lower bound of the last bit; the last bit itself only where the bound is too low.
  int bottom = unit > lattice_limit ? unit : std::ilogb(extent.tiny) - kMantissa;
  if (top > kTop || bottom < kBottom) {
    const int least = top - (kTop - kBottom);
    if (bottom < least) bottom = common_unit(xy, n, least - 1, job);
    if (bottom < least) throw BadCoordinates("the range of exponents is too wide");
    if (top > kTop || bottom < kBottom) range.exponent = kTop - top;
  }
  return range;
}

std::uint32_t spread_bits(std::uint32_t v) {  // 16 bits to the even places
  v = (v | (v << 8)) & 0x00ff00ffu;
  v = (v | (v << 4)) & 0x0f0f0f0fu;
  v = (v | (v << 2)) & 0x33333333u;
  return (v | (v << 1)) & 0x55555555u;
}

// Maps a box to cells of a square grid with 2^bits cells along its longer side. Both
// steps are monotone, so that different cells of an axis mean different coordinates.
struct Grid {
  double x0, y0, scale;
  std::uint32_t last;

  Grid(Point2 lo, Point2 hi, int bits) : x0(lo.x), y0(lo.y), last((1u << bits) - 1) {
    const double side = std::max(hi.x - lo.x, hi.y - lo.y);
    scale = side > 0.0 ? std::ldexp(1.0, bits) / side : 0.0;
  }
  std::uint32_t cell(double v, double v0) const {
    return std::min(last, static_cast<std::uint32_t>((v - v0) * scale));
  }
  std::uint32_t morton(Point2 p) const {
    return (spread_bits(cell(p.x, x0)) << 1) | spread_bits(cell(p.y, y0));
  }
};

struct Entry {
  std::uint32_t key;
  std::int32_t row;
  Point2 p;
};

// Points that share a coarse cell: a finer grid of their own if they are many, and
// lexicographic order within a cell of that. Ties end in the order of the rows.
void sort_run(SpatialOrder2& o, std::size_t begin, std::size_t end, std::vector<Entry>& run) {
  run.clear();
  Point2 lo = o.points[begin], hi = lo;
  for (std::size_t i = begin; i < end; ++i) {
    const Point2 p = o.points[i];
    run.push_back({0, o.row[i], p});
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
  }
  if (end - begin > 8) {
    const Grid grid(lo, hi, 16);
    for (Entry& e : run) e.key = grid.morton(e.p);
  }
  std::sort(run.begin(), run.end(), [](const Entry& a, const Entry& b) {
    if (a.key != b.key) return a.key < b.key;
    if (a.p.x != b.p.x) return a.p.x < b.p.x;
    if (a.p.y != b.p.y) return a.p.y < b.p.y;
    return a.row < b.row;
  });
  for (std::size_t i = begin; i < end; ++i) {
    const Entry& e = run[i - begin];
    o.points[i] = e.p;
    o.row[i] = e.row;
    o.key[i] |= e.key;
  }
}

// Fetches the points in sorted order and settles runs of equal keys. Returns whether
// there are duplicates. A run belongs to the part in which it begins.
bool gather(SpatialOrder2& o, const double* xy, Job& job) {
  const std::size_t n = o.size;
  const Parts parts(n, job);
  const PowerOfTwo factor(o.exponent);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      const auto row = static_cast<std::uint32_t>(o.key[i]);
      o.row[i] = static_cast<std::int32_t>(row);
      o.points[i] = {factor * xy[2 * std::size_t{row}], factor * xy[2 * std::size_t{row} + 1]};
      o.key[i] = o.key[i] >> 32 << 32;
    }
  });
  std::vector<std::size_t> start(parts.count() + 1, n);  // parts begin where a run begins
  for (std::size_t part = 0; part < parts.count(); ++part) {
    std::size_t i = parts.begin(part);
    while (i > 0 && i < n && o.key[i] == o.key[i - 1]) ++i;
    start[part] = i;
  }
  std::atomic<bool> duplicates{false};
  job.run(parts.count(), [&](std::size_t part) {
    std::vector<Entry> run;
    bool found = false;
    for (std::size_t i = start[part], j; i < start[part + 1]; i = j) {
      j = i + 1;
      while (j < start[part + 1] && o.key[j] == o.key[i]) ++j;
      if (j > i + 1) {
        sort_run(o, i, j, run);
        for (std::size_t k = i + 1; k < j; ++k) found = found || o.points[k] == o.points[k - 1];
      }
    }
    if (found) duplicates.store(true);
  });
  return duplicates.load();
}

void merge_duplicates(SpatialOrder2& o) {
  const std::size_t n = o.size;
  o.representative = Buffer<std::int32_t>(n);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (kept == 0 || !(o.points[i] == o.points[kept - 1])) {
      o.points[kept] = o.points[i];
      o.row[kept] = o.row[i];
      o.key[kept] = o.key[i];
      ++kept;
    }
    o.representative[static_cast<std::size_t>(o.row[i])] = o.row[kept - 1];
  }
  o.size = kept;
}

}  // namespace

int range_exponent2(const double* xy, std::size_t n, Job& job) {
  const Extent extent = extent_of(xy, 0, n);
  const double magnitude = extent.magnitude();
  if (extent.finite && magnitude < 0x1p250 && extent.tiny >= 0x1p-188) return 0;
  return range_of(xy, n, extent, job).exponent;
}

SpatialOrder2 spatial_order2(const double* xy, std::size_t n, Job& job) {
  SpatialOrder2 o;
  o.size = n;
  if (n == 0) return o;
  const Extent extent = extent_of(xy, n, job);
  const Range range = range_of(xy, n, extent, job);
  o.exponent = range.exponent;
  if (range.unit != kNoUnit) o.lattice = Lattice(std::ldexp(1.0, range.unit + range.exponent));

  int bits = 4;  // cells of the coarse grid: about 64 a point on a uniform cloud
  while (bits < 16 && (std::size_t{1} << (2 * (bits - 3))) < n) ++bits;
  const PowerOfTwo factor(o.exponent);
  const Grid grid({factor * extent.lo[0], factor * extent.lo[1]},
                  {factor * extent.hi[0], factor * extent.hi[1]}, bits);
  o.key = Buffer<std::uint64_t>(n);
  const Parts parts(n, job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      const Point2 p{factor * xy[2 * i], factor * xy[2 * i + 1]};
      o.key[i] = (std::uint64_t{grid.morton(p)} << 32) | i;
    }
  });
  radix_sort(o.key, 2 * bits, job);
  o.points = Buffer<Point2>(n);
  o.row = Buffer<std::int32_t>(n);
  if (gather(o, xy, job)) merge_duplicates(o);
  return o;
}

}  // namespace alphamesh
