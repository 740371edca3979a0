#include "windings.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace alphamesh {
namespace {

using Id = std::int32_t;

struct Offset {
  std::int64_t x[3] = {0, 0, 0};

  friend Offset operator+(Offset a, const Offset& b) {
    for (int k = 0; k < 3; ++k) a.x[k] += b.x[k];
    return a;
  }
  friend Offset operator-(Offset a, const Offset& b) {
    for (int k = 0; k < 3; ++k) a.x[k] -= b.x[k];
    return a;
  }
  bool zero() const { return x[0] == 0 && x[1] == 0 && x[2] == 0; }
};

// Union-find over cells, each with its place: a cell lies `offset` periods from where its root
// is listed, if one walks there through the cells that were joined.
class PlacedSets {
 public:
  explicit PlacedSets(std::size_t n) : parent_(n), offset_(n), size_(n) {
    for (std::size_t i = 0; i < n; ++i) parent_[i] = static_cast<Id>(i);
    std::fill(offset_.begin(), offset_.end(), Offset{});
    std::fill(size_.begin(), size_.end(), 1);
  }

  Id root(Id i) const {
    while (parent_[at(i)] != i) i = parent_[at(i)];
    return i;
  }
  // No more than log2(n) steps, as the smaller set is hung below the larger one.
  Offset place(Id i) const {
    Offset sum;
    for (; parent_[at(i)] != i; i = parent_[at(i)]) sum = sum + offset_[at(i)];
    return sum;
  }
  // Cell `b` lies `step` from cell `a`.
  void join(Id a, Id b, const Offset& step) {
    Id p = root(a), q = root(b);
    if (p == q) return;
    Offset between = place(a) + step - place(b);  // from p to q
    if (size_[at(p)] < size_[at(q)]) {
      std::swap(p, q);
      between = Offset{} - between;
    }
    parent_[at(q)] = p;
    offset_[at(q)] = between;
    size_[at(p)] += size_[at(q)];
  }

 private:
  static std::size_t at(Id i) { return static_cast<std::size_t>(i); }

  Buffer<Id> parent_;
  Buffer<Offset> offset_;
  Buffer<Id> size_;
};

// A basis of integer vectors in echelon form, by Euclid's algorithm.
class Echelon {
 public:
  void add(Offset v) {
    for (int k = 0; k < 3; ++k) {
      Offset& pivot = row_[static_cast<std::size_t>(k)];
      while (v.x[k] != 0) {
        const std::int64_t times = pivot.x[k] / v.x[k];
        for (int m = k; m < 3; ++m) pivot.x[m] -= times * v.x[m];
        std::swap(pivot, v);
      }
    }
  }
  int rank() const {
    int rank = 0;
    for (std::size_t k = 0; k < 3; ++k) rank += row_[k].x[k] != 0 ? 1 : 0;
    return rank;
  }

 private:
  std::array<Offset, 3> row_;
};

class Windings {
 public:
  Windings(const BoxCells& cells, const bool* inside, const bool* wall, Job& job)
      : cells_(cells), inside_(inside), wall_(wall), job_(job), sets_(cells.count) {}
  WoundParts run();

 private:
  // Where a facet of a cell lies, seen from where it is listed.
  Offset facet_in(Id cell, std::size_t facet) const {
    const auto c = static_cast<std::size_t>(cell);
    if (cells_.face[cells_.columns * c] != static_cast<Id>(facet)) return {};
    const std::int8_t* second = cells_.second + 3 * c;
    return {{second[0], second[1], second[2]}};
  }
  template <class Visit>
  void each_door(Visit&& visit) const;

  const BoxCells& cells_;
  const bool *inside_, *wall_;
  Job& job_;
  PlacedSets sets_;
};

// visit(cell, cell beyond or -1, step from the one to the other)
template <class Visit>
void Windings::each_door(Visit&& visit) const {
  for (std::size_t f = 0; f < cells_.facets; ++f) {
    if ((f & 0xffff) == 0) job_.poll();
    const Id s = cells_.cofaces[2 * f], t = cells_.cofaces[2 * f + 1];
    if (wall_[f] || s < 0 || inside_[s] || (t >= 0 && inside_[t])) continue;
    visit(s, t, t < 0 ? Offset{} : facet_in(s, f) - facet_in(t, f));
  }
}

WoundParts Windings::run() {
  each_door([&](Id s, Id t, const Offset& step) {
    if (t >= 0) sets_.join(s, t, step);
  });
  Buffer<bool> outside(cells_.count);
  std::fill(outside.begin(), outside.end(), false);
  each_door([&](Id s, Id t, const Offset&) {
    if (t < 0) outside[static_cast<std::size_t>(sets_.root(s))] = true;
  });
  WoundParts out;
  out.part = Buffer<Id>(cells_.count);
  Buffer<Id> number(cells_.count);  // of the part of each root
  std::fill(number.begin(), number.end(), -1);
  Id parts = 0;
  for (std::size_t c = 0; c < cells_.count; ++c) {
    const auto root = static_cast<std::size_t>(sets_.root(static_cast<Id>(c)));
    const bool counted = !inside_[c] && !outside[root];
    if (counted && number[root] < 0) number[root] = parts++;
    out.part[c] = counted ? number[root] : -1;
  }
  std::vector<Echelon> bases(static_cast<std::size_t>(parts));
  each_door([&](Id s, Id t, const Offset& step) {
    const Id part = out.part[static_cast<std::size_t>(s)];
    if (t < 0 || part < 0) return;
    const Offset around = sets_.place(s) + step - sets_.place(t);
    if (!around.zero()) bases[static_cast<std::size_t>(part)].add(around);
  });
  out.rank = Buffer<std::int8_t>(bases.size());
  std::transform(bases.begin(), bases.end(), out.rank.begin(),
                 [](const Echelon& basis) { return static_cast<std::int8_t>(basis.rank()); });
  return out;
}

}  // namespace

WoundParts wound_parts(const BoxCells& cells, const bool* inside, const bool* wall, Job& job) {
  return Windings(cells, inside, wall, job).run();
}

}  // namespace alphamesh
