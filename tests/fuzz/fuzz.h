#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

// What a fuzz target consists of: LLVMFuzzerTestOneInput, as libFuzzer calls it, and seeds.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace lamella::fuzz {

/// Valid inputs to start from.
std::vector<std::string> seeds();

inline void expect(bool holds, const char* complaint) {
  if (holds) return;
  std::fprintf(stderr, "%s\n", complaint);
  std::abort();
}

} // namespace lamella::fuzz
