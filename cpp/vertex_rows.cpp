#include "vertex_rows.hpp"

#include <algorithm>
#include <limits>
#include <vector>

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
                       std::size_t n, const EdgeView& edges, Job& job) {
  const Buffer<double> least = least_radii(role, n, edges, job);
  auto is_hidden = [&](std::size_t i) {
    if (role[i] != Role::kNone) return false;
    const Id stands = representative == nullptr ? static_cast<Id>(i) : representative[i];
    return static_cast<std::size_t>(stands) == i || weight[i] < weight[stands];
  };
  struct Count {
    std::size_t vertices = 0, hidden = 0;
  };
  const Parts parts(n, job);
  std::vector<Count> first(parts.count() + 1);
  job.run(parts.count(), [&](std::size_t part) {
    Count count;
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      count.vertices += role[i] != Role::kNone;
      count.hidden += is_hidden(i);
    }
    first[part + 1] = count;
  });
  for (std::size_t part = 0; part < parts.count(); ++part) {
    first[part + 1].vertices += first[part].vertices;
    first[part + 1].hidden += first[part].hidden;
  }
  const Count all = first.back();
  VertexRows out{Buffer<Id>(all.vertices), Buffer<double>(all.vertices), Buffer<Id>(all.hidden)};
  job.run(parts.count(), [&](std::size_t part) {
    Count at = first[part];
    for (std::size_t i = parts.begin(part); i < parts.end(part); ++i) {
      if (role[i] != Role::kNone) {
        const bool attached = role[i] == Role::kAttached;
        out.vertices[at.vertices] = static_cast<Id>(i);
        out.radii[at.vertices++] = attached ? least[i] : signed_root(0.0 - weight[i]);
      } else if (is_hidden(i)) {
        out.hidden[at.hidden++] = static_cast<Id>(i);
      }
    }
  });
  return out;
}

}  // namespace alphamesh
