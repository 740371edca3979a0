// Runs kept inputs of the fuzzer, and random changes of them, without a fuzzer:
//
//   replay CHANGES FILE...     prints how many inputs held
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

std::vector<std::uint8_t> current;

// Where a proof fails, the input is what is wanted.
void tell(int signal) {
  std::fprintf(stderr, "with the input, in hexadecimal: ");
  for (std::uint8_t byte : current) std::fprintf(stderr, "%02x", byte);
  std::fprintf(stderr, "\n");
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void change(std::vector<std::uint8_t>& data, std::mt19937& random) {
  for (std::size_t k = 1 + random() % 4; k > 0; --k) {
    const std::size_t at = random() % (data.size() + 1);
    const auto byte = static_cast<std::uint8_t>(random());
    if (at == data.size() || random() % 4 == 0) {
      data.insert(data.begin() + static_cast<std::ptrdiff_t>(at), byte);
    } else if (random() % 4 == 0) {
      data.erase(data.begin() + static_cast<std::ptrdiff_t>(at));
    } else {
      data[at] = byte;
    }
  }
}

}  // namespace

int main(int count, char** words) {
  for (int signal : {SIGABRT, SIGSEGV, SIGFPE}) std::signal(signal, tell);
  std::vector<std::vector<std::uint8_t>> kept;
  for (int i = 2; i < count; ++i) {
    std::ifstream file(words[i], std::ios::binary);
    kept.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  unsigned long cases = 0;
  auto run = [&] {
    LLVMFuzzerTestOneInput(current.data(), current.size());
    ++cases;
  };
  for (const auto& data : kept) {
    current = data;
    run();
  }
  std::mt19937 random(1);
  for (long left = kept.empty() ? 0 : std::strtol(words[1], nullptr, 10); left > 0; --left) {
    current = kept[random() % kept.size()];
    change(current, random);
    run();
  }
  std::printf("%lu\n", cases);
}
