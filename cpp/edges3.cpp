#include "edges3.hpp"

#include <algorithm>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include "predicates3.hpp"

namespace alphamesh {
namespace {

using Id = std::int32_t;

// One bit for each edge of a tetrahedron, by the positions that it has not.
constexpr std::uint8_t kAcross[4][4] = {{0, 32, 16, 8}, {32, 0, 4, 2}, {16, 4, 0, 1}, {8, 2, 1, 0}};
// By that bit: the positions of its ends, and the other two.
struct Ends {
  std::int8_t i, j, leave, keep;
};
constexpr Ends kEnds[33] = {
    {}, {0, 1, 2, 3}, {0, 2, 1, 3}, {}, {0, 3, 1, 2}, {}, {}, {}, {1, 2, 0, 3}, {}, {}, {},
    {}, {},           {},           {}, {1, 3, 0, 2}, {}, {}, {}, {},           {}, {}, {},
    {}, {},           {},           {}, {},           {}, {}, {}, {2, 3, 0, 1}};

struct Edge {
  Id ends[2];
  double value;
};

// Puts the edges of the parts one after the other as soon as their places are known, so
// that few wait, and none twice.
class Places {
 public:
  // `most`: no less than there are edges.
  Places(std::size_t parts, std::size_t most) : ready_(parts) {
    edges_.ends = Buffer<Id>(2 * most);
    edges_.radii = Buffer<double>(most);
  }

  std::vector<Edge> empty_list() {
    const std::lock_guard<std::mutex> guard(lock_);
    if (spare_.empty()) return {};
    std::vector<Edge> list = std::move(spare_.back());
    spare_.pop_back();
    list.clear();
    return list;
  }
  void put(std::size_t part, std::vector<Edge>&& list);
  Edges3 all();

 private:
  struct Part {
    std::vector<Edge> list;
    std::size_t first = 0;
    bool ready = false;
  };

  std::mutex lock_;
  std::vector<Part> ready_;
  std::vector<std::vector<Edge>> spare_;
  std::size_t next_ = 0, count_ = 0;  // all parts before next_ have places
  Edges3 edges_;
};

void Places::put(std::size_t part, std::vector<Edge>&& list) {
  std::vector<Part> mine;
  {
    const std::lock_guard<std::mutex> guard(lock_);
    ready_[part].list = std::move(list);
    ready_[part].ready = true;
    for (; next_ < ready_.size() && ready_[next_].ready; ++next_) {
      ready_[next_].first = count_;
      count_ += ready_[next_].list.size();
      mine.push_back(std::move(ready_[next_]));
    }
  }
  for (const Part& p : mine) {
    Id* ends = edges_.ends.begin() + 2 * p.first;
    double* radius = edges_.radii.begin() + p.first;
    for (const Edge& edge : p.list) {
      *ends++ = edge.ends[0];
      *ends++ = edge.ends[1];
      *radius++ = edge.value;
    }
  }
  const std::lock_guard<std::mutex> guard(lock_);
  for (Part& p : mine) spare_.push_back(std::move(p.list));
}

Edges3 Places::all() {
  if (count_ == edges_.radii.size()) return std::move(edges_);
  Edges3 out;
  out.ends = Buffer<Id>(2 * count_);
  out.radii = Buffer<double>(count_);
  std::copy(edges_.ends.begin(), edges_.ends.begin() + 2 * count_, out.ends.begin());
  std::copy(edges_.radii.begin(), edges_.radii.begin() + count_, out.radii.begin());
  return out;
}

// Goes around the edges of a range of tetrahedra. Those that it passes need not start again.
template <class Rule>
class Ring {
 public:
  Ring(const Compact3& mesh, Facets3<Rule>& facets, std::size_t lo, std::size_t hi)
      : neighbor_(mesh.neighbor.data()), facets_(facets.of.data()), lo_(lo), hi_(hi) {}

  // Around the edge of t that has not the positions `leave` and `keep`. False if a lower
  // tetrahedron has it.
  bool go(std::size_t t, int leave, int keep) {
    count_ = 0;
    attached_ = false;
    const int end = walk(t, leave, keep);
    return end == kClosed || (end == kHull && walk(t, keep, leave) == kHull);
  }
  // Whether one of the triangles has an obtuse angle opposite to the edge.
  bool attached() const { return attached_; }
  double least(const Buffer<double>& radii) const {
    double value = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count_; ++i) {
      const Id own = passed_[i];
      const Id code = neighbor_[own];
      const Id owner = Facets3<Rule>::owns(static_cast<std::size_t>(own >> 2), code) ? own : code;
      const typename Facets3<Rule>::Of& of = facets_[owner >> 2];
      const int before = (of.before >> (2 * (owner & 3))) & 3;
      value = std::min(value, radii[static_cast<std::size_t>(of.first + before)]);
    }
    return value;
  }

