// Persistence by the textbook: the boundary matrix of a filtration, reduced column by column.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "exact.hpp"

namespace trust {

// Rows of k + 1 vertices, ascending, with their values; the k-th of a filtration.
struct Simplices {
  const Id* rows = nullptr;
  const double* values = nullptr;
  std::size_t count = 0;
};

using Pair = std::pair<Id, Id>;

// For each dimension the pairs (creator, destroyer) as numbers of rows. `simplices[0]` are
// the vertices.
inline std::vector<std::vector<Pair>> reduced(const std::vector<Simplices>& simplices) {
  struct Entry {
    double value;
    std::size_t dimension, row;
  };
  std::vector<Entry> order;
  std::vector<std::map<std::vector<Id>, std::size_t>> number(simplices.size());
  for (std::size_t k = 0; k < simplices.size(); ++k) {
    for (std::size_t i = 0; i < simplices[k].count; ++i) {
      order.push_back({simplices[k].values[i], k, i});
    }
  }
  std::stable_sort(order.begin(), order.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.value, a.dimension, a.row) < std::tie(b.value, b.dimension, b.row);
  });
  std::vector<std::vector<Pair>> pairs(simplices.size());
  std::vector<std::vector<std::size_t>> columns(order.size());
  std::vector<std::size_t> owner(order.size(), order.size());  // of the lowest entry
  for (std::size_t j = 0; j < order.size(); ++j) {
    const std::size_t k = order[j].dimension;
    const Id* row = simplices[k].rows + (k + 1) * order[j].row;
    number[k][std::vector<Id>(row, row + k + 1)] = j;
    std::vector<std::size_t>& column = columns[j];
    for (std::size_t left = 0; k > 0 && left <= k; ++left) {
      std::vector<Id> face(row, row + k + 1);
      face.erase(face.begin() + static_cast<std::ptrdiff_t>(left));
      const auto found = number[k - 1].find(face);
      require(found != number[k - 1].end(), "a face comes before its coface");
      column.push_back(found->second);
    }
    std::sort(column.begin(), column.end());
    while (!column.empty() && owner[column.back()] != order.size()) {
      const std::vector<std::size_t>& other = columns[owner[column.back()]];
      std::vector<std::size_t> sum;
      std::set_symmetric_difference(column.begin(), column.end(), other.begin(), other.end(),
                                    std::back_inserter(sum));
      column.swap(sum);
    }
    if (column.empty()) continue;
    const Entry& creator = order[column.back()];
    owner[column.back()] = j;
    pairs[creator.dimension].push_back(
        {static_cast<Id>(creator.row), static_cast<Id>(order[j].row)});
  }
  for (auto& p : pairs) std::sort(p.begin(), p.end());
  return pairs;
}

// The pairs of the core, `vertex_number` turning rows of points into numbers of vertices.
inline std::vector<Pair> sorted_pairs(const Id* pairs, std::size_t count,
                                      const std::vector<Id>* vertex_number = nullptr) {
  std::vector<Pair> out;
  for (std::size_t i = 0; i < count; ++i) {
    const Id creator = pairs[2 * i];
    out.push_back(
        {vertex_number == nullptr ? creator : (*vertex_number)[creator], pairs[2 * i + 1]});
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace trust
