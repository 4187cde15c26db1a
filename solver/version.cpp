#include "version.h"

#include "kernels/kernels.h"
#include "source_digest.h"

#include <fmt/format.h>

namespace lamella {

std::string_view version() { return LAMELLA_VERSION "+" LAMELLA_SOURCE_DIGEST; }

std::string arithmetic() {
  return fmt::format("{} kernels, FFTW with estimated plans", kernels().name);
}

} // namespace lamella
