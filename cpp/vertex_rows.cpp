#include "vertex_rows.hpp"

#include <algorithm>
#include <limits>

namespace alphamesh {
namespace {

using Id = std::int32_t;

// The least radius of the edges at each row that is attached.
Buffer<double> least_radii(const Role* role, std::size_t n, const EdgeView& edges, const Job& job) {
  if (std::find(role, role + n, Role::kAttached) == role + n) return {};
  Buffer<double> least(n);
  std::fill(least.begin(), least.end(), std::numeric_limits<double>::infinity());
  for (std::size_t e = 0; e < edges.count; ++e) {
    if ((e & 0xfffff) == 0) job.poll();
    for (int k = 0; k < 2; ++k) {
      const Id v = edges.rows[2 * e + k];
      if (role[v] == Role::kAttached) least[v] = std::min(least[v], edges.radii[e]);
    }
  }
  return least;
}

}  // namespace

VertexRows vertex_rows(const Role* role, const double* weight, const Id* representative,
                       std::size_t n, const EdgeView& edges, const Job& job) {
  const Buffer<double> least = least_radii(role, n, edges, job);
  auto is_hidden = [&](std::size_t i) {
    if (role[i] != Role::kNone) return false;
    const Id stands = representative == nullptr ? static_cast<Id>(i) : representative[i];
    return static_cast<std::size_t>(stands) == i || weight[i] < weight[stands];
  };
  std::size_t vertices = 0, hidden = 0;
  for (std::size_t i = 0; i < n; ++i) {
    vertices += role[i] != Role::kNone;
    hidden += is_hidden(i);
  }
  VertexRows out{Buffer<Id>(vertices), Buffer<double>(vertices), Buffer<Id>(hidden)};
  vertices = hidden = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (role[i] != Role::kNone) {
      out.vertices[vertices] = static_cast<Id>(i);
      out.radii[vertices++] = role[i] == Role::kAttached ? least[i] : signed_root(0.0 - weight[i]);
    } else if (is_hidden(i)) {
      out.hidden[hidden++] = static_cast<Id>(i);
    }
  }
  return out;
}

}  // namespace alphamesh
