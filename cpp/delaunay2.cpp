#include "delaunay2.hpp"

#include <atomic>
#include <vector>

#include "sheet.hpp"

namespace alphamesh {
namespace {

using Id = std::int32_t;

// A triangulated range of points, by two of its ghosts; a single point has none.
struct Piece {
  Id low = -1, high = -1;  // half-edges 8t of ghosts
  Id point = -1;           // the point, if it is the only one
};

enum class Axis { kX, kY };

// Where a range of points is cut in two.
struct Cut {
  std::size_t at;
  Axis axis;
};

template <class S>
class Builder {
 public:
  Builder(SpatialOrder<S>& order, Mesh2& mesh, const Job& job)
      : p_(order.points.data()),
        row_(order.row.data()),
        key_(order.key.data()),
        m_(mesh.slot.data()),
        lattice_(order.lattice),
        job_(job) {}

  Cut cut(std::size_t lo, std::size_t hi) const;
  Piece solve(std::size_t lo, std::size_t hi);
  Piece merge(Piece left, Piece right, std::size_t mid, Axis axis);

 private:
  using Point = typename S::Point;

  // The growing seam: base edge from a (left) to b (right), the half-edge below it, and
  // the ghosts next on either side.
  struct Seam {
    Id a, b;
    Id below;
    Id left, right;  // ghosts, -1 if that side is a single point
    Id left_tip, right_tip;
  };

  Id& origin(Id h) { return m_[h]; }
  Id twin(Id h) const { return m_[h + 4]; }
  void link(Id h, Id g) {
    m_[h + 4] = g;
    m_[g + 4] = h;
  }
  // A ghost (v, u, infinity) lies beyond the hull edge u -> v.
  void set_ghost(Id t, Id v, Id u) {
    m_[t] = v;
    m_[t + 1] = u;
    m_[t + 2] = Mesh2::kInfinity;
  }
  Id ghost_after(Id g) const { return Mesh2::base(twin(g + 2)); }  // counter-clockwise
  Id ghost_before(Id g) const { return Mesh2::base(twin(g + 1)); }

  static bool precedes(Point a, Point b, Axis axis) {
    return axis == Axis::kX ? a < b : (a.y < b.y || (a.y == b.y && a.x < b.x));
  }
  int turn(Id a, Id b, Id c) const { return orient(p_[a], p_[b], p_[c], lattice_); }

  Piece leaf(std::size_t lo, std::size_t hi);
  Piece edge(Id a, Id b);
  Piece triangle(Id a, Id b, Id c);
  Id extreme(Piece piece, Axis axis, bool greatest) const;
  void find_tangent(Id& left, Id& right, Id& a, Id& b) const;
  void trim_left(Seam& s);
  void trim_right(Seam& s);
  void zip(Seam& s);

