#include "kernels/kernels.h"

#include <cstdlib>
#include <cstring>

namespace lamella {

namespace baseline { extern const Kernels table; }
#ifdef LAMELLA_X86_KERNELS
namespace avx2 { extern const Kernels table; }
namespace avx512 { extern const Kernels table; }
#endif

namespace {

const Kernels& choose() {
#ifdef LAMELLA_X86_KERNELS
  const bool avx2_here = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool avx512_here = avx2_here && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
                           __builtin_cpu_supports("avx512cd");
  const char* wish = std::getenv("LAMELLA_KERNELS");
  const bool baseline_wanted = wish && !std::strcmp(wish, "baseline"), avx2_wanted = wish && !std::strcmp(wish, "avx2");
  if (avx512_here && !baseline_wanted && !avx2_wanted) return avx512::table;
  if (avx2_here && !baseline_wanted) return avx2::table;
#endif
  return baseline::table;
}

} // namespace

const Kernels& kernels() {
  static const Kernels& best = choose();
  return best;
}

} // namespace lamella
