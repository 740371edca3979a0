// Uninitialised arrays that own their memory and can hand it over.
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>

namespace alphamesh {

// Memory of at least one byte; release() takes the same number of bytes.
void* allocate(std::size_t bytes);
void release(void* p, std::size_t bytes) noexcept;
// Takes `bytes` of memory, gives back `more` that begin with the same.
void* enlarge(void* p, std::size_t bytes, std::size_t more);

// Asks for the memory at p ahead of its use; changes no result.
inline void prefetch(const void* p) {
#ifdef __GNUC__
  __builtin_prefetch(p);
#else
  static_cast<void>(p);
#endif
}

// Touching fresh pages costs a fifth to a half of a run on large clouds. While an object of
// this class lives, large blocks that are released are kept and given out again, in parts if
// need be. With the last one they are lent to the system, which takes the pages that it
// needs; those that it leaves serve the next call.
class Recycling {
 public:
  Recycling() noexcept;
  ~Recycling();
  Recycling(const Recycling&) = delete;
  Recycling& operator=(const Recycling&) = delete;
};

// Gives back all that is kept and not in use.
void trim_memory() noexcept;

template <class T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T>, "plain data only");

 public:
  Buffer() = default;
  explicit Buffer(std::size_t n) : size_(n) {
    if (n != 0) data_ = static_cast<T*>(allocate(n * sizeof(T)));
  }
  Buffer(Buffer&& o) noexcept
      : data_(std::exchange(o.data_, nullptr)), size_(std::exchange(o.size_, 0)) {}
  Buffer& operator=(Buffer&& o) noexcept {
    std::swap(data_, o.data_);
    std::swap(size_, o.size_);
    return *this;
  }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  ~Buffer() {
    if (data_ != nullptr) release(data_, size_ * sizeof(T));
  }

  // What is there already stays.
  void grow(std::size_t n) {
    data_ = static_cast<T*>(data_ == nullptr ? allocate(n * sizeof(T))
                                             : enlarge(data_, size_ * sizeof(T), n * sizeof(T)));
    size_ = n;
  }

  T* data() { return data_; }
  const T* data() const { return data_; }
  std::size_t size() const { return size_; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace alphamesh
