#include "rounds3.hpp"

namespace alphamesh {
namespace {

using Id = std::int32_t;

std::uint64_t scramble(std::uint64_t z) {  // splitmix64
  z += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace

Rounds plan_rounds(std::size_t n) {
  constexpr std::uint64_t kRatio = 8;
  int most = 0;
  for (std::size_t m = n; m > 500; m /= kRatio) ++most;
  auto round_of = [&](std::size_t i) {
    std::uint64_t h = scramble(i);
    int round = most;
    while (round > 0 && h % kRatio == 0) {
      h /= kRatio;
      --round;
    }
    return static_cast<std::size_t>(round);
  };
  Rounds out;
  out.start.assign(static_cast<std::size_t>(most) + 2, 0);
  for (std::size_t i = 0; i < n; ++i) ++out.start[round_of(i) + 1];
  for (std::size_t r = 1; r < out.start.size(); ++r) out.start[r] += out.start[r - 1];
  out.point = Buffer<Id>(n);
  std::vector<std::size_t> at(out.start.begin(), out.start.end() - 1);
  for (std::size_t i = 0; i < n; ++i) out.point[at[round_of(i)]++] = static_cast<Id>(i);
  return out;
}

}  // namespace alphamesh
