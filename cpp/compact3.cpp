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

class Compactor {
 public:
  Compactor(const SpatialOrder3& order, Mesh3&& mesh, Job& job)
      : p_(order.points.data()), n_(order.size), mesh_(std::move(mesh)), job_(job) {
    while (((n_ - 1) >> shift_) >= kParts) ++shift_;
  }
  Compact3 run();

 private:
  static constexpr std::size_t kParts = 64;

  void chain();
  void settle(std::size_t part, std::vector<Rest>& bucket);
  void write(std::size_t t, Id slot);
  void connect();

  const Point3* p_;
  std::size_t n_;
  Mesh3 mesh_;
  Job& job_;
  int shift_ = 0;  // vertex v belongs to part v >> shift_
  std::size_t first_[kParts + 1] = {};
  std::vector<std::atomic<Id>> head_;  // per vertex: a slot of which it is the first one
  Buffer<Id> id_;                      // per slot: the next in the chain, then its row; -1: none
  Buffer<std::uint8_t> moved_;         // per slot: where its vertices have gone, two bits each
  Compact3 out_;
};

// Chains the tetrahedra by their first vertices, in whatever order, and counts them.
void Compactor::chain() {
  head_ = std::vector<std::atomic<Id>>(n_);
  id_ = Buffer<Id>(mesh_.slots);
  const Parts vertices(n_, job_), slots(mesh_.slots, job_);
  job_.run(vertices.count(), [&](std::size_t part) {
    for (std::size_t v = vertices.begin(part); v < vertices.end(part); ++v) {
      head_[v].store(-1, std::memory_order_relaxed);
    }
  });
  std::vector<std::size_t> count(slots.count() * kParts, 0);
  const bool alone = job_.threads() == 1;
  job_.run(slots.count(), [&](std::size_t part) {
    std::size_t mine[kParts] = {};
    for (std::size_t s = slots.begin(part); s < slots.end(part); ++s) {
      const Tetrahedron& t = mesh_.slot[s];
      if (!is_real(t, mesh_.infinity)) {
        id_[s] = -1;
        continue;
      }
      const std::size_t v = place(first_vertex(t));
      ++mine[v >> shift_];
      std::atomic<Id>& head = head_[v];
      const Id slot = static_cast<Id>(s);
      if (alone) {
        id_[s] = head.load(std::memory_order_relaxed);
        head.store(slot, std::memory_order_relaxed);
      } else {
        id_[s] = head.exchange(slot, std::memory_order_relaxed);
      }
    }
    std::copy(mine, mine + kParts, &count[part * kParts]);
  });
  for (std::size_t part = 0; part < kParts; ++part) {
    first_[part + 1] = first_[part];
    for (std::size_t k = 0; k < slots.count(); ++k) first_[part + 1] += count[k * kParts + part];
  }
}

// Numbers the tetrahedra of a part and writes them, their neighbours as slots still.
void Compactor::settle(std::size_t part, std::vector<Rest>& bucket) {
  const std::size_t lo = part << shift_, hi = std::min(n_, (part + 1) << shift_);
  std::size_t t = first_[part];
  for (std::size_t v = lo; v < hi; ++v) {
    bucket.clear();
    for (Id s = head_[v].load(std::memory_order_relaxed); s >= 0; s = id_[place(s)]) {
      bucket.emplace_back(mesh_.slot[place(s)], s);
    }
    std::sort(bucket.begin(), bucket.end());
    for (const Rest& r : bucket) write(t++, r.slot);
  }
}

void Compactor::write(std::size_t t, Id slot) {
  const Tetrahedron& from = mesh_.slot[place(slot)];
  int rank[4];
  lexicographic_ranks(p_, from.vertex, rank);
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t to = 4 * t + static_cast<std::size_t>(rank[k]);
    out_.vertex[to] = from.vertex[k];
    out_.neighbor[to] = from.neighbor[k];
  }
  id_[place(slot)] = static_cast<Id>(t);
  moved_[place(slot)] =
      static_cast<std::uint8_t>(rank[0] | (rank[1] << 2) | (rank[2] << 4) | (rank[3] << 6));
}

// Turns slots into rows.
void Compactor::connect() {
  const Parts rows(out_.count, job_);
  job_.run(rows.count(), [&](std::size_t part) {
    for (std::size_t i = 4 * rows.begin(part); i < 4 * rows.end(part); ++i) {
      const Id code = out_.neighbor[i], row = id_[place(code >> 2)];
      const int position = (moved_[place(code >> 2)] >> (2 * (code & 3))) & 3;
      out_.neighbor[i] = row < 0 ? -1 : 4 * row + position;
    }
  });
}

Compact3 Compactor::run() {
  chain();
  moved_ = Buffer<std::uint8_t>(mesh_.slots);
  out_.count = first_[kParts];
  out_.vertex = Buffer<Id>(4 * out_.count);
  out_.neighbor = Buffer<Id>(4 * out_.count);
  job_.run(kParts, [&](std::size_t part) {
    std::vector<Rest> bucket;
    settle(part, bucket);
  });
  mesh_.slot = Buffer<Tetrahedron>();
  connect();
  return std::move(out_);
}

}  // namespace

Compact3 compact3(const SpatialOrder3& order, Mesh3&& mesh, Job& job) {
  if (mesh.slots == 0) return {};
  return Compactor(order, std::move(mesh), job).run();
}

}  // namespace alphamesh
