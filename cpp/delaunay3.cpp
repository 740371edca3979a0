#include "delaunay3.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace alphamesh {
namespace {

using Id = std::int32_t;
constexpr Id kMark = static_cast<Id>(0x80000000);  // in vertex[3]: in the cavity
constexpr Id kVertex = 0x7fffffff;
// (p, facet opposite to i) is positive if the tetrahedron with p in place of i is.
constexpr int kFacet[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

// The circumsphere of a tetrahedron, as in_sphere() needs it: the sign of
// n . e - w |e|^2, e the point relative to the origin, is sure beyond b1 |e|^2 + b0.
struct alignas(64) Sphere {
  double nx, ny, nz, w, ox, oy, oz;
  std::uint32_t b0, b1;  // upper halves of doubles, rounded up
};

std::uint32_t upper_half(double v) {
  std::uint64_t bits;
  std::memcpy(&bits, &v, sizeof bits);
  return static_cast<std::uint32_t>(bits >> 32) + 1;
}

double from_upper_half(std::uint32_t half) {
  const std::uint64_t bits = std::uint64_t{half} << 32;
  double v;
  std::memcpy(&v, &bits, sizeof v);
  return v;
}

// A vertex of a cavity's border relative to the new point. The point at infinity has the
// coordinates 0, the square 1 and the length 0, which turns spheres into planes.
struct Arm {
  double x, y, z, square, length;
  Id vertex;
};

Sphere sphere_of(Point3 p, const Arm& a, const Arm& b, const Arm& c) {
  const double bx = b.y * c.z - b.z * c.y, by = b.z * c.x - b.x * c.z, bz = b.x * c.y - b.y * c.x;
  const double cx = c.y * a.z - c.z * a.y, cy = c.z * a.x - c.x * a.z, cz = c.x * a.y - c.y * a.x;
  const double ax = a.y * b.z - a.z * b.y, ay = a.z * b.x - a.x * b.z, az = a.x * b.y - a.y * b.x;
  Sphere s;
  s.nx = a.square * bx + b.square * cx + c.square * ax;
  s.ny = a.square * by + b.square * cy + c.square * ay;
  s.nz = a.square * bz + b.square * cz + c.square * az;
  s.w = a.x * bx + a.y * by + a.z * bz;
  s.ox = p.x;
  s.oy = p.y;
  s.oz = p.z;
  // The terms add up to at most sqrt(3) |a||b||c| (s |e| + |e|^2), s = |a| + |b| + |c|, and
  // for a ghost to sqrt(3) |a||b||e|; s |e| is at most (s^2 + |e|^2) / 2. Some 16 roundings.
  const double product = a.length * b.length * c.length, sum = a.length + b.length + c.length;
  if (product != 0.0) {
    s.b0 = upper_half(16.0 * kEps * product * sum * sum);
    s.b1 = upper_half(48.0 * kEps * product);
  } else {
    const double pair = a.length * b.length + b.length * c.length + c.length * a.length;
    s.b0 = upper_half(16.0 * kEps * pair * sum);
    s.b1 = upper_half(16.0 * kEps * pair / sum);
  }
  return s;
}

struct Verdict {
  double value, bound;
};

Verdict test(const Sphere& s, Point3 q) {
  const double x = q.x - s.ox, y = q.y - s.oy, z = q.z - s.oz, square = x * x + y * y + z * z;
  return {s.nx * x + s.ny * y + s.nz * z - s.w * square,
          from_upper_half(s.b1) * square + from_upper_half(s.b0)};
}

// What all workers share. In parallel, each keeps to its own tetrahedra; only the counter
// of slots is common.
struct Store {
  const Point3* p;
  Id infinity;
  Lattice3 lattice;
  double exact = 0.0;  // a bound below this means that nothing was rounded
  Buffer<Tetrahedron> slot;
  Buffer<Sphere> sphere;
  std::atomic<std::size_t> used{0};

  void reserve(std::size_t slots) {
    if (slots <= slot.size()) return;
    if (slots >= std::size_t{1} << 29) throw std::bad_alloc();
    Buffer<Tetrahedron> more(slots);
    Buffer<Sphere> spheres(slots);
    std::copy(slot.data(), slot.data() + used.load(), more.begin());
    std::copy(sphere.data(), sphere.data() + used.load(), spheres.begin());
    slot = std::move(more);
    sphere = std::move(spheres);
  }
};

// Inserts points numbered first_ ... last_ - 1.
class Worker {
 public:
  Worker(Store& store) : store_(store), local_(static_cast<std::size_t>(store.infinity) + 1) {
    std::fill(local_.begin(), local_.end(), -1);
    table_.resize(kTable * kTable);
  }

  void take_range(Id first, Id last);
  bool insert(Id point);
  bool out_of_room() const { return out_of_room_; }
  bool provide(std::size_t slots);
  Id new_slot();
  void start_at(Id t) { here_ = t; }
  bool has_start();

 private:
  struct Border {
    Id inner, outer;  // facet of the cavity, as 4t + i from either side
    Id vertex[3], local[3];
    Id made;
  };

  static constexpr std::size_t kTable = 256;
  static constexpr std::size_t kChunk = 1024;

  Tetrahedron& tet(Id t) { return store_.slot[static_cast<std::size_t>(t)]; }
  Id vertex(Id t, int i) { return tet(t).vertex[i] & kVertex; }
  bool owns(Id v) const { return (v >= first_ && v < last_) || v == store_.infinity; }
  bool owns_all(Id t) {
    const Id* v = tet(t).vertex;
    return owns(v[0]) && owns(v[1]) && owns(v[2]) && owns(v[3] & kVertex);
  }
  int infinite(Id t);
  bool conflict(Id t, Point3 q);
  bool conflict_exact(Id t, Point3 q, Verdict verdict);
  Id locate(Point3 q);
  Id locate_exactly(Id t, Point3 q);
  int way_out(Id t, Point3 q, int entry);
  bool collect(Id start, Point3 q);
  void unmark();
  void number_vertices(Point3 q);
  void fill_star(Id point, Point3 q);
  void link_by_table();
  void link_by_sorting();

  Store& store_;
  Id first_ = 0, last_ = 0;
  Id here_ = -1;
  bool out_of_room_ = false;
  std::uint32_t random_ = 12345;
  std::size_t chunk_ = 0, chunk_end_ = 0;
  std::vector<Id> free_, cavity_;
  std::vector<Border> border_;
  std::vector<Arm> arm_;
  Buffer<Id> local_;
  std::vector<Id> table_;
  std::vector<std::pair<std::uint64_t, Id>> directed_;
};

void Worker::take_range(Id first, Id last) {
  first_ = first;
  last_ = last;
  out_of_room_ = false;
}

// Stands on a tetrahedron of its own, or finds one.
bool Worker::has_start() {
  if (here_ >= 0 && tet(here_).vertex[0] >= 0 && owns_all(here_)) return true;
  const auto used = static_cast<Id>(store_.used.load());
  const Id from = static_cast<Id>(std::int64_t{used} * first_ / std::max(1, store_.infinity));
  for (Id i = 0; i < used; ++i) {
    const Id t = from + i < used ? from + i : from + i - used;
    if (tet(t).vertex[0] >= 0 && owns_all(t)) {
      here_ = t;
      return true;
    }
  }
  return false;
}

Id Worker::new_slot() {
  if (!free_.empty()) {
    const Id t = free_.back();
    free_.pop_back();
    return t;
  }
  return static_cast<Id>(chunk_++);
}

// Makes sure that so many new slots can be had.
bool Worker::provide(std::size_t slots) {
  while (free_.size() + (chunk_end_ - chunk_) < slots) {
    while (chunk_ < chunk_end_) free_.push_back(static_cast<Id>(chunk_++));
    const std::size_t begin = store_.used.fetch_add(kChunk);
    if (begin + kChunk > store_.slot.size()) {
      store_.used.fetch_sub(kChunk);
      out_of_room_ = true;
      return false;
    }
    chunk_ = begin;
    chunk_end_ = begin + kChunk;
    for (std::size_t t = begin; t < chunk_end_; ++t) store_.slot[t].vertex[0] = -1;
  }
  return true;
}

int Worker::infinite(Id t) {
  for (int i = 0; i < 4; ++i) {
    if (vertex(t, i) == store_.infinity) return i;
  }
  return -1;
}

bool Worker::conflict(Id t, Point3 q) {
  const Verdict v = test(store_.sphere[static_cast<std::size_t>(t)], q);
  if (v.value > v.bound) return true;
  if (v.value < -v.bound) return false;
  return conflict_exact(t, q, v);
}

bool Worker::conflict_exact(Id t, Point3 q, Verdict verdict) {
  const int ghost = infinite(t);
  Point3 p[4];
  for (int i = 0; i < 4; ++i) p[i] = i == ghost ? q : store_.p[vertex(t, i)];
  if (ghost >= 0) {
    const int side = orient3(p[0], p[1], p[2], p[3], store_.lattice);
    if (side != 0) return side > 0;
    // In the plane of a hull facet: inside its circle if inside the sphere behind it.
    return conflict(tet(t).neighbor[ghost] >> 2, q);
  }
  int s = 0;
  if (verdict.bound < store_.exact) {
    s = sign_of(verdict.value);
  } else {
    s = in_sphere_exact(p[0], p[1], p[2], p[3], q, store_.lattice);
  }
  return s != 0 ? s > 0 : in_sphere_perturbed(p[0], p[1], p[2], p[3], q, store_.lattice);
}

// The facet behind which q lies, by the largest distance in plain arithmetic; -1 if none.
int Worker::way_out(Id t, Point3 q, int entry) {
  Vector3<double> d[4];
  for (int i = 0; i < 4; ++i) d[i] = store_.p[vertex(t, i)] - q;
  const Vector3<double> cd = cross(d[2], d[3]), ab = cross(d[0], d[1]);
  const double side[4] = {dot(d[1], cd), -dot(d[0], cd), dot(d[3], ab), -dot(d[2], ab)};
  int best = -1;
  double farthest = 0.0;
  for (int i = 0; i < 4; ++i) {
    if (i == entry || side[i] >= 0.0) continue;
    const Vector3<double>&a = d[kFacet[i][0]], &b = d[kFacet[i][1]], &c = d[kFacet[i][2]];
    const Vector3<double> n = cross(Vector3<double>{b.x - a.x, b.y - a.y, b.z - a.z},
                                    Vector3<double>{c.x - a.x, c.y - a.y, c.z - a.z});
    const double distance_sq = side[i] * side[i] / dot(n, n);
    if (!(distance_sq <= farthest)) {
      farthest = distance_sq;
      best = i;
    }
  }
  return best;
}

// Walks to a tetrahedron whose sphere contains q; -1 if the way leaves what is ours.
Id Worker::locate(Point3 q) {
  Id t = here_;
  int entry = -1;
  for (int step = 0; step < 1000; ++step) {
    if (conflict(t, q)) return t;
    const int ghost = infinite(t);
    const int exit = ghost >= 0 ? ghost : way_out(t, q, entry);
    if (exit < 0) break;
    const Id code = tet(t).neighbor[exit];
    t = code >> 2;
    entry = code & 3;
    if (!owns_all(t)) return -1;
  }
  return locate_exactly(t, q);
}

// The same with exact signs and random turns, which always arrives.
Id Worker::locate_exactly(Id t, Point3 q) {
  while (!conflict(t, q)) {
    int exit = infinite(t);
    random_ = random_ * 1664525u + 1013904223u;
    for (int k = 0; exit < 0 && k < 4; ++k) {
      const int i = static_cast<int>((random_ >> 30) + static_cast<unsigned>(k)) & 3;
      Point3 p[4];
      for (int j = 0; j < 4; ++j) p[j] = j == i ? q : store_.p[vertex(t, j)];
      if (orient3(p[0], p[1], p[2], p[3], store_.lattice) < 0) exit = i;
    }
    t = tet(t).neighbor[exit] >> 2;
    if (!owns_all(t)) return -1;
  }
  return t;
}

// All tetrahedra whose spheres contain q, and the facets around them. False, and nothing
// changed, if one of them is not ours.
bool Worker::collect(Id start, Point3 q) {
  cavity_.clear();
  border_.clear();
  tet(start).vertex[3] |= kMark;
  cavity_.push_back(start);
  for (std::size_t k = 0; k < cavity_.size(); ++k) {
    const Id t = cavity_[k];
    for (Id i = 0; i < 4; ++i) {
      const Id code = tet(t).neighbor[i], u = code >> 2;
      if (tet(u).vertex[3] < 0) continue;
      if (!conflict(u, q)) {
        border_.push_back({4 * t + i, code, {0, 0, 0}, {0, 0, 0}, -1});
        continue;
      }
      if (!owns_all(u)) {
        unmark();
        return false;
      }
      tet(u).vertex[3] |= kMark;
      cavity_.push_back(u);
    }
  }
  return true;
}

void Worker::unmark() {
  for (const Id t : cavity_) tet(t).vertex[3] &= kVertex;
}

// Numbers the vertices of the border from 0 and sees them from q.
void Worker::number_vertices(Point3 q) {
  arm_.clear();
  for (Border& b : border_) {
    const Id t = b.inner >> 2;
    for (int k = 0; k < 3; ++k) {
      const Id v = vertex(t, kFacet[b.inner & 3][k]);
      Id& local = local_[static_cast<std::size_t>(v)];
      if (local < 0) {
        local = static_cast<Id>(arm_.size());
        arm_.push_back({0.0, 0.0, 0.0, 1.0, 0.0, v});
      }
      b.vertex[k] = v;
      b.local[k] = local;
    }
  }
  for (Arm& a : arm_) {
    local_[static_cast<std::size_t>(a.vertex)] = -1;
    if (a.vertex == store_.infinity) continue;
    const Vector3<double> d = store_.p[a.vertex] - q;
    const double square = dot(d, d);
    a = {d.x, d.y, d.z, square, std::sqrt(square), a.vertex};
  }
}

// Puts a tetrahedron on each facet of the border; the slots of the cavity come first.
void Worker::fill_star(Id point, Point3 q) {
  for (std::size_t k = 0; k < border_.size(); ++k) {
    Border& b = border_[k];
    b.made = k < cavity_.size() ? cavity_[k] : new_slot();
    tet(b.made) = {{point, b.vertex[0], b.vertex[1], b.vertex[2]}, {b.outer, -1, -1, -1}};
    tet(b.outer >> 2).neighbor[b.outer & 3] = 4 * b.made;
    store_.sphere[static_cast<std::size_t>(b.made)] = sphere_of(
        q, arm_[static_cast<std::size_t>(b.local[0])], arm_[static_cast<std::size_t>(b.local[1])],
        arm_[static_cast<std::size_t>(b.local[2])]);
  }
  for (std::size_t k = border_.size(); k < cavity_.size(); ++k) {
    tet(cavity_[k]).vertex[0] = -1;
    tet(cavity_[k]).vertex[3] = 0;
    free_.push_back(cavity_[k]);
  }
}

// Around the new point, facet i of a tetrahedron belongs to the directed edge from local
// vertex i + 1 to i + 2; the neighbour has the same edge the other way.
void Worker::link_by_table() {
  for (const Border& b : border_) {
    for (int i = 0; i < 3; ++i) {
      const auto from = static_cast<std::size_t>(b.local[(i + 1) % 3]);
      const auto to = static_cast<std::size_t>(b.local[(i + 2) % 3]);
      table_[from * kTable + to] = 4 * b.made + i + 1;
    }
  }
  for (const Border& b : border_) {
    for (int i = 0; i < 3; ++i) {
      const auto from = static_cast<std::size_t>(b.local[(i + 1) % 3]);
      const auto to = static_cast<std::size_t>(b.local[(i + 2) % 3]);
      tet(b.made).neighbor[i + 1] = table_[to * kTable + from];
    }
  }
}

void Worker::link_by_sorting() {
  directed_.clear();
  auto key = [](Id from, Id to) {
    return (std::uint64_t{static_cast<std::uint32_t>(from)} << 32) | static_cast<std::uint32_t>(to);
  };
  for (const Border& b : border_) {
    for (int i = 0; i < 3; ++i) {
      directed_.emplace_back(key(b.local[(i + 1) % 3], b.local[(i + 2) % 3]), 4 * b.made + i + 1);
    }
  }
  std::sort(directed_.begin(), directed_.end());
  for (const auto& [edge, code] : directed_) {
    const std::uint64_t reverse = edge << 32 | edge >> 32;
    const auto found =
        std::lower_bound(directed_.begin(), directed_.end(), std::make_pair(reverse, Id{0}));
    tet(code >> 2).neighbor[code & 3] = found->second;
  }
}

// False, and nothing changed, if the cavity is not all ours or room is lacking.
bool Worker::insert(Id point) {
  const Point3 q = store_.p[point];
  const Id start = locate(q);
  if (start < 0 || !collect(start, q)) return false;
  const std::size_t old = cavity_.size(), made = border_.size();
  if (made > old && !provide(made - old)) {
    unmark();
    return false;
  }
  number_vertices(q);
  fill_star(point, q);
  if (arm_.size() <= kTable) {
    link_by_table();
  } else {
    link_by_sorting();
  }
  here_ = border_[0].made;
  return true;
}

// One tetrahedron and a ghost on each of its facets.
void make_first(Store& store, Worker& worker, const std::vector<Id>& v) {
  Id made[5];
  if (!worker.provide(5)) throw std::bad_alloc();
  for (Id& t : made) t = worker.new_slot();
  auto slot = [&](Id t) -> Tetrahedron& { return store.slot[static_cast<std::size_t>(t)]; };
  for (int i = 0; i < 4; ++i) slot(made[4]).vertex[i] = v[static_cast<std::size_t>(i)];
  for (int i = 0; i < 4; ++i) {
    Tetrahedron& g = slot(made[i]);
    for (int k = 0; k < 3; ++k) g.vertex[k] = v[static_cast<std::size_t>(kFacet[i][k])];
    g.vertex[3] = store.infinity;
    g.neighbor[3] = 4 * made[4] + i;
    slot(made[4]).neighbor[i] = 4 * made[i] + 3;
  }
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 3; ++k) {  // opposite to vertex k: the ghost of the facet without it
      const int other = kFacet[i][k];
      const Id* row = slot(made[other]).vertex;
      const Id mine = v[static_cast<std::size_t>(i)];
      const int at = row[0] == mine ? 0 : (row[1] == mine ? 1 : 2);
      slot(made[i]).neighbor[k] = 4 * made[other] + at;
    }
  }
  for (const Id t : made) {
    const Tetrahedron& row = slot(t);
    const Point3 p = store.p[row.vertex[0]];
    Arm arm[3];
    for (int k = 0; k < 3; ++k) {
      const Id u = row.vertex[k + 1];
      arm[k] = {0.0, 0.0, 0.0, 1.0, 0.0, u};
      if (u == store.infinity) continue;
      const Vector3<double> d = store.p[u] - p;
      arm[k] = {d.x, d.y, d.z, dot(d, d), norm(d), u};
    }
    store.sphere[static_cast<std::size_t>(t)] = sphere_of(p, arm[0], arm[1], arm[2]);
  }
  worker.start_at(made[4]);
}

