#include "compact3.hpp"

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

namespace alphamesh {
namespace {

using Id = std::int32_t;

bool is_real(const Tetrahedron& t, Id infinity) {
  return t.vertex[0] >= 0 && t.vertex[0] != infinity && t.vertex[1] != infinity &&
         t.vertex[2] != infinity && t.vertex[3] != infinity;
}

Id first_vertex(const Tetrahedron& t) {
  return std::min(std::min(t.vertex[0], t.vertex[1]), std::min(t.vertex[2], t.vertex[3]));
}

// Slots of the tetrahedra, those with the first vertex v at start[v] ... start[v + 1].
struct Buckets {
  Buffer<Id> start, slot;
};

Buckets bucket(const Mesh3& mesh, std::size_t n, Job& job) {
  Buckets out;
  std::vector<std::atomic<Id>> count(n + 1);
  for (auto& c : count) c.store(0, std::memory_order_relaxed);
  const Parts parts(mesh.slots, job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t s = parts.begin(part); s < parts.end(part); ++s) {
      const Tetrahedron& t = mesh.slot[s];
      if (!is_real(t, mesh.infinity)) continue;
      count[static_cast<std::size_t>(first_vertex(t)) + 1].fetch_add(1, std::memory_order_relaxed);
    }
  });
  out.start = Buffer<Id>(n + 1);
  Id sum = 0;
  for (std::size_t v = 0; v <= n; ++v) {
    sum += count[v].load(std::memory_order_relaxed);
    out.start[v] = sum;
    count[v].store(sum, std::memory_order_relaxed);
  }
  out.slot = Buffer<Id>(static_cast<std::size_t>(sum));
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t s = parts.begin(part); s < parts.end(part); ++s) {
      const Tetrahedron& t = mesh.slot[s];
      if (!is_real(t, mesh.infinity)) continue;
      const auto v = static_cast<std::size_t>(first_vertex(t));
      out.slot[static_cast<std::size_t>(count[v].fetch_add(1, std::memory_order_relaxed))] =
          static_cast<Id>(s);
    }
  });
  return out;
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

// Positions in lexicographic order of the points.
void rank_vertices(const Point3* p, const Id* vertex, int* order) {
  for (int i = 0; i < 4; ++i) order[i] = i;
  auto settle = [&](int i, int j) {
    if (p[vertex[order[j]]] < p[vertex[order[i]]]) std::swap(order[i], order[j]);
  };
  settle(0, 1);
  settle(2, 3);
  settle(0, 2);
  settle(1, 3);
  settle(1, 2);
}

}  // namespace

Buffer<Tetrahedron> compact3(const SpatialOrder3& order, Mesh3&& triangulated, Job& job) {
  const Mesh3 mesh = std::move(triangulated);  // gone when this is over
  const std::size_t n = order.size;
  const Point3* p = order.points.data();
  if (mesh.slots == 0) return {};
  Buckets buckets = bucket(mesh, n, job);
  const Parts parts(n, job);
  Buffer<Id> id(mesh.slots);  // of each slot
  job.run(Parts(mesh.slots, job).count(), [&](std::size_t part) {
    const Parts slots(mesh.slots, job);
    std::fill(id.begin() + slots.begin(part), id.begin() + slots.end(part), -1);
  });
  job.run(parts.count(), [&](std::size_t part) {
    std::vector<Rest> bucket;
    for (std::size_t v = parts.begin(part); v < parts.end(part); ++v) {
      bucket.clear();
      for (Id i = buckets.start[v]; i < buckets.start[v + 1]; ++i) {
        const Id s = buckets.slot[static_cast<std::size_t>(i)];
        bucket.emplace_back(mesh.slot[static_cast<std::size_t>(s)], s);
      }
      std::sort(bucket.begin(), bucket.end());
      Id i = buckets.start[v];
      for (const Rest& r : bucket) {
        id[static_cast<std::size_t>(r.slot)] = i;
        buckets.slot[static_cast<std::size_t>(i++)] = r.slot;
      }
    }
  });
  const std::size_t count = buckets.slot.size();
  Buffer<Tetrahedron> out(count);
  Buffer<std::uint8_t> place(4 * mesh.slots);  // where each vertex of a slot has gone
  const Parts rows(count, job);
  job.run(rows.count(), [&](std::size_t part) {
    for (std::size_t t = rows.begin(part); t < rows.end(part); ++t) {
      const auto s = static_cast<std::size_t>(buckets.slot[t]);
      int order4[4];
      rank_vertices(p, mesh.slot[s].vertex, order4);
      for (int k = 0; k < 4; ++k) {
        out[t].vertex[k] = mesh.slot[s].vertex[order4[k]];
        place[4 * s + static_cast<std::size_t>(order4[k])] = static_cast<std::uint8_t>(k);
      }
    }
  });
  job.run(rows.count(), [&](std::size_t part) {
    for (std::size_t t = rows.begin(part); t < rows.end(part); ++t) {
      const auto s = static_cast<std::size_t>(buckets.slot[t]);
      for (std::size_t k = 0; k < 4; ++k) {
        const Id code = mesh.slot[s].neighbor[k], other = id[static_cast<std::size_t>(code >> 2)];
        out[t].neighbor[place[4 * s + k]] =
            other < 0 ? -1 : 4 * other + place[static_cast<std::size_t>(code)];
      }
    }
  });
  return out;
}

}  // namespace alphamesh
