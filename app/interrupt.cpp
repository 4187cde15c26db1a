#include "interrupt.h"

#include <csignal>

namespace lamella {

namespace {
volatile std::sig_atomic_t requested = 0, checkpoint_wanted = 0;

constexpr int watched[]{SIGINT, SIGTERM, SIGHUP};

void note(int) {
  requested = 1;
  for (const int signal : watched) std::signal(signal, SIG_DFL);
}

void note_checkpoint(int) { checkpoint_wanted = 1; }
} // namespace

void watch_for_interrupt() {
  for (const int signal : watched)
    if (std::signal(signal, note) == SIG_IGN) std::signal(signal, SIG_IGN);
  struct sigaction action {};
  action.sa_handler = note_checkpoint;
  action.sa_flags = SA_RESTART;
  sigaction(SIGUSR1, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

bool interrupt_requested() { return requested != 0; }

bool checkpoint_requested() {
  const bool wanted = checkpoint_wanted != 0;
  checkpoint_wanted = 0;
  return wanted;
}

} // namespace lamella
