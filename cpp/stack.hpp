// A list that grows without a branch on what is to be kept.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "memory.hpp"

namespace alphamesh {

// Write to next(), then keep(true) or keep(false); reserve(k) beforehand for k times.
template <class T>
class Stack {
 public:
  void clear() { size_ = 0; }
  std::size_t size() const { return size_; }
  T& operator[](std::size_t i) { return data_[i]; }
  T* begin() { return data_.begin(); }
  T* end() { return data_.begin() + size_; }
  T& next() { return data_[size_]; }
  void keep(bool wanted) { size_ += wanted ? 1 : 0; }
  void reserve(std::size_t more) {
    if (size_ + more <= data_.size()) return;
    Buffer<T> larger(2 * (size_ + more) + 64);
    std::copy(data_.begin(), data_.begin() + size_, larger.begin());
    data_ = std::move(larger);
  }

 private:
  Buffer<T> data_;
  std::size_t size_ = 0;
};

}  // namespace alphamesh
