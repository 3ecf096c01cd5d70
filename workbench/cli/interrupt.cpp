#include "workbench/cli/interrupt.h"

#include <csignal>

namespace tangent {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void raise_flag(int) { interrupted = 1; }

void install(void (*handler)(int), int flags) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupted = 0;
  // SA_RESETHAND: the second signal gets the default handler and ends the program.
  install(raise_flag, static_cast<int>(SA_RESETHAND) | SA_RESTART);
}

InterruptGuard::~InterruptGuard() { install(SIG_DFL, 0); }

bool InterruptGuard::requested() { return interrupted != 0; }

}  // namespace tangent
