// Sums over simplices in parallel, the same to the last bit for any number of threads.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "parallel.hpp"

namespace alphamesh {

// A sum that loses no digits to its many terms (Neumaier 1974).
class CarefulSum {
 public:
  void operator+=(double term) {
    const double next = sum_ + term;
    rest_ += std::fabs(sum_) >= std::fabs(term) ? (sum_ - next) + term : (term - next) + sum_;
    sum_ = next;
  }
  double value() const { return sum_ + rest_; }

 private:
  double sum_ = 0.0, rest_ = 0.0;
};

// For each number below `count` in turn, make(number, records) appends what it has to add;
// many at once, in parallel. add(record) then takes the records one after another.
template <class Record, class Make, class Add>
void in_waves(std::size_t count, Job& job, double share, Make&& make, Add&& add) {
  constexpr std::size_t kWave = 1 << 16, kPart = 1 << 11;
  std::vector<std::vector<Record>> records(kWave / kPart);
  for (std::size_t start = 0; start < count; start += kWave) {
    const std::size_t end = std::min(count, start + kWave);
    const std::size_t parts = (end - start + kPart - 1) / kPart;
    job.run(parts, [&](std::size_t part) {
      records[part].clear();
      const std::size_t first = start + part * kPart, last = std::min(end, first + kPart);
      for (std::size_t i = first; i < last; ++i) make(i, records[part]);
    });
    for (std::size_t part = 0; part < parts; ++part) {
      for (const Record& record : records[part]) add(record);
    }
    job.advance(share * static_cast<double>(end - start) / static_cast<double>(count));
  }
}

}  // namespace alphamesh
