#include "interrupt.h"

#include <csignal>

namespace lamella {

namespace {
volatile std::sig_atomic_t requested = 0;

constexpr int watched[]{SIGINT, SIGTERM, SIGHUP};

void note(int) {
  requested = 1;
  for (const int signal : watched) std::signal(signal, SIG_DFL);
}
} // namespace

void watch_for_interrupt() {
  for (const int signal : watched)
    if (std::signal(signal, note) == SIG_IGN) std::signal(signal, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

bool interrupt_requested() { return requested != 0; }

} // namespace lamella
