#include "workbench/session/crash_stop.h"

#include "core/io/atomic_file.h"
#include "workbench/session/raw_terminal.h"

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdlib>

#include <atomic>
#include <ctime>
#include <utility>

namespace tangent {

namespace {

std::atomic<bool> to_end{false}, to_wait{false}, links_of_their_own{false};
std::atomic<int> running{0}, waiting{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free, "used by handlers");

thread_local RunningServo* servo_here = nullptr;

constexpr std::size_t kStackBytes = 64 * 1024;

void wait_a_little() noexcept {
  const timespec half_a_tick{0, 500'000};
  nanosleep(&half_a_tick, nullptr);
}

void wait_for_cable() noexcept {
  if (!links_of_their_own.load()) return;
  const timespec link{0, kLinkWait_ms * 1'000'000L};
  nanosleep(&link, nullptr);
}

void end_in_order(int signal) {
  end_servos();
  remove_temporary_files();
  give_terminal_back();
  // To the default action, which ends the process with the signal's own status and core.
  struct sigaction plain {};
  plain.sa_handler = SIG_DFL;
  sigaction(signal, &plain, nullptr);
  raise(signal);
}

// By the default action after all, so that the shell sees a job that was stopped as asked.
void suspend_in_order(int signal) {
  const int before = errno;
  to_wait.store(true, std::memory_order_release);
  for (int half_ms = 0; half_ms < 2 * kMostWait_ms && waiting.load() < running.load(); ++half_ms) wait_a_little();
  wait_for_cable();
  give_terminal_back();
  struct sigaction plain {
  }, mine{};
  plain.sa_handler = SIG_DFL;
  sigaction(signal, &plain, &mine);
  sigset_t only;
  sigemptyset(&only);
  sigaddset(&only, signal);
  pthread_sigmask(SIG_UNBLOCK, &only, nullptr);
  raise(signal);  // suspended here, until SIGCONT
  sigaction(signal, &mine, nullptr);
  take_terminal_again();
  to_wait.store(false, std::memory_order_release);
  errno = before;
}

}  // namespace

bool servos_are_to_wait() noexcept { return to_wait.load(std::memory_order_acquire); }

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
  wait_for_cable();
  return running.load() == 0;
}

RunningServo::RunningServo(void (*release)(void*) noexcept, void* servo) noexcept : release_(release), servo_(servo) {
  running.fetch_add(1);
}

void RunningServo::ended() noexcept {
  goes_on();
  if (running_.exchange(false)) running.fetch_sub(1);
}

void RunningServo::waits() noexcept {
  if (!waiting_.exchange(true)) waiting.fetch_add(1);
}

void RunningServo::goes_on() noexcept {
  if (waiting_.exchange(false)) waiting.fetch_sub(1);
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
  const auto handle = [&action](int signal) {
    struct sigaction before {};
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_DFL) sigaction(signal, &action, nullptr);
  };
  for (const int signal :
       {SIGSEGV, SIGBUS,  SIGILL,  SIGFPE,  SIGABRT, SIGSYS,  SIGTRAP,   SIGHUP,  SIGINT, SIGTERM, SIGQUIT,
        SIGPIPE, SIGALRM, SIGUSR1, SIGUSR2, SIGXCPU, SIGXFSZ, SIGVTALRM, SIGPROF, SIGPWR, SIGIO,   SIGSTKFLT})
    handle(signal);
  for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal) handle(signal);
  action.sa_handler = suspend_in_order;
  action.sa_flags = SA_ONSTACK | SA_RESTART;
  for (const int signal : {SIGTSTP, SIGTTIN, SIGTTOU}) handle(signal);
  std::atexit([] {
    end_servos();
    remove_temporary_files();
    give_terminal_back();
  });
}

void leave_suspending_to_others() noexcept {
  sigset_t suspending;
  sigemptyset(&suspending);
  for (const int signal : {SIGTSTP, SIGTTIN, SIGTTOU}) sigaddset(&suspending, signal);
  pthread_sigmask(SIG_BLOCK, &suspending, nullptr);
}

}  // namespace tangent
