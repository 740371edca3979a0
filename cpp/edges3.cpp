#include "edges3.hpp"

#include <algorithm>
#include <limits>
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

// The edges of a part, in blocks, as their number is not known beforehand.
class Found {
 public:
  explicit Found(std::size_t expected) : expected_(expected) {}

  void push(const Edge& edge) {
    if (at_ == end_) {
      blocks_.emplace_back(blocks_.empty() ? expected_ : expected_ / 4 + 64);
      at_ = blocks_.back().begin();
      end_ = blocks_.back().end();
    }
    *at_++ = edge;
    ++count_;
  }
  std::size_t count() const { return count_; }
  template <class Use>
  void for_each(Use&& use) const {
    std::size_t left = count_;
    for (const Buffer<Edge>& block : blocks_) {
      const std::size_t here = std::min(left, block.size());
      for (std::size_t i = 0; i < here; ++i) use(block[i]);
      left -= here;
    }
  }

 private:
  std::size_t expected_, count_ = 0;
  std::vector<Buffer<Edge>> blocks_;
  Edge *at_ = nullptr, *end_ = nullptr;
};

// Goes around the edges of a range of tetrahedra. Those that it passes need not start again.
template <class Rule>
class Ring {
 public:
  Ring(const Compact3& mesh, const Facets3<Rule>& facets, std::uint8_t* done, std::size_t lo,
       std::size_t hi)
      : neighbor_(mesh.neighbor.data()),
        facets_(facets),
        code_(facets.code.data()),
        done_(done),
        lo_(lo),
        hi_(hi) {}

  // Around the edge of t that has not the positions `leave` and `keep`. False if a lower
  // tetrahedron has it.
  bool go(std::size_t t, int leave, int keep) {
    facet_.clear();
    attached_ = false;
    const int end = walk(t, leave, keep);
    return end == kClosed || (end == kHull && walk(t, keep, leave) == kHull);
  }
  // Whether one of the triangles has an obtuse angle opposite to the edge.
  bool attached() const { return attached_; }
  double least(const Buffer<double>& radii) const {
    double value = std::numeric_limits<double>::infinity();
    for (const Id own : facet_) {
      const Id code = neighbor_[own];
      const Id owner = Facets3<Rule>::owns(static_cast<std::size_t>(own >> 2), code) ? own : code;
      const auto t = static_cast<std::size_t>(owner >> 2);
      const int before = (facets_.before[t] >> (2 * (owner & 3))) & 3;
      value = std::min(value, radii[static_cast<std::size_t>(facets_.first[t] + before)]);
    }
    return value;
  }

 private:
  enum End { kClosed, kHull, kNotOurs };

  // Crosses facet `leave`, whose vertex beside the edge is `keep`, and so on. The vertices
  // of a facet stand in the same order on both sides.
  End walk(std::size_t t, int leave, int keep) {
    std::size_t s = t;
    do {
      const Id facet = static_cast<Id>(4 * s) + leave, code = neighbor_[facet];
      facet_.push_back(facet);
      attached_ |= Rule::attached(code_[s], leave, keep);
      if (code < 0) return kHull;
      s = static_cast<std::size_t>(code >> 2);
      if (s < t) return kNotOurs;
      const int back = code & 3, rank = keep - (keep > leave ? 1 : 0);
      leave = rank + (rank >= back ? 1 : 0);
      keep = back;
      if (s >= lo_ && s < hi_) done_[s] |= kAcross[leave][keep];
    } while (s != t);
    return kClosed;
  }

  const Id* neighbor_;
  const Facets3<Rule>& facets_;
  const typename Rule::Code* code_;
  std::uint8_t* done_;
  std::size_t lo_, hi_;
  std::vector<Id> facet_;
  bool attached_ = false;
};

template <class Rule>
class Collector {
 public:
  Collector(const SpatialOrder3& order, const Compact3& mesh, const Facets3<Rule>& facets,
            Rule& rule, const Buffer<double>& triangle_radii)
      : row_(order.row.data()),
        rule_(rule),
        mesh_(mesh),
        facets_(facets),
        radii_(triangle_radii),
        done_(mesh.count) {}

  void collect(std::size_t lo, std::size_t hi, const Job& job, Found& found) {
    std::fill(done_.begin() + lo, done_.begin() + hi, std::uint8_t{0});
    Ring<Rule> ring(mesh_, facets_, done_.data(), lo, hi);
    for (std::size_t t = lo; t < hi; ++t) {
      if (((t - lo) & 0x3fff) == 0) job.poll();
      for (unsigned left = ~unsigned{done_[t]} & 63u; left != 0; left &= left - 1) {
        const Ends& e = kEnds[left & (0u - left)];
        if (ring.go(t, e.leave, e.keep)) found.push(edge(t, e.i, e.j, ring));
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
  const Facets3<Rule>& facets_;
  const Buffer<double>& radii_;
  Buffer<std::uint8_t> done_;  // edges of a tetrahedron seen from a lower one of the same part
};

}  // namespace

template <class Rule>
Edges3 edges3(const SpatialOrder3& order, Compact3& mesh, Facets3<Rule>&& given, Rule& rule,
              const Buffer<double>& triangle_radii, Job& job) {
  std::vector<Found> found;
  const Parts parts(mesh.count, job, 1024);
  {
    const Facets3<Rule> facets = std::move(given);
    Collector<Rule> collector(order, mesh, facets, rule, triangle_radii);
    for (std::size_t part = 0; part < parts.count(); ++part) {
      found.emplace_back((parts.end(part) - parts.begin(part)) * 5 / 4 + 64);
    }
    job.run(parts.count(), [&](std::size_t part) {
      collector.collect(parts.begin(part), parts.end(part), job, found[part]);
      job.advance(0.2 / static_cast<double>(parts.count()));
    });
    mesh.neighbor = Buffer<Id>();
  }
  std::vector<std::size_t> first(parts.count() + 1, 0);
  for (std::size_t i = 0; i < found.size(); ++i) first[i + 1] = first[i] + found[i].count();
  Edges3 out;
  out.ends = Buffer<Id>(2 * first.back());
  out.radii = Buffer<double>(first.back());
  job.run(parts.count(), [&](std::size_t part) {
    std::size_t e = first[part];
    found[part].for_each([&](const Edge& edge) {
      std::copy(edge.ends, edge.ends + 2, &out.ends[2 * e]);
      out.radii[e++] = edge.value;
    });
  });
  return out;
}

template Edges3 edges3<PlainRule3>(const SpatialOrder3&, Compact3&, Facets3<PlainRule3>&&,
                                   PlainRule3&, const Buffer<double>&, Job&);
template Edges3 edges3<WeightedRule3>(const SpatialOrder3&, Compact3&, Facets3<WeightedRule3>&&,
                                      WeightedRule3&, const Buffer<double>&, Job&);

}  // namespace alphamesh
