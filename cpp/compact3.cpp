#include "compact3.hpp"

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

namespace alphamesh {
namespace {

using Id = std::int32_t;

std::size_t place(Id i) { return static_cast<std::size_t>(i); }

bool is_real(const Tetrahedron& t, Id infinity) {
  return (t.vertex[0] >= 0) & (t.vertex[0] != infinity) & (t.vertex[1] != infinity) &
         (t.vertex[2] != infinity) & (t.vertex[3] != infinity);
}

Id first_vertex(const Tetrahedron& t) {
  return std::min(std::min(t.vertex[0], t.vertex[1]), std::min(t.vertex[2], t.vertex[3]));
}

// A tetrahedron among those with the same first vertex: its other vertices, ascending.
struct Rest {
  std::uint64_t second_third;
  Id fourth, slot;

  Rest(const Tetrahedron& t, Id s) : slot(s) {
    Id v[4] = {t.vertex[0], t.vertex[1], t.vertex[2], t.vertex[3]};
    auto settle = [&](int i, int j) {
      const Id low = std::min(v[i], v[j]), high = std::max(v[i], v[j]);
      v[i] = low;
      v[j] = high;
    };
    settle(0, 1);
    settle(2, 3);
    settle(0, 2);
    settle(1, 3);
    settle(1, 2);
    second_third =
        (std::uint64_t{static_cast<std::uint32_t>(v[1])} << 32) | static_cast<std::uint32_t>(v[2]);
    fourth = v[3];
  }
  bool operator<(const Rest& o) const {
    return second_third != o.second_third ? second_third < o.second_third : fourth < o.fourth;
  }
};

// How many of four points come before each of them, without a branch on their order.
template <class T, class Less>
void count_smaller(const T* v, int* rank, Less&& less) {
  const int ab = less(v[0], v[1]), ac = less(v[0], v[2]), ad = less(v[0], v[3]);
  const int bc = less(v[1], v[2]), bd = less(v[1], v[3]), cd = less(v[2], v[3]);
  rank[0] = 3 - ab - ac - ad;
  rank[1] = 2 + ab - bc - bd;
  rank[2] = 1 + ac + bc - cd;
  rank[3] = ad + bd + cd;
}

void lexicographic_ranks(const Point3* p, const Id* vertex, int* rank) {
  const Point3 v[4] = {p[vertex[0]], p[vertex[1]], p[vertex[2]], p[vertex[3]]};
  const bool tie = (v[0].x == v[1].x) | (v[0].x == v[2].x) | (v[0].x == v[3].x) |
                   (v[1].x == v[2].x) | (v[1].x == v[3].x) | (v[2].x == v[3].x);
  if (!tie) {
    count_smaller(v, rank, [](const Point3& a, const Point3& b) { return a.x < b.x; });
  } else {
    count_smaller(v, rank, [](const Point3& a, const Point3& b) {
      return (a.x < b.x) | ((a.x == b.x) & ((a.y < b.y) | ((a.y == b.y) & (a.z < b.z))));
    });
  }
}

// What becomes of a tetrahedron's vertices, and which of them faces a neighbour.
enum class Form {
  kFacets,  // numbers along the curve, in lexicographic order; neighbours as 4t + i
  kRows     // rows of the input, ascending; neighbours as t
};

template <Form kForm>
class Compactor {
 public:
  Compactor(const SpatialOrder3& order, Mesh3&& mesh, Job& job)
      : p_(order.points.data()),
        row_(order.row.data()),
        n_(order.size),
        mesh_(std::move(mesh)),
        job_(job),
        slots_(mesh_.slots, job) {}
  Compact3 run();

 private:
  void count();
  void add_up();
  void distribute();
  void settle(std::size_t lo, std::size_t hi);
  void write(std::size_t t, Id slot);
  void connect();

