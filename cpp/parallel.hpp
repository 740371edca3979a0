// Threads, cancellation and progress of one call into the core. No global state.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace alphamesh {

struct Cancelled : std::exception {
  const char* what() const noexcept override { return "cancelled"; }
};

// The first exception of a thread needs memory, and without it the process ends: threads get
// that memory when they start, not when there may be none left.
inline void prepare_to_throw() { static_cast<void>(std::current_exception()); }

class Job {
 public:
  explicit Job(int threads) : threads_(std::max(1, threads)) {}

  int threads() const { return threads_; }
  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
  // Long loops call this now and then.
  void poll() const {
    if (cancelled_.load(std::memory_order_relaxed)) throw Cancelled();
  }

  // Progress as a share of 1: weights are rough, a bar needs no more.
  void advance(double share) {
    double seen = progress_.load(std::memory_order_relaxed);
    while (!progress_.compare_exchange_weak(seen, seen + share, std::memory_order_relaxed)) {
    }
  }
  double progress() const { return std::min(1.0, progress_.load(std::memory_order_relaxed)); }

  // Runs work(0) ... work(count - 1), each once, taken in order by whoever is free. The
  // first exception stops the rest and is thrown here.
  template <class Work>
  void run(std::size_t count, Work&& work) {
    std::atomic<std::size_t> next{0};
    std::exception_ptr error;
    std::mutex lock;
    auto loop = [&] {
      prepare_to_throw();
      try {
        for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < count;) {
          poll();
          work(i);
        }
      } catch (...) {
        const std::lock_guard<std::mutex> guard(lock);
        if (!error) error = std::current_exception();
        next.store(count, std::memory_order_relaxed);
      }
    };
    std::vector<std::thread> helpers;
    const std::size_t extra = std::min<std::size_t>(static_cast<std::size_t>(threads_), count);
    for (std::size_t i = 1; i < extra; ++i) {
      try {
        helpers.emplace_back(loop);
      } catch (const std::system_error&) {
        break;  // no more threads to be had: the ones that run do the work
      }
    }
    loop();
    for (std::thread& t : helpers) t.join();
    if (error) std::rethrow_exception(error);
  }

 private:
  int threads_;
  std::atomic<bool> cancelled_{false};
  std::atomic<double> progress_{0.0};
};

// The least work that is a part of its own. Fuzzers want to see several parts, and threads,
// even of tiny clouds.
#ifdef ALPHAMESH_SMALL_PARTS
constexpr std::size_t worthwhile(std::size_t) { return 2; }
#else
constexpr std::size_t worthwhile(std::size_t least) { return least; }
#endif

// Equal parts of [0, n): a few per thread, so that one slow part does not hold up the rest.
class Parts {
 public:
  Parts(std::size_t n, const Job& job, std::size_t least = 8192) : n_(n) {
    const std::size_t wanted =
        job.threads() == 1 ? 16 : 8 * static_cast<std::size_t>(job.threads());
    count_ = std::max<std::size_t>(1, std::min(wanted, n / worthwhile(least)));
  }
  std::size_t count() const { return count_; }
  std::size_t begin(std::size_t i) const { return n_ * i / count_; }
  std::size_t end(std::size_t i) const { return n_ * (i + 1) / count_; }
  std::size_t holding(std::size_t k) const {
    std::size_t i = k * count_ / n_;
    while (k >= end(i)) ++i;
    return i;
  }

 private:
  std::size_t n_, count_;
};

}  // namespace alphamesh
