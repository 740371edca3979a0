// Uninitialised arrays that own their memory and can hand it over.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace alphamesh {

// Touching fresh 4 kB pages costs a fifth of a run on large clouds, so that large
// arrays ask for huge pages where the system has them.
constexpr std::size_t kHugePage = std::size_t{1} << 21;

inline std::size_t alignment_for(std::size_t bytes) {
  return bytes >= 2 * kHugePage ? kHugePage : 64;
}

inline void* allocate(std::size_t bytes) {
  const std::size_t align = alignment_for(bytes);
  void* p = ::operator new(bytes, std::align_val_t(align));
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  if (align == kHugePage) (void)madvise(p, bytes, MADV_HUGEPAGE);  // advice: failure is harmless
#endif
  return p;
}

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
  ~Buffer() { release(data_, size_); }

  T* data() { return data_; }
  const T* data() const { return data_; }
  std::size_t size() const { return size_; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }

  static void release(T* data, std::size_t n) {
    if (data != nullptr) ::operator delete(data, std::align_val_t(alignment_for(n * sizeof(T))));
  }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace alphamesh
