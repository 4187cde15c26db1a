#include "interrupt.h"

#include <csignal>

namespace lamella {

namespace {
volatile std::sig_atomic_t requested = 0;

void note(int signal) {
  requested = 1;
  std::signal(signal, SIG_DFL);
}
} // namespace

void watch_for_interrupt() {
  std::signal(SIGINT, note);
  std::signal(SIGTERM, note);
}

bool interrupt_requested() { return requested != 0; }

} // namespace lamella
