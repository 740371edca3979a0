#include "regular2.hpp"

#include <algorithm>
#include <atomic>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

#include "insert2.hpp"
#include "number2.hpp"
#include "rounds3.hpp"

namespace alphamesh {
namespace {

using Id = std::int32_t;

// Three points that are not on a line, counter-clockwise; fewer if all are.
template <class S>
std::vector<Id> corners_of(const SpatialOrder<S>& order, const Job& job) {
  const auto* p = order.points.data();
  const auto n = static_cast<Id>(order.size);
  if (n < 3) return {};
  for (Id i = 2; i < n; ++i) {
    if ((i & 0xfff) == 0) job.poll();
    const int side = orient(p[0], p[1], p[i], order.lattice);
    if (side > 0) return {0, 1, i};
    if (side < 0) return {1, 0, i};
  }
  return {};
}

// The points of a line that are not hidden, in their order (Andrew's monotone chain).
template <class S>
std::vector<Id> lower_chain(const SpatialOrder<S>& order, const Job& job) {
  const auto* p = order.points.data();
  std::vector<Id> sorted(order.size), chain;
  for (std::size_t i = 0; i < order.size; ++i) sorted[i] = static_cast<Id>(i);
  std::sort(sorted.begin(), sorted.end(), [&](Id a, Id b) { return p[a] < p[b]; });
  for (const Id v : sorted) {
    if ((v & 0xfff) == 0) job.poll();
    while (chain.size() > 1 && hidden_between(p[chain[chain.size() - 2]], p[chain.back()], p[v])) {
      chain.pop_back();
    }
    chain.push_back(v);
  }
  return chain;
}

// Two ghosts to an edge, as delaunay2() makes of points on a line.
Mesh2 mesh_of_chain(const std::vector<Id>& chain) {
  Mesh2 mesh;
  if (chain.size() < 2) return mesh;
  const auto edges = static_cast<Id>(chain.size()) - 1;
  mesh.triangles = 2 * static_cast<std::size_t>(edges);
  mesh.slot = Buffer<Id>(8 * mesh.triangles);
  auto link = [&](Id h, Id g) {
    mesh.slot[h + 4] = g;
    mesh.slot[g + 4] = h;
  };
  for (Id i = 0; i < edges; ++i) {
    const Id low = 16 * i, high = low + 8;
    mesh.slot[low] = mesh.slot[high + 1] = chain[i + 1];
    mesh.slot[low + 1] = mesh.slot[high] = chain[i];
    mesh.slot[low + 2] = mesh.slot[high + 2] = Mesh2::kInfinity;
    link(low, high);
    link(low + 1, i == 0 ? high + 2 : low - 16 + 2);
    link(high + 1, i == edges - 1 ? low + 2 : high + 16 + 2);
  }
  mesh.ghost = 0;
  return mesh;
}

template <class S>
class Insertion {
 public:
  Insertion(const SpatialOrder<S>& order, std::vector<Id> corners, Job& job)
      : n_(static_cast<Id>(order.size)), corners_(std::move(corners)), job_(job) {
    slots_.p = order.points.data();
    slots_.lattice = order.lattice;
    const auto threads = static_cast<std::size_t>(job.threads());
    slots_.reserve(std::min(Slots2<S>::kMost, 2 * order.size + 4096 * (threads + 1)));
    for (std::size_t i = 0; i < threads; ++i) {
      workers_.push_back(std::make_unique<Inserter2<S>>(slots_));
    }
    workers_[0]->make_first(corners_.data());
  }
  void run_round(const Id* begin, const Id* end);
  Mesh2 finish() {
    return numbered2(std::move(slots_.m), slots_.used.load(), static_cast<std::size_t>(n_), job_);
  }

 private:
  void run_parallel(const Id* begin, const Id* end, std::vector<Id>& later);
  void insert_all(const Id* begin, const Id* end);
  void make_room();
  bool skip(Id i) const { return (i == corners_[0]) | (i == corners_[1]) | (i == corners_[2]); }

