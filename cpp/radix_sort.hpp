// Sorting of 64-bit words by their upper halves.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "memory.hpp"
#include "parallel.hpp"

namespace alphamesh {

// Stable parallel radix sort by the upper half of each word, least digit first.
inline void radix_sort(Buffer<std::uint64_t>& words, int key_bits, Job& job) {
  const std::size_t n = words.size();
  const int passes = (key_bits + 10) / 11, digit = (key_bits + passes - 1) / passes;
  const std::size_t radix = std::size_t{1} << digit;
  const Parts parts(n, job, 32768);
  Buffer<std::uint64_t> other(n);
  std::vector<std::uint32_t> count(parts.count() * radix);
  for (int pass = 0; pass < passes; ++pass) {
    const int shift = 32 + pass * digit;
    const std::uint64_t mask = radix - 1;
    job.run(parts.count(), [&](std::size_t i) {
      std::uint32_t* c = count.data() + i * radix;
      std::fill(c, c + radix, 0u);
      for (std::size_t k = parts.begin(i); k < parts.end(i); ++k) ++c[(words[k] >> shift) & mask];
    });
    std::uint32_t sum = 0;
    for (std::size_t d = 0; d < radix; ++d) {
      for (std::size_t i = 0; i < parts.count(); ++i) {
        const std::uint32_t c = count[i * radix + d];
        count[i * radix + d] = sum;
        sum += c;
      }
    }
    job.run(parts.count(), [&](std::size_t i) {
      std::uint32_t* c = count.data() + i * radix;
      for (std::size_t k = parts.begin(i); k < parts.end(i); ++k) {
        other[c[(words[k] >> shift) & mask]++] = words[k];
      }
    });
    std::swap(words, other);
  }
}

}  // namespace alphamesh