  const Point3* p_;
  const Id* row_;
  std::size_t n_;
  Mesh3 mesh_;
  Job& job_;
  Parts slots_;
  std::vector<std::atomic<Id>> start_;  // per vertex: how many have it, later a lower one, first
  Buffer<Id> id_;                       // per slot: rank in its bucket, then its row; -1: none
  Buffer<Id> slot_;                     // slots by first vertex
  Buffer<std::uint8_t> moved_;          // per slot: where its vertices have gone, two bits each
  Compact3 out_;
};

// Counts the tetrahedra by their first vertices, in whatever order they come.
template <Form kForm>
void Compactor<kForm>::count() {
  start_ = std::vector<std::atomic<Id>>(n_ + 1);
  id_ = Buffer<Id>(mesh_.slots);
  for (std::atomic<Id>& bucket : start_) bucket.store(0, std::memory_order_relaxed);
  const bool alone = job_.threads() == 1;
  job_.run(slots_.count(), [&](std::size_t part) {
    for (std::size_t s = slots_.begin(part); s < slots_.end(part); ++s) {
      const Tetrahedron& t = mesh_.slot[s];
      if (!is_real(t, mesh_.infinity)) {
        id_[s] = -1;
        continue;
      }
      std::atomic<Id>& bucket = start_[place(first_vertex(t))];
      if (alone) {
        id_[s] = bucket.load(std::memory_order_relaxed);
        bucket.store(id_[s] + 1, std::memory_order_relaxed);
      } else {
        id_[s] = bucket.fetch_add(1, std::memory_order_relaxed);
      }
    }
  });
}

// Turns counts into the beginnings of buckets.
template <Form kForm>
void Compactor<kForm>::add_up() {
  Id sum = 0;
  for (std::size_t v = 0; v <= n_; ++v) {
    const Id here = start_[v].load(std::memory_order_relaxed);
    start_[v].store(sum, std::memory_order_relaxed);
    sum += here;
  }
  out_.count = place(sum);
}

template <Form kForm>
void Compactor<kForm>::distribute() {
  slot_ = Buffer<Id>(out_.count);
  job_.run(slots_.count(), [&](std::size_t part) {
    for (std::size_t s = slots_.begin(part); s < slots_.end(part); ++s) {
      if (id_[s] < 0) continue;
      const std::atomic<Id>& bucket = start_[place(first_vertex(mesh_.slot[s]))];
      slot_[place(bucket.load(std::memory_order_relaxed) + id_[s])] = static_cast<Id>(s);
    }
  });
}

// Sorts the tetrahedra of some first vertices and writes them, their neighbours as slots
// still.
template <Form kForm>
void Compactor<kForm>::settle(std::size_t lo, std::size_t hi) {
  constexpr std::size_t kAhead = 24;
  std::vector<Rest> bucket;
  for (std::size_t v = lo; v < hi; ++v) {
    const std::size_t begin = place(start_[v].load(std::memory_order_relaxed));
    const std::size_t end = place(start_[v + 1].load(std::memory_order_relaxed));
    bucket.clear();
    for (std::size_t t = begin; t < end; ++t) {
      prefetch(&mesh_.slot[place(slot_[std::min(t + kAhead, out_.count - 1)])]);
      bucket.emplace_back(mesh_.slot[place(slot_[t])], slot_[t]);
    }
    std::sort(bucket.begin(), bucket.end());
    std::size_t t = begin;
    for (const Rest& r : bucket) write(t++, r.slot);
  }
}

template <Form kForm>
void Compactor<kForm>::write(std::size_t t, Id slot) {
  const Tetrahedron& from = mesh_.slot[place(slot)];
  int rank[4];
  if (kForm == Form::kFacets) {
    lexicographic_ranks(p_, from.vertex, rank);
    moved_[place(slot)] =
        static_cast<std::uint8_t>(rank[0] | (rank[1] << 2) | (rank[2] << 4) | (rank[3] << 6));
  }
  Id v[4];
  std::copy(from.vertex, from.vertex + 4, v);
  if (kForm == Form::kRows) {
    for (Id& vertex : v) vertex = row_[vertex];
    count_smaller(v, rank, [](Id a, Id b) { return a < b; });
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t to = 4 * t + static_cast<std::size_t>(rank[k]);
    out_.vertex[to] = v[k];
    out_.neighbor[to] = from.neighbor[k];
  }
  id_[place(slot)] = static_cast<Id>(t);
}

// Turns slots into rows.
template <Form kForm>
void Compactor<kForm>::connect() {
  const Parts rows(out_.count, job_);
  job_.run(rows.count(), [&](std::size_t part) {
    for (std::size_t i = 4 * rows.begin(part); i < 4 * rows.end(part); ++i) {
      const Id code = out_.neighbor[i], row = id_[place(code >> 2)];
      if (kForm == Form::kRows) {
        out_.neighbor[i] = row;
        continue;
      }
      const int position = (moved_[place(code >> 2)] >> (2 * (code & 3))) & 3;
      out_.neighbor[i] = row < 0 ? -1 : 4 * row + position;
    }
  });
}

template <Form kForm>
Compact3 Compactor<kForm>::run() {
  count();
  add_up();
  distribute();
  if (kForm == Form::kFacets) moved_ = Buffer<std::uint8_t>(mesh_.slots);
  out_.vertex = Buffer<Id>(4 * out_.count);
  out_.neighbor = Buffer<Id>(4 * out_.count);
  const Parts vertices(n_, job_, 1024);
  job_.run(vertices.count(),
           [&](std::size_t part) { settle(vertices.begin(part), vertices.end(part)); });
  slot_ = Buffer<Id>();
  mesh_.slot = Buffer<Tetrahedron>();
  connect();
  return std::move(out_);
}

}  // namespace

Compact3 compact3(const SpatialOrder3& order, Mesh3&& mesh, Job& job) {
  if (mesh.slots == 0) return {};
  return Compactor<Form::kFacets>(order, std::move(mesh), job).run();
}

Compact3 rows3(const SpatialOrder3& order, Mesh3&& mesh, Job& job) {
  if (mesh.slots == 0) return {};
  return Compactor<Form::kRows>(order, std::move(mesh), job).run();
}

}  // namespace alphamesh
