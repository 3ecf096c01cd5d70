#include "workbench/session/crash_stop.h"

#include "core/io/atomic_file.h"

#include <csignal>
#include <cstddef>
#include <cstdlib>

#include <atomic>
#include <ctime>
#include <utility>

namespace tangent {

namespace {

std::atomic<bool> to_end{false}, links_of_their_own{false};
std::atomic<int> running{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free, "used by handlers");

thread_local RunningServo* servo_here = nullptr;

constexpr std::size_t kStackBytes = 64 * 1024;

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
void wait_for_links() noexcept { links_of_their_own.store(true); }
void allow_servos() noexcept { to_end.store(false, std::memory_order_release); }

bool end_servos() noexcept {
  ask_servos_to_end();
  if (RunningServo* mine = std::exchange(servo_here, nullptr); mine != nullptr) {  // a crash in there is its own
    mine->release_(mine->servo_);
    mine->ended();
  }
  for (int half_ms = 0; half_ms < 2 * kMostWait_ms && running.load() > 0; ++half_ms) wait_a_little();
  if (links_of_their_own.load()) {
    const timespec link{0, kLinkWait_ms * 1'000'000L};
    nanosleep(&link, nullptr);
  }
  return running.load() == 0;
}

RunningServo::RunningServo(void (*release)(void*) noexcept, void* servo) noexcept : release_(release), servo_(servo) {
  running.fetch_add(1);
}

void RunningServo::ended() noexcept {
  if (running_.exchange(false)) running.fetch_sub(1);
}

RunningServo::Here::Here(RunningServo& servo) noexcept { servo_here = &servo; }
RunningServo::Here::~Here() { servo_here = nullptr; }

AlternateStack::AlternateStack() noexcept : bytes_(static_cast<unsigned char*>(std::malloc(kStackBytes))) {
  const stack_t stack{.ss_sp = bytes_, .ss_flags = 0, .ss_size = kStackBytes};
  if (bytes_ != nullptr) sigaltstack(&stack, nullptr);
}

AlternateStack::~AlternateStack() {
  const stack_t none{.ss_sp = nullptr, .ss_flags = SS_DISABLE, .ss_size = 0};
  sigaltstack(&none, nullptr);
  std::free(bytes_);
}

void install_crash_stop() {
  static const AlternateStack stack;  // of the main thread
  struct sigaction action {};
  action.sa_handler = end_in_order;
  // NODEFER: raised again in the handler, it ends the process at once.
  action.sa_flags = SA_ONSTACK | SA_NODEFER;
  sigemptyset(&action.sa_mask);
  const auto end_by = [&action](int signal) {
    struct sigaction before {};
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_DFL) sigaction(signal, &action, nullptr);
  };
  for (const int signal :
       {SIGSEGV, SIGBUS,  SIGILL,  SIGFPE,  SIGABRT, SIGSYS,  SIGTRAP,   SIGHUP,  SIGINT, SIGTERM, SIGQUIT,
        SIGPIPE, SIGALRM, SIGUSR1, SIGUSR2, SIGXCPU, SIGXFSZ, SIGVTALRM, SIGPROF, SIGPWR, SIGIO,   SIGSTKFLT})
    end_by(signal);
  for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal) end_by(signal);
  std::atexit([] {
    end_servos();
    remove_temporary_files();
  });
}

}  // namespace tangent
