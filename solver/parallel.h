#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

namespace lamella {

/// Threads that parallel loops use; 0 or less: as many as the machine has (OMP_NUM_THREADS respected).
void set_thread_count(int threads);
int thread_count();

/// f(begin, end) for consecutive chunks of [0, n), in any order and on any thread. The chunks depend on
/// n and grain alone, so whatever is computed a chunk does not depend on the number of threads.
template <class F> void parallel_for(std::size_t n, std::size_t grain, F&& f) {
  const std::ptrdiff_t chunks = std::ptrdiff_t((n + grain - 1) / grain);
#pragma omp parallel for schedule(dynamic) num_threads(thread_count()) if (chunks > 1)
  for (std::ptrdiff_t c = 0; c < chunks; c++) f(c * grain, std::min(n, (c + 1) * grain));
}

/// Sum of f(begin, end) over the chunks of [0, n), added in their order: the same for any number of threads.
template <class Sum, class F> Sum parallel_sum(std::size_t n, std::size_t grain, F&& f) {
  std::vector<Sum> parts((n + grain - 1) / grain);
  parallel_for(n, grain, [&](std::size_t begin, std::size_t end) { parts[begin / grain] = f(begin, end); });
  Sum total{};
  for (const Sum& part : parts) total += part;
  return total;
}

} // namespace lamella
