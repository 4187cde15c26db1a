// Runs a fuzz target without libFuzzer: mutations of its seeds for so many seconds, the same ones
// each time. An input that ends the program is left behind in scene_fuzz.crash beside it.
//   scene_fuzz [SECONDS [SEED]]        scene_fuzz FILE: that one input again
#include "fuzz.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <random>

namespace {

using Random = std::mt19937_64;

std::size_t below(std::size_t n, Random& random) { return n == 0 ? 0 : random() % n; }

/// A number that programs stumble over.
std::uint64_t awkward(Random& random) {
  constexpr std::uint64_t numbers[]{0,          1,          0x7f,        0xff,
                                    0x7fffffff, 0xffffffff, 0x100000000, 0x7ff0000000000000,
                                    ~0ull,      1ull << 40, 1ull << 62,  0x7ff8000000000000};
  return numbers[below(std::size(numbers), random)];
}

std::string mutated(std::string text, const std::vector<std::string>& seeds, Random& random) {
  for (std::size_t n = 1 + below(6, random); n > 0; n--) {
    const std::size_t at = below(text.size(), random),
                      length = std::min(below(64, random), text.size() - at);
    switch (below(6, random)) {
    case 0:
      if (!text.empty()) text[at] = char(text[at] ^ (1 << below(8, random)));
      break;
    case 1:
      text.erase(at, length);
      break;
    case 2:
      text.insert(at, text.substr(below(text.size(), random), length));
      break;
    case 3: {
      const std::string& other = seeds[below(seeds.size(), random)];
      text.insert(at, other.substr(below(other.size(), random), length));
      break;
    }
    case 4: {
      const std::uint64_t number = awkward(random);
      const std::size_t size = std::min<std::size_t>(1 << below(4, random), text.size() - at);
      std::copy_n(reinterpret_cast<const char*>(&number), size, text.begin() + long(at));
      break;
    }
    default:
      text.resize(below(text.size() + 1, random) + text.size() / 2);
    }
  }
  return text;
}

void run(const std::string& input) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

} // namespace

int main(int argc, char** argv) {
  using Clock = std::chrono::steady_clock;
  const std::string crash = std::string(argv[0]) + ".crash";
  const std::string first = argc > 1 ? argv[1] : "5";
  if (first.find_first_not_of("0123456789") != first.npos) {
    std::ifstream file(first, std::ios::binary);
    run({std::istreambuf_iterator<char>(file), {}});
    return 0;
  }
  const std::vector<std::string> seeds = lamella::fuzz::seeds();
  for (const std::string& seed : seeds) run(seed);
  Random random(argc > 2 ? std::stoull(argv[2]) : 1);
  const auto end = Clock::now() + std::chrono::seconds(std::stol(first));
  long count = 0;
  for (; Clock::now() < end; count++) {
    const std::string input = mutated(seeds[below(seeds.size(), random)], seeds, random);
    std::ofstream(crash, std::ios::binary) << input;
    run(input);
  }
  std::remove(crash.c_str());
  std::printf("%ld inputs\n", count);
}
