#include "memory.hpp"

#include <cstring>

#if defined(__linux__)
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
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
constexpr std::size_t kLarge = kHugePage / 2;

std::size_t whole_pages(std::size_t bytes) {
  return (bytes + kHugePage - 1) / kHugePage * kHugePage;
}

void unmap(char* p, std::size_t bytes) noexcept {
  if (bytes != 0) (void)munmap(p, bytes);  // of what we mapped: cannot fail
}

// Mappings can be cut and joined, so that any part is as good as a mapping of its own.
struct Block {
  char* begin;
  std::size_t bytes;
};

// Free blocks by address; no two of them touch.
class Pool {
 public:
  void enter() { ++users_; }
  void leave() noexcept;
  void* take(std::size_t bytes);
  void give(Block block) noexcept;
  void clear() noexcept;

 private:
  bool lend(Block& block) noexcept;
  void insert(Block block);

  std::vector<Block> blocks_;
  std::size_t kept_ = 0;  // bytes, while there are no users
  int users_ = 0;
};

// What may be kept between calls: an eighth of the memory, two gigabytes at most.
std::size_t most_kept() {
  const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || size <= 0) return 0;
  const std::size_t share = static_cast<std::size_t>(pages) / 8 * static_cast<std::size_t>(size);
  return std::min(share, std::size_t{1} << 31) / kHugePage * kHugePage;
}

// The smallest block that is large enough, or nothing.
void* Pool::take(std::size_t bytes) {
  std::size_t best = blocks_.size();
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const std::size_t size = blocks_[i].bytes;
    if (size >= bytes && (best == blocks_.size() || size < blocks_[best].bytes)) best = i;
  }
  if (best == blocks_.size()) return nullptr;
  Block& block = blocks_[best];
  char* const found = block.begin;
  block.begin += bytes;  // pages at the front have been touched
  block.bytes -= bytes;
  if (block.bytes == 0) blocks_.erase(blocks_.begin() + static_cast<std::ptrdiff_t>(best));
  if (users_ == 0) kept_ -= bytes;
  return found;
}

void Pool::insert(Block block) {
  auto next = std::lower_bound(blocks_.begin(), blocks_.end(), block.begin,
                               [](const Block& b, const char* at) { return b.begin < at; });
  if (next != blocks_.begin() && (next - 1)->begin + (next - 1)->bytes == block.begin) {
    --next;
    next->bytes += block.bytes;
  } else if (next != blocks_.end() && block.begin + block.bytes == next->begin) {
    next->begin = block.begin;
    next->bytes += block.bytes;
    return;
  } else {
    blocks_.insert(next, block);
    return;
  }
  const auto after = next + 1;
  if (after != blocks_.end() && next->begin + next->bytes == after->begin) {
    next->bytes += after->bytes;
    blocks_.erase(after);
  }
}

// Tells the system that it may have the pages of a block, and cuts off what is too much to
// keep. False if nothing is left.
bool Pool::lend(Block& block) noexcept {
#if defined(MADV_FREE)
  static const std::size_t most = most_kept();
  const std::size_t keep = std::min(block.bytes, most - std::min(most, kept_));
  if (keep != 0 && madvise(block.begin, keep, MADV_FREE) == 0) {
    unmap(block.begin + keep, block.bytes - keep);
    block.bytes = keep;
    kept_ += keep;
    return true;
  }
#endif
  unmap(block.begin, block.bytes);
  return false;
}

void Pool::give(Block block) noexcept {
  if (users_ == 0 && !lend(block)) return;
  try {
    insert(block);
  } catch (const std::bad_alloc&) {  // no room for a note of the block: give it back at once
    if (users_ == 0) kept_ -= block.bytes;
    unmap(block.begin, block.bytes);
  }
}

void Pool::leave() noexcept {
  if (--users_ != 0) return;
  kept_ = 0;
  blocks_.erase(std::remove_if(blocks_.begin(), blocks_.end(), [&](Block& b) { return !lend(b); }),
                blocks_.end());
}

void Pool::clear() noexcept {
  for (const Block& b : blocks_) unmap(b.begin, b.bytes);
  blocks_.clear();
  kept_ = 0;
}

struct Shared {
  std::mutex lock;
  Pool pool;

  static Shared& get() {
    static Shared* const instance = new Shared;  // never destroyed: arrays may outlive all
    return *instance;
  }
};

// Calls use(pool) as the only one who does.
template <class Use>
auto with_pool(Use&& use) {
  Shared& shared = Shared::get();
  const std::lock_guard<std::mutex> guard(shared.lock);
  return use(shared.pool);
}

void* map(std::size_t bytes) {
  const std::size_t wanted = bytes + kHugePage;  // to cut out an aligned part
  auto get = [&] {
    return mmap(nullptr, wanted, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  };
  void* got = get();
  if (got == MAP_FAILED) {
    trim_memory();
    got = get();
  }
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
  with_pool([](Pool& p) { p.enter(); });
}

Recycling::~Recycling() {
  with_pool([](Pool& p) { p.leave(); });
}

void trim_memory() noexcept {
  with_pool([](Pool& p) { p.clear(); });
}

void* allocate(std::size_t bytes) {
  if (bytes < kLarge) return ::operator new(bytes, std::align_val_t(64));
  const std::size_t pages = whole_pages(bytes);
  void* const again = with_pool([&](Pool& p) { return p.take(pages); });
  return again != nullptr ? again : map(pages);
}

void release(void* p, std::size_t bytes) noexcept {
  if (bytes < kLarge) {
    ::operator delete(p, std::align_val_t(64));
    return;
  }
  with_pool([&](Pool& pool) { pool.give({static_cast<char*>(p), whole_pages(bytes)}); });
}

void* enlarge(void* p, std::size_t bytes, std::size_t more) {
  if (bytes >= kLarge && whole_pages(more) <= whole_pages(bytes)) return p;
  return copied(p, bytes, more);
}

#else

Recycling::Recycling() noexcept = default;
Recycling::~Recycling() = default;
void trim_memory() noexcept {}
void* allocate(std::size_t bytes) { return ::operator new(bytes, std::align_val_t(64)); }
void release(void* p, std::size_t) noexcept { ::operator delete(p, std::align_val_t(64)); }
void* enlarge(void* p, std::size_t bytes, std::size_t more) { return copied(p, bytes, more); }

#endif

}  // namespace alphamesh
