#include "number2.hpp"

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

namespace alphamesh {
namespace {

using Id = std::int32_t;

// A triangle among those with the same lowest vertex.
struct Member {
  std::uint64_t others;
  Id half_edge;  // the first one
};

class Numbering {
 public:
  Numbering(Buffer<Id>&& m, std::size_t slots, std::size_t n, Job& job)
      : m_(std::move(m)), slots_(slots), n_(n), job_(job) {
    while (((n_ - 1) >> shift_) >= kParts) ++shift_;
  }
  Mesh2 run();

 private:
  static constexpr std::size_t kParts = 64, kAhead = 8;
  static constexpr Id kInfinity = Mesh2::kInfinity;

  bool is_free(std::size_t t) const { return m_[8 * t] < 0; }
  Id lowest(std::size_t t) const {
    const Id *v = &m_[8 * t], low = std::min(v[0], v[1]);
    return v[2] == kInfinity ? low : std::min(low, v[2]);
  }
  Member member(std::size_t t) const;
  void chain();
  void settle(std::size_t part);
  void connect();

  Buffer<Id> m_;
  std::size_t slots_, n_;
  Job& job_;
  int shift_ = 0;  // vertex v belongs to part v >> shift_
  std::size_t first_[kParts + 1] = {};
  std::vector<std::atomic<Id>> head_;  // per vertex: a triangle of which it is the lowest
  Buffer<Id> next_;                    // per triangle: the next in the chain
  Mesh2 out_;
};

Member Numbering::member(std::size_t t) const {
  const Id* v = &m_[8 * t];
  const bool ghost = v[2] == kInfinity;
  const Id first = ghost || (v[0] < v[1] && v[0] < v[2]) ? 0 : v[1] < v[2] ? 1 : 2;
  const Id second = ghost ? std::max(v[0], v[1]) : v[(first + 1) % 3];
  const Id third = ghost ? 0x7fffffff : v[(first + 2) % 3];
  // A line with nothing beside it has two ghosts to an edge.
  const std::uint64_t turned = ghost && v[0] > v[1] ? 1 : 0;
  return {(std::uint64_t{static_cast<std::uint32_t>(second)} << 33) |
              (std::uint64_t{static_cast<std::uint32_t>(third)} << 1) | turned,
          static_cast<Id>(8 * t) + first};
}

// Chains the triangles by their lowest vertices, in whatever order, and counts them.
void Numbering::chain() {
  head_ = std::vector<std::atomic<Id>>(n_);
  next_ = Buffer<Id>(slots_);
  for (auto& h : head_) h.store(-1, std::memory_order_relaxed);
  const Parts parts(slots_, job_);
  std::vector<std::size_t> count(parts.count() * kParts, 0);
  const bool alone = job_.threads() == 1;
  job_.run(parts.count(), [&](std::size_t part) {
    std::size_t mine[kParts] = {};
    for (std::size_t t = parts.begin(part); t < parts.end(part); ++t) {
      if (is_free(t)) continue;
      const auto v = static_cast<std::size_t>(lowest(t));
      ++mine[v >> shift_];
      if (alone) {
        next_[t] = head_[v].load(std::memory_order_relaxed);
        head_[v].store(static_cast<Id>(t), std::memory_order_relaxed);
      } else {
        next_[t] = head_[v].exchange(static_cast<Id>(t), std::memory_order_relaxed);
      }
    }
    std::copy(mine, mine + kParts, &count[part * kParts]);
  });
  for (std::size_t part = 0; part < kParts; ++part) {
    first_[part + 1] = first_[part];
    for (std::size_t k = 0; k < parts.count(); ++k) first_[part + 1] += count[k * kParts + part];
  }
}

// Writes the triangles of a part, their twins as they were, and leaves at the spare number
// 8t + 3 of each old triangle t the new half-edge that its first one became.
void Numbering::settle(std::size_t part) {
  std::vector<Member> bucket;
  Id at = static_cast<Id>(8 * first_[part]);
  const std::size_t end = std::min(n_, (part + 1) << shift_);
  for (std::size_t v = part << shift_; v < end; ++v) {
    bucket.clear();
    if (v + kAhead < n_) {
      const Id t = head_[v + kAhead].load(std::memory_order_relaxed);
      if (t >= 0) prefetch(&m_[8 * static_cast<std::size_t>(t)]);
    }
    for (Id t = head_[v].load(std::memory_order_relaxed); t >= 0; t = next_[t]) {
      bucket.push_back(member(static_cast<std::size_t>(t)));
    }
    std::sort(bucket.begin(), bucket.end(),
              [](const Member& a, const Member& b) { return a.others < b.others; });
    for (const Member& b : bucket) {
      const Id old = Mesh2::base(b.half_edge), turn = b.half_edge & 3;
      for (Id k = 0; k < 3; ++k) {
        const Id from = old + (turn + k) % 3;
        out_.slot[at + k] = m_[from];
        out_.slot[at + k + 4] = m_[from + 4];
      }
      m_[old + 3] = at + (3 - turn) % 3;
      at += 8;
    }
  }
}

void Numbering::connect() {
  const Parts parts(out_.triangles, job_);
  job_.run(parts.count(), [&](std::size_t part) {
    for (std::size_t t = parts.begin(part); t < parts.end(part); ++t) {
      for (std::size_t k = 4; k < 7; ++k) {
        Id& twin = out_.slot[8 * t + k];
        const Id first = m_[Mesh2::base(twin) + 3], turned = (first & 3) + (twin & 3);
        twin = Mesh2::base(first) + (turned > 2 ? turned - 3 : turned);
      }
    }
  });
}

Mesh2 Numbering::run() {
  chain();
  out_.triangles = first_[kParts];
  out_.slot = Buffer<Id>(8 * out_.triangles);
  job_.run(kParts, [&](std::size_t part) { settle(part); });
  connect();
  for (out_.ghost = 0; !out_.is_ghost(out_.ghost);) out_.ghost += 8;
  return std::move(out_);
}

}  // namespace

Mesh2 numbered2(Buffer<Id>&& m, std::size_t slots, std::size_t n, Job& job) {
  return Numbering(std::move(m), slots, n, job).run();
}

}  // namespace alphamesh