 private:
  enum End { kClosed, kHull, kNotOurs };

  // Crosses facet `leave`, whose vertex beside the edge is `keep`, and so on. The vertices
  // of a facet stand in the same order on both sides.
  End walk(std::size_t t, int leave, int keep) {
    const Id* const neighbor = neighbor_;  // bytes are written below: those may not be these
    typename Facets3<Rule>::Of* const facets = facets_;
    const std::size_t lo = lo_, size = hi_ - lo_;
    std::size_t s = t, count = count_;
    Id* passed = passed_.data();
    bool attached = attached_;
    End end = kClosed;
    do {
      const Id facet = static_cast<Id>(4 * s) + leave, code = neighbor[facet];
      if (count == passed_.size()) {
        passed_.resize(2 * count);
        passed = passed_.data();
      }
      passed[count++] = facet;
      attached |= Rule::attached(facets[s].code, leave, keep);
      s = static_cast<std::size_t>(code >> 2);
      if (code < 0 || s < t) {
        end = code < 0 ? kHull : kNotOurs;
        break;
      }
      const int back = code & 3, rank = keep - (keep > leave ? 1 : 0);
      leave = rank + (rank >= back ? 1 : 0);
      keep = back;
      if (s - lo < size) facets[s].met |= kAcross[leave][keep];
    } while (s != t);
    attached_ = attached;
    count_ = count;
    return end;
  }

  const Id* neighbor_;
  typename Facets3<Rule>::Of* facets_;
  std::size_t lo_, hi_;
  std::vector<Id> passed_ = std::vector<Id>(64);  // facets, as 4t + i
  std::size_t count_ = 0;
  bool attached_ = false;
};

template <class Rule>
class Collector {
 public:
  Collector(const SpatialOrder3& order, const Compact3& mesh, Facets3<Rule>& facets, Rule& rule,
            const Buffer<double>& triangle_radii)
      : row_(order.row.data()), rule_(rule), mesh_(mesh), facets_(facets), radii_(triangle_radii) {}

  void collect(std::size_t lo, std::size_t hi, std::vector<Edge>& found) {
    Ring<Rule> ring(mesh_, facets_, lo, hi);
    for (std::size_t t = lo; t < hi; ++t) {
      for (unsigned left = ~unsigned{facets_.of[t].met} & 63u; left != 0; left &= left - 1) {
        const Ends& e = kEnds[left & (0u - left)];
        if (ring.go(t, e.leave, e.keep)) found.push_back(edge(t, e.i, e.j, ring));
      }
    }
  }

 private:
  Edge edge(std::size_t t, int i, int j, const Ring<Rule>& ring) {
    const Id u = mesh_.vertex[4 * t + static_cast<std::size_t>(i)];
    const Id v = mesh_.vertex[4 * t + static_cast<std::size_t>(j)];
    rule_.meet(u, v);
    auto least = [&] { return ring.least(radii_); };
    const double value = ring.attached() ? least() : rule_.edge(u, v, least);
    return {{std::min(row_[u], row_[v]), std::max(row_[u], row_[v])}, value};
  }

  const Id* row_;
  Rule& rule_;
  const Compact3& mesh_;
  Facets3<Rule>& facets_;
  const Buffer<double>& radii_;
};

}  // namespace

template <class Rule>
Edges3 edges3(const SpatialOrder3& order, const Compact3& mesh, Facets3<Rule>& facets, Rule& rule,
              const Buffer<double>& triangle_radii, Job& job) {
  constexpr std::size_t kPart = 32768;  // tetrahedra: the edges of a part stay in the cache
  const std::size_t parts = (mesh.count + kPart - 1) / kPart;
  // Euler's relation of a ball. Fewer are there if points are hidden.
  Places places(parts, order.size + triangle_radii.size() - mesh.count - 1);
  Collector<Rule> collector(order, mesh, facets, rule, triangle_radii);
  job.run(parts, [&](std::size_t part) {
    std::vector<Edge> found = places.empty_list();
    collector.collect(kPart * part, std::min(mesh.count, kPart * (part + 1)), found);
    places.put(part, std::move(found));
    job.advance(0.2 / static_cast<double>(parts));
  });
  return places.all();
}

template Edges3 edges3<PlainRule3>(const SpatialOrder3&, const Compact3&, Facets3<PlainRule3>&,
                                   PlainRule3&, const Buffer<double>&, Job&);
template Edges3 edges3<WeightedRule3>(const SpatialOrder3&, const Compact3&,
                                      Facets3<WeightedRule3>&, WeightedRule3&,
                                      const Buffer<double>&, Job&);

}  // namespace alphamesh
