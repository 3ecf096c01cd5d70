#include "workbench/session/crash_stop.h"

#include "core/io/atomic_file.h"

#include <csignal>
#include <cstddef>
#include <cstdlib>

#include <atomic>
#include <ctime>

namespace tangent {

namespace {

std::atomic<bool> to_end{false};
std::atomic<int> running{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free, "used by handlers");

/// Of the thread, where it is a servo's.
thread_local void (*release_here)(void*) noexcept = nullptr;
thread_local void* servo_here = nullptr;

constexpr std::size_t kStackBytes = 64 * 1024;
thread_local unsigned char* alternate_stack = nullptr;

/// So that a handler runs where the thread's own stack has overflown.
void use_alternate_stack() noexcept {
  if (alternate_stack != nullptr) return;
  alternate_stack = static_cast<unsigned char*>(std::malloc(kStackBytes));
  if (alternate_stack == nullptr) return;
  const stack_t stack{.ss_sp = alternate_stack, .ss_flags = 0, .ss_size = kStackBytes};
  sigaltstack(&stack, nullptr);
}

void drop_alternate_stack() noexcept {
  const stack_t none{.ss_sp = nullptr, .ss_flags = SS_DISABLE, .ss_size = 0};
  sigaltstack(&none, nullptr);
  std::free(alternate_stack);
  alternate_stack = nullptr;
}

void wait_a_little() noexcept {
  const timespec half_a_tick{0, 500'000};
  nanosleep(&half_a_tick, nullptr);
}

void end_in_order(int signal) {
  end_servos();
  remove_temporary_files();
  // To the default action, which ends the process with the signal's own status and core.
  struct sigaction plain {};
  plain.sa_handler = SIG_DFL;
  sigaction(signal, &plain, nullptr);
  raise(signal);
}

}  // namespace

void ask_servos_to_end() noexcept { to_end.store(true, std::memory_order_release); }
bool servos_are_to_end() noexcept { return to_end.load(std::memory_order_acquire); }
void allow_servos() noexcept { to_end.store(false, std::memory_order_release); }

bool end_servos() noexcept {
  ask_servos_to_end();
  if (release_here != nullptr) {
    const auto release = release_here;
    release_here = nullptr;  // a crash in there is not caught again
    release(servo_here);
    running.fetch_sub(1);
  }
  for (int half_ms = 0; half_ms < 2 * kMostWait_ms && running.load() > 0; ++half_ms) wait_a_little();
  return running.load() == 0;
}

RunningServo::RunningServo(void (*release)(void*) noexcept, void* servo) noexcept {
  use_alternate_stack();
  release_here = release;
  servo_here = servo;
  running.fetch_add(1);
}

RunningServo::~RunningServo() {
  if (release_here != nullptr) running.fetch_sub(1);
  release_here = nullptr;
  drop_alternate_stack();
}

void install_crash_stop() {
  use_alternate_stack();
  struct sigaction action {};
  action.sa_handler = end_in_order;
  // NODEFER: raised again in the handler, it ends the process at once.
  action.sa_flags = SA_ONSTACK | SA_NODEFER;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGSYS, SIGTRAP, SIGHUP, SIGINT, SIGTERM, SIGQUIT,
                           SIGPIPE, SIGALRM, SIGUSR1, SIGUSR2, SIGXCPU, SIGXFSZ, SIGVTALRM, SIGPROF}) {
    struct sigaction before {};
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_DFL) sigaction(signal, &action, nullptr);
  }
  std::atexit([] {
    end_servos();
    remove_temporary_files();
  });
}

}  // namespace tangent
