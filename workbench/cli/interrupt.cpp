#include "workbench/cli/interrupt.h"

#include "core/io/atomic_file.h"
#include "core/io/input_file.h"
#include "workbench/session/crash_stop.h"

namespace tangent {
namespace {

constexpr std::array<int, 3> kSignals{SIGINT, SIGTERM, SIGHUP};

volatile std::sig_atomic_t interrupted = 0;

void on_signal(int signal) {
  if (interrupted == 0) {
    interrupted = 1;
    end_waiting_for_input();
    ask_servos_to_end();  // now, not when somebody looks at the flag: the drawing thread may hang
    return;
  }
  end_servos();
  remove_temporary_files();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupted = 0;
  allow_waiting_for_input();
  allow_servos();
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &action, nullptr);
  }
}

InterruptGuard::~InterruptGuard() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
}

bool InterruptGuard::requested() { return interrupted != 0; }

}  // namespace tangent
