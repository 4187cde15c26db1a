#include "interrupt.h"

#include <array>
#include <csignal>

namespace lamella {

namespace {
volatile std::sig_atomic_t requested = 0, checkpoint_wanted = 0; // the signal; whether
volatile std::sig_atomic_t heeds_keyboard = 0;                   // SIGINT is not ignored

// Those of people, shells and job managers that end a run.
constexpr std::array ending{SIGINT, SIGTERM, SIGHUP, SIGUSR2, SIGXCPU};

void set(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(signal, &action, nullptr);
}

bool is_ignored(int signal) {
  struct sigaction now {};
  return sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

void note(int signal) {
  requested = signal;
  if (heeds_keyboard) set(SIGINT, SIG_DFL); // a person has a way out
}

void note_checkpoint(int) { checkpoint_wanted = 1; }
} // namespace

void watch_for_interrupt() {
  heeds_keyboard = !is_ignored(SIGINT);
  for (const int signal : ending)
    if (!is_ignored(signal)) set(signal, note);
  if (!is_ignored(SIGUSR1)) set(SIGUSR1, note_checkpoint);
  set(SIGPIPE, SIG_IGN);
  set(SIGXFSZ, SIG_IGN);
}

void end_at_interrupt() {
  for (const int signal : ending)
    if (!is_ignored(signal)) set(signal, SIG_DFL);
  set(SIGPIPE, SIG_DFL);
  if (requested != 0) std::raise(requested);
}

bool interrupt_requested() { return requested != 0; }

bool checkpoint_requested() {
  const bool wanted = checkpoint_wanted != 0;
  checkpoint_wanted = 0;
  return wanted;
}

} // namespace lamella