std::uint64_t scramble(std::uint64_t z) {  // splitmix64
  z += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

// Rounds of growing size, each along the curve; round k is [start[k], start[k + 1]).
struct Rounds {
  std::vector<std::size_t> start;
  Buffer<Id> point;
};

Rounds plan_rounds(std::size_t n) {
  constexpr std::uint64_t kRatio = 8;
  int most = 0;
  for (std::size_t m = n; m > 500; m /= kRatio) ++most;
  auto round_of = [&](std::size_t i) {
    std::uint64_t h = scramble(i);
    int round = most;
    while (round > 0 && h % kRatio == 0) {
      h /= kRatio;
      --round;
    }
    return static_cast<std::size_t>(round);
  };
  Rounds out;
  out.start.assign(static_cast<std::size_t>(most) + 2, 0);
  for (std::size_t i = 0; i < n; ++i) ++out.start[round_of(i) + 1];
  for (std::size_t r = 1; r < out.start.size(); ++r) out.start[r] += out.start[r - 1];
  out.point = Buffer<Id>(n);
  std::vector<std::size_t> at(out.start.begin(), out.start.end() - 1);
  for (std::size_t i = 0; i < n; ++i) out.point[at[round_of(i)]++] = static_cast<Id>(i);
  return out;
}

class Insertion {
 public:
  Insertion(Store& store, Job& job, std::vector<Id> done)
      : store_(store), job_(job), done_(std::move(done)), n_(store.infinity) {
    for (int i = 0; i < job.threads(); ++i) workers_.push_back(std::make_unique<Worker>(store));
  }
  Worker& first() { return *workers_[0]; }
  void run_round(const Id* begin, const Id* end);

 private:
  void run_parallel(const Id* begin, const Id* end, std::vector<Id>& later);
  void insert_all(const Id* begin, const Id* end);
  bool skip(Id i) const { return std::find(done_.begin(), done_.end(), i) != done_.end(); }

  Store& store_;
  Job& job_;
  std::vector<Id> done_;
  Id n_;
  std::vector<std::unique_ptr<Worker>> workers_;
};

void Insertion::insert_all(const Id* begin, const Id* end) {
  Worker& worker = first();
  worker.take_range(0, n_);
  for (const Id* i = begin; i < end; ++i) {
    if (((i - begin) & 0x3ff) == 0) job_.poll();
    if (skip(*i)) continue;
    if (!worker.has_start()) throw std::logic_error("no tetrahedron to start from");
    while (!worker.insert(*i)) {
      store_.reserve(store_.slot.size() + store_.slot.size() / 2 + 4096);
    }
  }
}

void Insertion::run_parallel(const Id* begin, const Id* end, std::vector<Id>& later) {
  const auto count = static_cast<std::size_t>(job_.threads());
  std::vector<std::vector<Id>> left(count);
  job_.run(count, [&](std::size_t k) {
    Worker& worker = *workers_[k];
    const auto lo = static_cast<Id>(static_cast<std::size_t>(n_) * k / count);
    const auto hi = static_cast<Id>(static_cast<std::size_t>(n_) * (k + 1) / count);
    worker.take_range(lo, hi);
    const Id *from = std::lower_bound(begin, end, lo), *to = std::lower_bound(begin, end, hi);
    const bool ready = worker.has_start();
    for (const Id* i = from; i < to; ++i) {
      if (((i - from) & 0x3ff) == 0) job_.poll();
      if (skip(*i)) continue;
      if (!ready || worker.out_of_room() || !worker.insert(*i)) left[k].push_back(*i);
    }
  });
  for (const auto& l : left) later.insert(later.end(), l.begin(), l.end());
}

void Insertion::run_round(const Id* begin, const Id* end) {
  constexpr std::ptrdiff_t kWorthwhile = 4000;  // points a thread
  if (job_.threads() > 1 && end - begin > kWorthwhile * job_.threads()) {
    std::vector<Id> later;
    run_parallel(begin, end, later);
    insert_all(later.data(), later.data() + later.size());
  } else {
    insert_all(begin, end);
  }
  job_.advance(0.6 * static_cast<double>(end - begin) / static_cast<double>(n_));
}

}  // namespace

Mesh3 delaunay3(const SpatialOrder3& order, const std::vector<Id>& span, Job& job) {
  Mesh3 mesh;
  mesh.infinity = static_cast<Id>(order.size);
  Store store;
  store.p = order.points.data();
  store.infinity = mesh.infinity;
  store.lattice = order.lattice;
  const double u = order.lattice.unit;
  store.exact = 16.0 * (u * u * u * u * u);
  const Rounds rounds = plan_rounds(order.size);
  // Ample for nearly all clouds; what is never touched costs nothing.
  store.reserve(8 * order.size + 8192 * (static_cast<std::size_t>(job.threads()) + 1));
  Insertion insertion(store, job, span);
  insertion.first().take_range(0, mesh.infinity);
  make_first(store, insertion.first(), span);
  for (std::size_t r = 0; r + 1 < rounds.start.size(); ++r) {
    insertion.run_round(rounds.point.data() + rounds.start[r],
                        rounds.point.data() + rounds.start[r + 1]);
  }
  mesh.slots = store.used.load();
  mesh.slot = std::move(store.slot);
  return mesh;
}

}  // namespace alphamesh