  Id n_;
  std::vector<Id> corners_;
  Job& job_;
  Slots2<S> slots_;
  std::vector<std::unique_ptr<Inserter2<S>>> workers_;
};

// For the first worker: what others left, or more. All triangles together fit into kMost.
template <class S>
void Insertion<S>::make_room() {
  bool found = false;
  for (std::size_t k = 1; k < workers_.size(); ++k) found |= workers_[0]->take_free(*workers_[k]);
  if (found) return;
  if (slots_.room() == Slots2<S>::kMost) throw std::bad_alloc();
  slots_.reserve(std::min(Slots2<S>::kMost, slots_.room() + slots_.room() / 4 + 4096));
}

template <class S>
void Insertion<S>::insert_all(const Id* begin, const Id* end) {
  Inserter2<S>& worker = *workers_[0];
  worker.take_range(0, n_);
  if (!worker.has_start()) throw std::logic_error("no triangle to start from");
  for (const Id* i = begin; i < end; ++i) {
    if (((i - begin) & 0x3ff) == 0) job_.poll();
    if (skip(*i)) continue;
    while (worker.insert(*i) != Inserted::kDone) make_room();
  }
}

template <class S>
void Insertion<S>::run_parallel(const Id* begin, const Id* end, std::vector<Id>& later) {
  const std::size_t count = workers_.size();
  std::vector<std::vector<Id>> left(count);
  auto border = [&](std::size_t k) {
    return static_cast<Id>(static_cast<std::size_t>(n_) * k / count);
  };
  std::vector<char> ready(count);
  for (std::size_t k = 0; k < count; ++k) {
    workers_[k]->take_range(border(k), border(k + 1));
    ready[k] = workers_[k]->has_start();
  }
  job_.run(count, [&](std::size_t k) {
    const Id* from = std::lower_bound(begin, end, border(k));
    const Id* to = std::lower_bound(begin, end, border(k + 1));
    bool room = ready[k] != 0;
    for (const Id* i = from; i < to; ++i) {
      if (((i - from) & 0x3ff) == 0) job_.poll();
      if (skip(*i)) continue;
      const Inserted done = room ? workers_[k]->insert(*i) : Inserted::kNotOurs;
      room = room && done != Inserted::kNoRoom;
      if (done != Inserted::kDone) left[k].push_back(*i);
    }
  });
  for (const auto& l : left) later.insert(later.end(), l.begin(), l.end());
}

template <class S>
void Insertion<S>::run_round(const Id* begin, const Id* end) {
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

template <class S>
Mesh2 regular2(const SpatialOrder<S>& order, Job& job) {
  std::vector<Id> corners = corners_of(order, job);
  if (corners.empty()) return mesh_of_chain(lower_chain(order, job));
  const Rounds rounds = plan_rounds(order.size);
  Insertion<S> insertion(order, std::move(corners), job);
  for (std::size_t r = 0; r + 1 < rounds.start.size(); ++r) {
    insertion.run_round(rounds.point.data() + rounds.start[r],
                        rounds.point.data() + rounds.start[r + 1]);
  }
  return insertion.finish();
}

template Mesh2 regular2<WeightedPlane>(const SpatialOrder<WeightedPlane>&, Job&);
template Mesh2 regular2<WeightedSheet>(const SpatialOrder<WeightedSheet>&, Job&);

template <class S>
Buffer<Role> roles_of(const SpatialOrder<S>& order, const Mesh2& mesh, std::size_t n, Job& job) {
  constexpr std::uint8_t kSeen = 1, kTaken = 2;
  const auto* p = order.points.data();
  std::vector<std::atomic<std::uint8_t>> found(order.size);
  const Parts parts(mesh.triangles, job);
  job.run(parts.count(), [&](std::size_t part) {
    for (std::size_t t = parts.begin(part); t < parts.end(part); ++t) {
      const Id* v = &mesh.slot[8 * t];
      for (int k = 0; k < 3; ++k) {  // each edge comes from either end, as ghosts take part
        const Id from = v[k], to = v[(k + 1) % 3];
        if (from < 0) continue;
        std::atomic<std::uint8_t>& known = found[from];
        std::uint8_t bits = known.load(std::memory_order_relaxed);
        if ((bits & kTaken) != 0) continue;
        const bool taken = to >= 0 && in_own_cell(p[from], p[to], order.lattice) < 0;
        const std::uint8_t more = taken ? kSeen | kTaken : kSeen;
        if ((bits & more) != more) known.fetch_or(more, std::memory_order_relaxed);
      }
    }
  });
  if (order.size == 1) found[0].store(kSeen);
  constexpr Role kRole[4] = {Role::kNone, Role::kGabriel, Role::kAttached, Role::kAttached};
  Buffer<Role> role(n);
  std::fill(role.begin(), role.end(), Role::kNone);
  const Parts points(order.size, job);
  job.run(points.count(), [&](std::size_t part) {
    for (std::size_t i = points.begin(part); i < points.end(part); ++i) {
      role[order.row[i]] = kRole[found[i].load(std::memory_order_relaxed)];
    }
  });
  return role;
}

template Buffer<Role> roles_of<WeightedPlane>(const SpatialOrder<WeightedPlane>&, const Mesh2&,
                                              std::size_t, Job&);
template Buffer<Role> roles_of<WeightedSheet>(const SpatialOrder<WeightedSheet>&, const Mesh2&,
                                              std::size_t, Job&);

template <class S>
RegularFiltration2 regular_filtration2(SpatialOrder<S>&& plain, const WeightedRows& rows,
                                       Job& job) {
  RegularFiltration2 out;
  const auto order = weighted(std::move(plain), job);
  Mesh2 mesh = regular2(order, job);
  out.simplices = filtration2(order, mesh, job);
  const Filtration2& f = out.simplices;
  const Buffer<Role> role = roles_of(order, mesh, rows.n, job);
  const EdgeView edges{f.edges.data(), f.edge_radii.data(), f.edge_radii.size()};
  VertexRows v = vertex_rows(role.data(), rows.weight, rows.representative, rows.n, edges, job);
  out.vertices = std::move(v.vertices);
  out.vertex_radii = std::move(v.radii);
  out.hidden = std::move(v.hidden);
  out.dimension = f.triangle_radii.size() != 0 ? 2 : f.edge_radii.size() != 0 ? 1 : 0;
  if (order.size == 0) out.dimension = -1;
  return out;
}

template RegularFiltration2 regular_filtration2<Plane>(SpatialOrder<Plane>&&, const WeightedRows&,
                                                       Job&);
template RegularFiltration2 regular_filtration2<Sheet>(SpatialOrder<Sheet>&&, const WeightedRows&,
                                                       Job&);

}  // namespace alphamesh
