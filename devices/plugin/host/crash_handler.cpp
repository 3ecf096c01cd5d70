#include "devices/plugin/host/crash_handler.h"

#include <atomic>
#include <csignal>
#include <cstdlib>

namespace tangent {

namespace {

std::atomic<PluginLibrary*> to_stop{nullptr};

/// What `stop` makes of it may crash too: then the second signal ends the process.
void stop_and_die(int signal) {
  struct sigaction plain {};
  plain.sa_handler = SIG_DFL;
  sigaction(signal, &plain, nullptr);
  if (PluginLibrary* library = to_stop.exchange(nullptr); library != nullptr) library->stop();
  raise(signal);
}

}  // namespace

void stop_in_a_crash(PluginLibrary& library) {
  constexpr std::size_t kStackBytes = 64 * 1024;
  to_stop.store(&library);
  // An overflown stack can't hold the handler. Never freed: the process ends with it.
  static unsigned char* const stack = static_cast<unsigned char*>(std::malloc(kStackBytes));
  const stack_t alternate{.ss_sp = stack, .ss_flags = 0, .ss_size = kStackBytes};
  if (stack != nullptr) sigaltstack(&alternate, nullptr);
  for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGSYS, SIGTRAP, SIGXCPU}) {
    struct sigaction before {
    }, mine{};
    mine.sa_handler = stop_and_die;
    mine.sa_flags = SA_ONSTACK | SA_NODEFER;
    sigemptyset(&mine.sa_mask);
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_DFL) sigaction(signal, &mine, nullptr);
  }
}

void leave_crashes_alone() noexcept { to_stop.store(nullptr); }

}  // namespace tangent