  Point* p_;
  Id* row_;
  std::uint64_t* key_;
  Id* m_;
  Lattice lattice_;
  const Job& job_;
};

// Where the Morton codes of a range first part: left of it, all coordinates along the
// axis are smaller. Equal codes are in lexicographic order and are halved.
template <class S>
Cut Builder<S>::cut(std::size_t lo, std::size_t hi) const {
  std::uint64_t differ = key_[lo] ^ key_[hi - 1];
  if (differ == 0) return {lo + (hi - lo) / 2, Axis::kX};
  int bit = 0;
  for (int step = 32; step > 0; step /= 2) {
    if ((differ >> step) != 0) {
      differ >>= step;
      bit += step;
    }
  }
  const std::uint64_t from = key_[hi - 1] >> bit << bit;
  std::size_t first = lo, last = hi - 1;  // key[first] < from <= key[last]
  while (last - first > 1) {
    const std::size_t middle = first + (last - first) / 2;
    (key_[middle] < from ? first : last) = middle;
  }
  return {last, (bit & 1) != 0 ? Axis::kX : Axis::kY};
}

template <class S>
Piece Builder<S>::edge(Id a, Id b) {
  const Id low = 16 * a, high = low + 8;  // slots 2a and 2a + 1
  set_ghost(low, b, a);
  set_ghost(high, a, b);
  for (Id i = 0; i < 3; ++i) link(low + i, high + (3 - i) % 3);
  return {low, high, -1};
}

template <class S>
Piece Builder<S>::triangle(Id a, Id b, Id c) {
  const Id t = 16 * a;
  const int side = turn(a, b, c);
  if (side == 0) return {};
  const Id v[3] = {a, side > 0 ? b : c, side > 0 ? c : b};
  for (Id i = 0; i < 3; ++i) {
    const Id ghost = t + 8 * (i + 1), after = t + 8 * ((i + 1) % 3 + 1);
    m_[t + i] = v[i];
    set_ghost(ghost, v[(i + 1) % 3], v[i]);
    link(t + i, ghost);
    link(ghost + 2, after + 1);
  }
  return {t + 8, t + 16, -1};
}

// A few points: cut vertically, so that their order is lexicographic.
template <class S>
Piece Builder<S>::leaf(std::size_t lo, std::size_t hi) {
  const Id a = static_cast<Id>(lo);
  if (hi - lo == 1) return {-1, -1, a};
  if (hi - lo == 2) return edge(a, a + 1);
  if (hi - lo == 3) {
    const Piece piece = triangle(a, a + 1, a + 2);
    if (piece.low >= 0) return piece;
  }
  const std::size_t mid = lo + (hi - lo) / 2;
  const Piece left = leaf(lo, mid), right = leaf(mid, hi);
  return merge(left, right, mid, Axis::kX);
}

template <class S>
Piece Builder<S>::solve(std::size_t lo, std::size_t hi) {
  constexpr std::size_t kLeaf = 8;
  if (hi - lo > kLeaf) {
    const Cut c = cut(lo, hi);
    const Piece left = solve(lo, c.at), right = solve(c.at, hi);
    return merge(left, right, c.at, c.axis);
  }
  for (std::size_t i = lo + 1; i < hi; ++i) {  // insertion sort
    const Point p = p_[i];
    const Id row = row_[i];
    std::size_t k = i;
    for (; k > lo && p < p_[k - 1]; --k) {
      p_[k] = p_[k - 1];
      row_[k] = row_[k - 1];
    }
    p_[k] = p;
    row_[k] = row;
  }
  return leaf(lo, hi);
}

// The ghost that starts at the extreme hull vertex: hulls are convex, so that a climb
// from anywhere gets there.
template <class S>
Id Builder<S>::extreme(Piece piece, Axis axis, bool greatest) const {
  auto better = [&](Id u, Id v) {
    return greatest ? precedes(p_[v], p_[u], axis) : precedes(p_[u], p_[v], axis);
  };
  Id g = better(m_[piece.high + 1], m_[piece.low + 1]) ? piece.high : piece.low;
  if (better(m_[g], m_[g + 1])) {
    do g = ghost_after(g);
    while (better(m_[g], m_[g + 1]));
    return g;
  }
  for (Id h = ghost_before(g); better(m_[h + 1], m_[g + 1]); h = ghost_before(g)) g = h;
  return g;
}

// From the edge between the nearest extremes down to the common tangent: in the end no
// point of either side lies to the right of a -> b.
template <class S>
void Builder<S>::find_tangent(Id& left, Id& right, Id& a, Id& b) const {
  for (;;) {
    if (left >= 0) {
      const Id g = ghost_before(left), c = m_[g + 1];
      if (turn(a, b, c) < 0) {
        left = g;
        a = c;
        continue;
      }
    }
    if (right >= 0) {
      const Id c = m_[right];
      if (turn(a, b, c) < 0) {
        right = ghost_after(right);
        b = c;
        continue;
      }
    }
    return;
  }
}

// Removes the hull edges a -> tip of the left side whose triangle has its apex inside the
// circle through a, b and the tip: the edge is flipped out, and two ghosts remain.
template <class S>
void Builder<S>::trim_left(Seam& s) {
  for (;;) {
    const Id h = twin(s.left), apex = m_[Mesh2::prev(h)];  // h runs from a to the tip
    if (apex < 0 || !in_circle(p_[s.a], p_[s.b], p_[s.left_tip], p_[apex], lattice_)) return;
    const Id t = Mesh2::base(h), g = s.left;
    const Id outer = twin(Mesh2::next(h)), inner = twin(Mesh2::prev(h));
    m_[g + 1] = apex;  // beyond apex -> tip
    link(g, outer);
    set_ghost(t, apex, s.a);  // beyond a -> apex
    link(t, inner);
    link(t + 2, g + 1);
    s.left = t;
    s.left_tip = apex;
  }
}

template <class S>
void Builder<S>::trim_right(Seam& s) {
  for (;;) {
    const Id h = twin(s.right), apex = m_[Mesh2::prev(h)];  // h runs from the tip to b
    if (apex < 0 || !in_circle(p_[s.a], p_[s.b], p_[s.right_tip], p_[apex], lattice_)) return;
    const Id t = Mesh2::base(h), g = s.right;
    const Id inner = twin(Mesh2::next(h)), outer = twin(Mesh2::prev(h));
    m_[g] = apex;  // beyond tip -> apex
    link(g, outer);
    set_ghost(t, s.b, apex);  // beyond apex -> b
    link(t, inner);
    link(t + 1, g + 2);
    s.right = t;
    s.right_tip = apex;
  }
}

// Raises the seam triangle by triangle. A ghost becomes a triangle when the point at
// infinity is replaced by the far end of the base edge.
template <class S>
void Builder<S>::zip(Seam& s) {
  for (unsigned step = 1;; ++step) {
    if ((step & 0xffffu) == 0) job_.poll();
    const bool left = s.left >= 0 && turn(s.a, s.b, s.left_tip) > 0;
    if (left) trim_left(s);
    const bool right = s.right >= 0 && turn(s.a, s.b, s.right_tip) > 0;
    if (right) trim_right(s);
    if (!left && !right) return;
    if (!left ||
        (right && in_circle(p_[s.a], p_[s.b], p_[s.left_tip], p_[s.right_tip], lattice_))) {
      const Id g = s.right;  // (b, tip, infinity)
      s.right = ghost_before(g);
      m_[g + 2] = s.a;
      link(g + 2, s.below);
      s.below = g + 1;
      s.b = s.right_tip;
      s.right_tip = m_[s.right + 1];
    } else {
      const Id g = s.left;  // (tip, a, infinity)
      s.left = ghost_after(g);
      m_[g + 2] = s.b;
      link(g + 1, s.below);
      s.below = g + 2;
      s.a = s.left_tip;
      s.left_tip = m_[s.left];
    }
  }
}

template <class S>
Piece Builder<S>::merge(Piece left_piece, Piece right_piece, std::size_t mid, Axis axis) {
  const bool one_left = left_piece.low < 0, one_right = right_piece.low < 0;
  Id left = one_left ? -1 : extreme(left_piece, axis, true);
  Id right = one_right ? -1 : extreme(right_piece, axis, false);
  Id a = one_left ? left_piece.point : m_[left + 1];
  Id b = one_right ? right_piece.point : m_[right + 1];
  find_tangent(left, right, a, b);

  const Id low = static_cast<Id>(16 * mid) - 16, high = low + 8;  // slots 2 mid - 2, 2 mid - 1
  set_ghost(low, b, a);
  Seam s{a, b, low, left, -1, -1, -1};
  if (!one_left) {
    link(low + 1, twin(left + 1));
    s.left_tip = m_[left];
  }
  if (!one_right) {
    s.right = ghost_before(right);
    s.right_tip = m_[s.right + 1];
    link(low + 2, right + 1);
  }
  zip(s);
  set_ghost(high, s.a, s.b);
  link(high, s.below);
  link(high + 1, one_right ? low + 2 : s.right + 2);
  link(high + 2, one_left ? low + 1 : s.left + 1);
  return {low, high, -1};
}

// The upper part of the recursion as a list of ranges, parents before children, so that
// threads can take the leaves and whoever finishes a second child merges.
struct Node {
  std::size_t lo = 0, hi = 0;
  Cut cut{0, Axis::kX};
  std::size_t parent = 0, child[2] = {0, 0};  // no children: a leaf
  Piece piece;
};

template <class S>
void plan(std::vector<Node>& nodes, std::vector<std::size_t>& leaves, const Builder<S>& builder,
          std::size_t i, std::size_t grain) {
  const std::size_t lo = nodes[i].lo, hi = nodes[i].hi;
  if (hi - lo <= grain) {
    leaves.push_back(i);
    return;
  }
  const Cut c = builder.cut(lo, hi);
  nodes[i].cut = c;
  for (int k = 0; k < 2; ++k) {
    Node child;
    child.lo = k == 0 ? lo : c.at;
    child.hi = k == 0 ? c.at : hi;
    child.parent = i;
    const std::size_t at = nodes.size();
    nodes.push_back(child);
    nodes[i].child[k] = at;
    plan(nodes, leaves, builder, at, grain);
  }
}

}  // namespace

template <class S>
Mesh2 delaunay2(SpatialOrder<S>& order, Job& job) {
  Mesh2 mesh;
  const std::size_t n = order.size;
  if (n < 2) return mesh;
  mesh.triangles = 2 * n - 2;
  mesh.slot = Buffer<Id>(8 * mesh.triangles);
  Builder<S> builder(order, mesh, job);

  std::vector<Node> nodes(1);
  nodes[0].hi = n;
  std::vector<std::size_t> leaves;
  const std::size_t tasks = 16 * static_cast<std::size_t>(job.threads());
  plan(nodes, leaves, builder, 0, std::max<std::size_t>(4096, n / tasks));
  std::vector<std::atomic<int>> missing(nodes.size());
  for (auto& m : missing) m.store(2, std::memory_order_relaxed);

  job.run(leaves.size(), [&](std::size_t task) {
    std::size_t i = leaves[task];
    nodes[i].piece = builder.solve(nodes[i].lo, nodes[i].hi);
    job.advance(0.7 * static_cast<double>(nodes[i].hi - nodes[i].lo) / static_cast<double>(n));
    while (i != 0) {
      i = nodes[i].parent;
      if (missing[i].fetch_sub(1, std::memory_order_acq_rel) == 2)
        return;  // the other half is not done
      job.poll();
      nodes[i].piece = builder.merge(nodes[nodes[i].child[0]].piece, nodes[nodes[i].child[1]].piece,
                                     nodes[i].cut.at, nodes[i].cut.axis);
    }
  });
  mesh.ghost = nodes[0].piece.low;
  return mesh;
}

template Mesh2 delaunay2<Plane>(SpatialOrder2&, Job&);
template Mesh2 delaunay2<Sheet>(SpatialOrder<Sheet>&, Job&);

}  // namespace alphamesh
