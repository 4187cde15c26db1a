#pragma once
#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace lamella {

/// Threads that parallel loops use; 0 or less: as many as the machine has.
void set_thread_count(int threads);
int thread_count();

/// f(begin, end) for consecutive chunks of [0, n), in any order and on any thread. The chunks
/// depend on n and grain alone, so whatever is computed a chunk does not depend on the number of
/// threads.
void parallel_for(std::size_t n, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& f);

/// Sum of f(begin, end) over the chunks of [0, n), added in their order: the same for any number of
/// threads.
template <class Sum, class F>
Sum parallel_sum(std::size_t n, std::size_t grain, F&& f) {
  std::vector<Sum> parts((n + grain - 1) / grain);
  parallel_for(n, grain,
               [&](std::size_t begin, std::size_t end) { parts[begin / grain] = f(begin, end); });
  Sum total{};
  for (const Sum& part : parts) total += part;
  return total;
}

/// What f(begin, end, list) appends for the chunks of [0, n), in their order.
template <class T, class F>
std::vector<T> parallel_collect(std::size_t n, std::size_t grain, F&& f) {
  std::vector<std::vector<T>> parts((n + grain - 1) / grain);
  parallel_for(n, grain,
               [&](std::size_t begin, std::size_t end) { f(begin, end, parts[begin / grain]); });
  std::vector<T> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

} // namespace lamella
