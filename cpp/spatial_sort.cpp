#include "spatial_sort.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <vector>

#include "common_unit.hpp"
#include "radix_sort.hpp"

namespace alphamesh {
namespace {

constexpr int kLatticeBits = 40;

template <class S>
struct Extent {
  double lo[S::kDim], hi[S::kDim];
  double tiny = HUGE_VAL;  // least nonzero magnitude
  bool finite = true;

  Extent() {
    std::fill(lo, lo + S::kDim, HUGE_VAL);
    std::fill(hi, hi + S::kDim, -HUGE_VAL);
  }
  void add(const Extent& o) {
    for (int k = 0; k < S::kDim; ++k) {
      lo[k] = std::min(lo[k], o.lo[k]);
      hi[k] = std::max(hi[k], o.hi[k]);
    }
    tiny = std::min(tiny, o.tiny);
    finite = finite && o.finite;
  }
  double magnitude() const {
    double m = 0.0;
    for (int k = 0; k < S::kDim; ++k) m = std::max(m, std::max(-lo[k], hi[k]));
    return m;
  }
};

template <class S>
Extent<S> extent_of(const double* xy, std::size_t begin, std::size_t end) {
  Extent<S> e;
  double check = 0.0;  // becomes NaN once a coordinate is NaN or infinite
  for (std::size_t i = begin; i < end; ++i) {
    for (std::size_t k = 0; k < S::kDim; ++k) {
      const double v = xy[S::kDim * i + k];
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

template <class S>
Extent<S> extent_of(const double* xy, std::size_t n, Job& job) {
  const Parts parts(n, job);
  std::vector<Extent<S>> found(parts.count());
  job.run(parts.count(),
          [&](std::size_t i) { found[i] = extent_of<S>(xy, parts.begin(i), parts.end(i)); });
  Extent<S> all;
  for (const Extent<S>& e : found) all.add(e);
  return all;
}

struct Range {
  int exponent = 0;    // of the power of two that brings the cloud into range
  int unit = kNoUnit;  // exponent of the lattice, if there is one
};

constexpr int kNothing = std::numeric_limits<int>::min();  // the top of zeros

int half_up(int e) { return e == kNothing ? e : (e + (e & 1)) / 2; }
int half_down(int e) { return e == kNoUnit ? e : (e - (e & 1)) / 2; }

// Weights, if there are any, by the exponents of their roots.
struct Weights {
  const double* v = nullptr;
  std::size_t n = 0;
  int top = kNothing;
  double tiny = HUGE_VAL;  // least nonzero magnitude

  Weights() = default;
  Weights(const double* weight, std::size_t count) : v(weight), n(weight == nullptr ? 0 : count) {
    double check = 0.0, most = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      check += v[i] - v[i];
      const double m = std::fabs(v[i]), some = v[i] == 0.0 ? HUGE_VAL : m;
      most = m > most ? m : most;
      tiny = some < tiny ? some : tiny;
    }
    if (check != 0.0) throw BadCoordinates("a weight is NaN or infinite");
    if (most > 0.0) top = half_up(std::ilogb(most) + 1);
  }
  int unit(int enough, Job& job) const {
    return n == 0 ? kNoUnit : half_down(common_unit(v, n, 2 * enough, job));
  }
  int bottom() const {  // a lower bound
    return tiny == HUGE_VAL ? kNoUnit : half_down(std::ilogb(tiny) - kMantissa);
  }
};

template <class S>
Range range_of(const double* v, std::size_t n, const Extent<S>& extent, Job& job,
               const Weights& weights = {}) {
  Range range;
  if (!extent.finite) throw BadCoordinates("a coordinate is NaN or infinite");
  const double magnitude = extent.magnitude();
  const int top = std::max(magnitude == 0.0 ? kNothing : std::ilogb(magnitude) + 1, weights.top);
  if (top == kNothing) return range;
  const int highest = weights.n == 0 ? S::kTop : S::kWeightedTop;
  const int lowest = weights.n == 0 ? S::kBottom : S::kWeightedBottom;
  const std::size_t count = S::kDim * n;
  auto unit_of_all = [&](int enough) {
    const int unit = common_unit(v, count, enough, job);
    return unit <= enough ? unit : std::min(unit, weights.unit(enough, job));
  };
  const int lattice_limit = top - kLatticeBits;  // finer than this, it would not help
  const int unit = unit_of_all(lattice_limit);
  if (unit > lattice_limit) range.unit = unit;
  // A lower bound of the last bit; the last bit itself only where the bound is too low.
  int bottom = unit;
  if (unit <= lattice_limit) {
    bottom = magnitude == 0.0 ? kNoUnit : std::ilogb(extent.tiny) - kMantissa;
    bottom = std::min(bottom, weights.bottom());
  }
  if (top > highest || bottom < lowest) {
    const int least = top - (highest - lowest);
    if (bottom < least) bottom = unit_of_all(least - 1);
    if (bottom < least) throw BadCoordinates("the range of exponents is too wide");
    if (top > highest || bottom < lowest) range.exponent = highest - top;
  }
  return range;
}

std::uint32_t spread_bits(std::uint32_t v) {  // 16 bits to the even places
  v = (v | (v << 8)) & 0x00ff00ffu;
  v = (v | (v << 4)) & 0x0f0f0f0fu;
  v = (v | (v << 2)) & 0x33333333u;
  return (v | (v << 1)) & 0x55555555u;
}

// Maps a box to cells of a cubic grid with 2^bits cells along its longest side. Both steps
// are monotone, so that different cells of an axis mean different coordinates.
template <class S>
struct Grid {
  double origin[S::kDim];
  double scale;
  int bits;

  Grid(const double* lo, const double* hi, int b) : bits(b) {
    double side = 0.0;
    for (int k = 0; k < S::kDim; ++k) {
      origin[k] = lo[k];
      side = std::max(side, hi[k] - lo[k]);
    }
    scale = side > 0.0 ? std::ldexp(1.0, bits) / side : 0.0;
  }
  std::uint32_t code(const double* v) const {
    std::uint32_t cell[S::kDim];
    const std::uint32_t last = (1u << bits) - 1;
    for (int k = 0; k < S::kDim; ++k) {
      cell[k] = std::min(last, static_cast<std::uint32_t>((v[k] - origin[k]) * scale));
    }
    return S::code(cell, bits);
  }
};

template <class S>
struct Entry {
  std::uint32_t key;
  std::int32_t row;
  typename S::Point p;
};

// Points that share a coarse cell: a finer grid of their own if they are many, and
// lexicographic order within a cell of that. Ties end in the order of the weights, the
// heaviest first, and then of the rows.
template <class S>
void sort_run(SpatialOrder<S>& o, std::size_t begin, std::size_t end, const double* weight,
              std::vector<Entry<S>>& run) {
  run.clear();
  Extent<S> box;
  for (std::size_t i = begin; i < end; ++i) {
    run.push_back({0, o.row[i], o.points[i]});
    box.add(extent_of<S>(&o.points[i].x, 0, 1));
  }
  if (end - begin > 8) {
    const Grid<S> grid(box.lo, box.hi, S::kBits);
    for (Entry<S>& e : run) e.key = grid.code(&e.p.x);
  }
  std::sort(run.begin(), run.end(), [weight](const Entry<S>& a, const Entry<S>& b) {
    if (a.key != b.key) return a.key < b.key;
    if (!(a.p == b.p)) return a.p < b.p;
    if (weight != nullptr && weight[a.row] != weight[b.row]) return weight[a.row] > weight[b.row];
    return a.row < b.row;
  });
  for (std::size_t i = begin; i < end; ++i) {
    const Entry<S>& e = run[i - begin];
    o.points[i] = e.p;
    o.row[i] = e.row;
    o.key[i] |= e.key;
  }
}

// Fetches the points in sorted order and settles runs of equal keys. Returns whether
// there are duplicates. A run belongs to the part in which it begins.
template <class S>
bool gather(SpatialOrder<S>& o, const double* v, const double* weight, Job& job) {
  const std::size_t n = o.size;
  const Parts parts(n, job);
  const PowerOfTwo factor(o.exponent);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      const auto row = static_cast<std::uint32_t>(o.key[i]);
      double scaled[S::kDim];
      for (std::size_t k = 0; k < S::kDim; ++k)
        scaled[k] = factor * v[S::kDim * std::size_t{row} + k];
      o.row[i] = static_cast<std::int32_t>(row);
      o.points[i] = S::point(scaled);
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
    std::vector<Entry<S>> run;
    bool found = false;
    for (std::size_t i = start[part], j; i < start[part + 1]; i = j) {
      j = i + 1;
      while (j < start[part + 1] && o.key[j] == o.key[i]) ++j;
      if (j > i + 1) {
        sort_run(o, i, j, weight, run);
        for (std::size_t k = i + 1; k < j; ++k) found = found || o.points[k] == o.points[k - 1];
      }
    }
    if (found) duplicates.store(true);
  });
  return duplicates.load();
}

template <class S>
void merge_duplicates(SpatialOrder<S>& o) {
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

std::uint32_t Plane::code(const std::uint32_t* cell, int /*bits*/) {
  return (spread_bits(cell[0]) << 1) | spread_bits(cell[1]);
}

// J. Skilling, Programming the Hilbert curve, AIP Conference Proceedings 707 (2004).
std::uint32_t Space::code(const std::uint32_t* cell, int bits) {
  std::uint32_t x[3] = {cell[0], cell[1], cell[2]};
  const std::uint32_t top = 1u << (bits - 1);
  for (std::uint32_t q = top; q > 1; q >>= 1) {
    const std::uint32_t p = q - 1;
    for (auto& axis : x) {
      const std::uint32_t swap = (x[0] ^ axis) & p;
      const bool invert = (axis & q) != 0;
      x[0] ^= invert ? p : swap;
      axis ^= invert ? 0u : swap;
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t t = 0;
  for (std::uint32_t q = top; q > 1; q >>= 1) {
    if ((x[2] & q) != 0) t ^= q - 1;
  }
  std::uint32_t code = 0;
  for (int b = bits - 1; b >= 0; --b) {
    for (const std::uint32_t axis : x) code = (code << 1) | (((axis ^ t) >> b) & 1u);
  }
  return code;
}

template <class S>
int range_exponent(const double* v, std::size_t n, Job& job) {
  const Extent<S> extent = extent_of<S>(v, 0, n);
  const bool usual = extent.finite && extent.magnitude() < std::ldexp(1.0, S::kTop);
  if (usual && extent.tiny >= std::ldexp(1.0, S::kBottom + kMantissa)) return 0;
  return range_of<S>(v, n, extent, job).exponent;
}

namespace {

template <class S>
SpatialOrder<S> build(const double* v, std::size_t n, const double* weight, Job& job) {
  SpatialOrder<S> o;
  o.size = n;
  if (n == 0) return o;
  const Extent<S> extent = extent_of<S>(v, n, job);
  const Range range = range_of<S>(v, n, extent, job, Weights(weight, n));
  o.exponent = range.exponent;
  if (range.unit != kNoUnit) {
    o.lattice = typename S::Ties(std::ldexp(1.0, range.unit + range.exponent));
  }
  int bits = 4;  // cells of the coarse grid: 64 or more a point on a uniform cloud
  while (bits < S::kBits && (std::size_t{1} << (S::kDim * (bits - 3))) < n) ++bits;
  const PowerOfTwo factor(o.exponent);
  double lo[S::kDim], hi[S::kDim];
  for (int k = 0; k < S::kDim; ++k) {
    lo[k] = factor * extent.lo[k];
    hi[k] = factor * extent.hi[k];
  }
  const Grid<S> grid(lo, hi, bits);
  o.key = Buffer<std::uint64_t>(n);
  const Parts parts(n, job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      double scaled[S::kDim];
      for (std::size_t k = 0; k < S::kDim; ++k) scaled[k] = factor * v[S::kDim * i + k];
      o.key[i] = (std::uint64_t{grid.code(scaled)} << 32) | i;
    }
  });
  radix_sort(o.key, S::kDim * bits, job);
  o.points = Buffer<typename S::Point>(n);
  o.row = Buffer<std::int32_t>(n);
  if (gather(o, v, weight, job)) merge_duplicates(o);
  if (weight != nullptr) {
    o.weight = Buffer<double>(o.size);
    const Parts kept(o.size, job);
    job.run(kept.count(), [&](std::size_t part) {
      for (std::size_t i = kept.begin(part); i < kept.end(part); ++i) {
        o.weight[i] = factor * (factor * weight[o.row[i]]);
      }
    });
  }
  return o;
}

}  // namespace

template <class S>
SpatialOrder<S> spatial_order(const double* v, std::size_t n, Job& job, const double* weight) {
  return build<S>(v, n, weight, job);
}

template SpatialOrder<Plane> spatial_order<Plane>(const double*, std::size_t, Job&, const double*);
template SpatialOrder<Space> spatial_order<Space>(const double*, std::size_t, Job&, const double*);
template int range_exponent<Plane>(const double*, std::size_t, Job&);
template int range_exponent<Space>(const double*, std::size_t, Job&);

}  // namespace alphamesh
