#include "memory.hpp"

#include <cstring>

#if defined(__linux__)
#include <sys/mman.h>

#include <cstdint>
#include <mutex>
#include <vector>
#endif

namespace alphamesh {
namespace {

void* copied(void* p, std::size_t bytes, std::size_t more) {
  void* const target = allocate(more);
  std::memcpy(target, p, bytes);
  release(p, bytes);
  return target;
}

}  // namespace

#if defined(__linux__)
namespace {

constexpr std::size_t kHugePage = std::size_t{1} << 21;
constexpr std::size_t kLarge = 2 * kHugePage;

std::size_t whole_pages(std::size_t bytes) {
  return (bytes + kHugePage - 1) / kHugePage * kHugePage;
}

void unmap(char* p, std::size_t bytes) noexcept {
  if (bytes != 0) (void)munmap(p, bytes);  // of what we mapped: cannot fail
}

// Mappings can be cut, so that a part of one is as good as a mapping of its own.
struct Block {
  char* begin;
  std::size_t bytes;
};

struct Pool {
  std::mutex lock;
  std::vector<Block> blocks;
  int users = 0;
};

Pool& pool() {
  static Pool* const instance = new Pool;  // never destroyed: arrays may outlive everything
  return *instance;
}

// The smallest block that is large enough, or nothing.
void* take(std::size_t bytes) {
  Pool& p = pool();
  const std::lock_guard<std::mutex> guard(p.lock);
  std::size_t best = p.blocks.size();
  for (std::size_t i = 0; i < p.blocks.size(); ++i) {
    const std::size_t size = p.blocks[i].bytes;
    if (size >= bytes && (best == p.blocks.size() || size < p.blocks[best].bytes)) best = i;
  }
  if (best == p.blocks.size()) return nullptr;
  Block& block = p.blocks[best];
  char* const found = block.begin;
  block.begin += bytes;  // pages at the front have been touched
  block.bytes -= bytes;
  if (block.bytes == 0) {
    block = p.blocks.back();
    p.blocks.pop_back();
  }
  return found;
}

void* map(std::size_t bytes) {
  const std::size_t wanted = bytes + kHugePage;  // to cut out an aligned part
  void* const got =
      mmap(nullptr, wanted, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (got == MAP_FAILED) throw std::bad_alloc();
  char* const begin = static_cast<char*>(got);
  const std::size_t over = reinterpret_cast<std::uintptr_t>(begin) % kHugePage;
  const std::size_t skip = over == 0 ? 0 : kHugePage - over;
  unmap(begin, skip);
  unmap(begin + skip + bytes, wanted - skip - bytes);
#if defined(MADV_HUGEPAGE)
  (void)madvise(begin + skip, bytes, MADV_HUGEPAGE);  // advice: failure is harmless
#endif
  return begin + skip;
}

}  // namespace

Recycling::Recycling() noexcept {
  const std::lock_guard<std::mutex> guard(pool().lock);
  ++pool().users;
}

Recycling::~Recycling() {
  std::vector<Block> blocks;
  {
    const std::lock_guard<std::mutex> guard(pool().lock);
    if (--pool().users == 0) blocks.swap(pool().blocks);
  }
  for (const Block& b : blocks) unmap(b.begin, b.bytes);
}

void* allocate(std::size_t bytes) {
  if (bytes < kLarge) return ::operator new(bytes, std::align_val_t(64));
  const std::size_t pages = whole_pages(bytes);
  void* const again = take(pages);
  return again != nullptr ? again : map(pages);
}

void release(void* p, std::size_t bytes) noexcept {
  if (bytes < kLarge) {
    ::operator delete(p, std::align_val_t(64));
    return;
  }
  const Block block{static_cast<char*>(p), whole_pages(bytes)};
  try {
    const std::lock_guard<std::mutex> guard(pool().lock);
    if (pool().users > 0) {
      pool().blocks.push_back(block);
      return;
    }
  } catch (const std::bad_alloc&) {
    // No room for a note of the block: give it back at once.
  }
  unmap(block.begin, block.bytes);
}

void* enlarge(void* p, std::size_t bytes, std::size_t more) {
  if (bytes < kLarge) return copied(p, bytes, more);
  const std::size_t pages = whole_pages(bytes);
  if (whole_pages(more) <= pages) return p;
  void* const target = map(whole_pages(more));  // aligned, so that huge pages move whole
  if (mremap(p, pages, pages, MREMAP_MAYMOVE | MREMAP_FIXED, target) != MAP_FAILED) return target;
  std::memcpy(target, p, bytes);
  release(p, bytes);
  return target;
}

#else

Recycling::Recycling() noexcept = default;
Recycling::~Recycling() = default;
void* allocate(std::size_t bytes) { return ::operator new(bytes, std::align_val_t(64)); }
void release(void* p, std::size_t) noexcept { ::operator delete(p, std::align_val_t(64)); }
void* enlarge(void* p, std::size_t bytes, std::size_t more) { return copied(p, bytes, more); }

#endif

}  // namespace alphamesh
