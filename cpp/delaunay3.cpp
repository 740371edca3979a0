#include "delaunay3.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "rounds3.hpp"
#include "worker3.hpp"

namespace alphamesh {
namespace {

using Id = std::int32_t;

// One tetrahedron and a ghost on each of its facets.
template <class Cloud>
void make_first(Store<Cloud>& store, Worker<Cloud>& worker, const std::vector<Id>& v) {
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
    const typename Cloud::Point p = store.cloud.point(row.vertex[0]);
    typename Cloud::Arm arm[3];
    for (int k = 0; k < 3; ++k) {
      const Id u = row.vertex[k + 1];
      arm[k] = u == store.infinity ? Cloud::infinite_arm(u) : store.cloud.arm(u, p);
    }
    store.sphere[static_cast<std::size_t>(t)] = sphere_of(p, arm[0], arm[1], arm[2]);
  }
  worker.start_at(made[4]);
}

template <class Cloud>
class Insertion {
 public:
  Insertion(Store<Cloud>& store, Job& job, std::vector<Id> done)
      : store_(store), job_(job), done_(std::move(done)), n_(store.infinity) {
    for (int i = 0; i < job.threads(); ++i)
      workers_.push_back(std::make_unique<Worker<Cloud>>(store));
  }
  Worker<Cloud>& first() { return *workers_[0]; }
  void run_round(const Id* begin, const Id* end);

 private:
  void run_parallel(const Id* begin, const Id* end, std::vector<Id>& later);
  void insert_all(const Id* begin, const Id* end);
  bool skip(Id i) const { return std::find(done_.begin(), done_.end(), i) != done_.end(); }

  Store<Cloud>& store_;
  Job& job_;
  std::vector<Id> done_;
  Id n_;
  std::vector<std::unique_ptr<Worker<Cloud>>> workers_;
};

template <class Cloud>
void Insertion<Cloud>::insert_all(const Id* begin, const Id* end) {
  Worker<Cloud>& worker = first();
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

template <class Cloud>
void Insertion<Cloud>::run_parallel(const Id* begin, const Id* end, std::vector<Id>& later) {
  const auto count = static_cast<std::size_t>(job_.threads());
  auto bound = [&](std::size_t k) {
    return static_cast<Id>(static_cast<std::size_t>(n_) * k / count);
  };
  std::vector<char> ready(count);
  job_.run(count, [&](std::size_t k) {  // looks at all tetrahedra, so while nothing changes
    workers_[k]->take_range(bound(k), bound(k + 1));
    ready[k] = workers_[k]->has_start();
  });
  std::vector<std::vector<Id>> left(count);
  job_.run(count, [&](std::size_t k) {
    Worker<Cloud>& worker = *workers_[k];
    const Id* from = std::lower_bound(begin, end, bound(k));
    const Id* to = std::lower_bound(begin, end, bound(k + 1));
    for (const Id* i = from; i < to; ++i) {
      if (((i - from) & 0x3ff) == 0) job_.poll();
      if (skip(*i)) continue;
      if (!ready[k] || worker.out_of_room() || !worker.insert(*i)) left[k].push_back(*i);
    }
  });
  for (const auto& l : left) later.insert(later.end(), l.begin(), l.end());
}

template <class Cloud>
void Insertion<Cloud>::run_round(const Id* begin, const Id* end) {
  constexpr auto kWorthwhile = static_cast<std::ptrdiff_t>(worthwhile(4000));  // points a thread
  if (job_.threads() > 1 && end - begin > kWorthwhile * job_.threads()) {
    std::vector<Id> later;
    run_parallel(begin, end, later);
    insert_all(later.data(), later.data() + later.size());
  } else {
    insert_all(begin, end);
  }
  job_.advance(0.6 * static_cast<double>(end - begin) / static_cast<double>(n_));
}

template <class Cloud>
Mesh3 triangulate(const SpatialOrder3& order, const std::vector<Id>& span, Job& job) {
  Mesh3 mesh;
  Store<Cloud> store(order);
  mesh.infinity = store.infinity;
  const Rounds rounds = plan_rounds(order.size);
  // Ample for nearly all clouds; what is never touched costs nothing.
  store.reserve(8 * order.size + 8192 * (static_cast<std::size_t>(job.threads()) + 1));
  Insertion<Cloud> insertion(store, job, span);
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

}  // namespace

Mesh3 delaunay3(const SpatialOrder3& order, const std::vector<Id>& span, Job& job) {
  return triangulate<PlainCloud3>(order, span, job);
}

Mesh3 regular3(const SpatialOrder3& order, const std::vector<Id>& span, Job& job) {
  return triangulate<WeightedCloud3>(order, span, job);
}

}  // namespace alphamesh
