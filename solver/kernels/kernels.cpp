#include "kernels/kernels.h"

#include <cstdlib>
#include <string_view>

namespace lamella {

namespace baseline {
extern const Kernels table;
}
#ifdef LAMELLA_X86_KERNELS
namespace avx2 {
extern const Kernels table;
}
namespace avx512 {
extern const Kernels table;
}
#endif

std::vector<const Kernels*> available_kernels() {
  std::vector<const Kernels*> available{&baseline::table};
#ifdef LAMELLA_X86_KERNELS
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    available.push_back(&avx2::table);
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512cd"))
      available.push_back(&avx512::table);
  }
#endif
  return available;
}

const Kernels& kernels() {
  static const Kernels& chosen = []() -> const Kernels& {
    const std::vector<const Kernels*> available = available_kernels();
    const char* wish = std::getenv("LAMELLA_KERNELS");
    for (const Kernels* k : available)
      if (wish && std::string_view(wish) == k->name) return *k;
    return *available.back();
  }();
  return chosen;
}

} // namespace lamella
