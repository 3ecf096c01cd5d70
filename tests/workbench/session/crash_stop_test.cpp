// However the process ends, the device's last command is zero force. Each way is tried in a child process, whose device
// writes what it is sent into memory that both share.
#include "workbench/session/crash_stop.h"

#include "tests/workbench/session/calling_driver.h"
#include "tests/workbench/session/session_fixture.h"
#include "workbench/session/raw_terminal.h"
#include "workbench/session/servo.h"

#include <doctest/doctest.h>

#include <pty.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <new>
#include <string>
#include <thread>
#include <vector>

using namespace tangent;
using namespace tangent::test;

#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)

TEST_CASE("however the process ends, the last command is zero force") {
  MESSAGE("skipped: a sanitizer handles the signals itself");
}

#else

namespace {

struct Witness {
  std::atomic<double> last_n{0.0}, most_n{0.0};
  std::atomic<bool> last_was_stop{false};
  std::atomic<std::int64_t> last_ns{0}, ended_ns{0};
  std::atomic<bool> crash_in_exchange{false};
  std::atomic<int> exchanges{0};
};

/// On the surface while it is armed, then 1 mm deep.
struct WitnessedDevice final : ForceDevice {
  Witness& witness;
  ForceCapabilities caps{.name = "witnessed", .peak_force_n = 8.5};
  int ticks = 0;
  CallingDriver driver;  ///< where it keeps the time itself

  explicit WitnessedDevice(Witness& w) : witness(w) {}
  const ForceCapabilities& capabilities() const override { return caps; }
  Status open() override { return {}; }
  void close() override {}
  Status start_calling(const DeviceTick& tick) override { return driver.start(tick); }
  void stop_calling() override { driver.stop(); }
  ForceSample exchange(const ForceCommand& command, double) noexcept override {
    const double n = glm::length(command.force_n);
    witness.last_n = n;
    witness.last_was_stop = command.request == DeviceRequest::stop;
    witness.last_ns = monotonic_ns();
    ++witness.exchanges;
    if (n > witness.most_n) witness.most_n = n;
    if (witness.crash_in_exchange.exchange(false)) *static_cast<volatile int*>(nullptr) = 1;
    ForceSample sample;
    sample.position_m = Vec3(0.0, 0.0, ++ticks < 400 ? 0.0605 : 0.059);
    sample.state = DeviceState::ready;
    return sample;
  }
};

void fail_to_allocate() {
  rlimit limit{};
  getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = std::size_t{64} << 20;  // less than is mapped already
  setrlimit(RLIMIT_AS, &limit);
  std::vector<std::string> much;
  for (;;) much.emplace_back(std::size_t{1} << 20, 'x');
}

int overflow(int depth) {
  volatile char room[4096];
  room[0] = static_cast<char>(depth);
  return depth > 100'000'000 ? room[0] : overflow(depth + 1) + room[0];
}

/// In the child: a servo that pushes with 0.8 N, until `end`.
[[noreturn]] void push_until(Witness& witness, const std::function<void()>& end, bool called) {
  for (int signal = 1; signal < NSIG; ++signal) std::signal(signal, SIG_DFL);  // doctest has its own
  std::set_terminate([] { std::abort(); });
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  install_crash_stop();
  DeviceSet set;
  auto device = std::make_unique<WitnessedDevice>(witness);
  WitnessedDevice* scheduler = called ? device.get() : nullptr;
  set.force = std::move(device);
  TickBench bench(std::move(set), sphere_scene());
  ServoOptions options;
  options.realtime = false;
  MonotonicClock clock;
  Servo servo(*bench.tick, bench.statistics, options, clock, scheduler);
  bench.arm();
  if (!servo.start()) _exit(78);
  for (int i = 0; i < 20'000 && witness.last_n < 0.5; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    // A machine that is not real-time has late ticks: armed again, with the finger lifted.
    ServoStatus status;
    bench.statistics.fill(status);
    if (status.gate_state == GateState::faulted) _exit(77);
  }
  witness.ended_ns = monotonic_ns();
  end();
  for (;;) pause();
}

/// What became of it; the child is tried again where the machine was too slow for the gate.
int outcome(Witness& witness, const std::function<void()>& end, int kill_with = 0, bool called = false) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    new (&witness) Witness;
    std::cout.flush();  // or the child's exit writes it again
    const pid_t child = fork();
    if (child == 0) push_until(witness, end, called);
    while (kill_with != 0 && witness.ended_ns == 0 && waitpid(child, nullptr, WNOHANG) == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (kill_with != 0) kill(child, kill_with);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {}
    if (!(WIFEXITED(status) && WEXITSTATUS(status) == 77)) return status;
  }
  return -1;
}

Witness& shared_witness() {
  void* memory = mmap(nullptr, sizeof(Witness), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  REQUIRE(memory != MAP_FAILED);
  return *new (memory) Witness;
}

}  // namespace

TEST_CASE("however the process ends, the last command is zero force") {
  Witness& witness = shared_witness();
  const auto in_another_thread = [](const std::function<void()>& what) { std::thread([what] { what(); }).detach(); };
  const auto write_to_null = [] { *static_cast<volatile int*>(nullptr) = 1; };
  struct Way {
    const char* name;
    std::function<void()> end;
    int signal;  ///< by which it ends; 0: exit
  };
  const Way ways[]{
      {"a wrong address", write_to_null, SIGSEGV},
      {"a wrong address in another thread", [&] { in_another_thread(write_to_null); }, SIGSEGV},
      {"a wrong address in the servo's own thread", [&] { witness.crash_in_exchange = true; }, SIGSEGV},
      {"abort", [] { std::abort(); }, SIGABRT},
      {"terminate", [] { std::terminate(); }, SIGABRT},
      {"an exception that nobody catches, in another thread",
       [&] { in_another_thread([] { throw std::bad_alloc(); }); }, SIGABRT},
      {"no memory left", [&] { in_another_thread(fail_to_allocate); }, SIGABRT},
      {"a stack that overflows", [] { overflow(0); }, SIGSEGV},
      {"exit in a library", [] { std::exit(1); }, 0},
      {"SIGHUP", [] { raise(SIGHUP); }, SIGHUP},
      {"SIGPIPE", [] { raise(SIGPIPE); }, SIGPIPE},
      {"SIGQUIT", [] { raise(SIGQUIT); }, SIGQUIT},
  };
  for (const Way& way : ways) {
    CAPTURE(std::string(way.name));
    const int status = outcome(witness, way.end);
    CHECK(witness.most_n > 0.5);
    CHECK(witness.last_n == 0.0);
    CHECK(witness.last_was_stop);
    if (way.signal == 0) {
      CHECK(WIFEXITED(status));
      CHECK(WEXITSTATUS(status) == 1);
    } else {
      CHECK(WIFSIGNALED(status));
      CHECK(WTERMSIG(status) == way.signal);
    }
    MESSAGE(std::string(way.name) << ": zero force after "
                                  << static_cast<double>(witness.last_ns - witness.ended_ns) * 1e-6 << " ms");
  }
  for (const bool in_its_thread : {false, true}) {
    CAPTURE(in_its_thread);
    const auto end = [&] { in_its_thread ? void(witness.crash_in_exchange = true) : std::abort(); };
    outcome(witness, end, 0, true);
    CHECK(witness.most_n > 0.5);
    CHECK(witness.last_n == 0.0);
    CHECK(witness.last_was_stop);
  }
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    const int status = outcome(
        witness, [] {}, signal);
    CAPTURE(signal);
    CHECK(WIFSIGNALED(status));
    CHECK(witness.most_n > 0.5);
    CHECK(witness.last_n == 0.0);
    CHECK(witness.last_was_stop);
  }
  munmap(&witness, sizeof witness);
}

namespace {

/// In the parent, once it pushes: suspended as by Ctrl-Z, looked at, and let go on. -1: the machine was too slow.
int suspend_once(Witness& witness, bool called) {
  new (&witness) Witness;
  std::cout.flush();
  const pid_t child = fork();
  if (child == 0) {
    setpgid(0, 0);  // a group of its own, as a shell gives it: an orphaned one is not suspended
    push_until(
        witness, [] {}, called);
  }
  int status = 0;
  while (witness.ended_ns == 0) {
    if (waitpid(child, &status, WNOHANG) == child) return -1;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const std::int64_t asked_ns = monotonic_ns();
  kill(child, SIGTSTP);
  while (waitpid(child, &status, WUNTRACED) < 0 && errno == EINTR) {}
  MESSAGE("suspended after " << static_cast<double>(monotonic_ns() - asked_ns) * 1e-6 << " ms, zero force after "
                             << static_cast<double>(witness.last_ns - asked_ns) * 1e-6 << " ms");
  if (!WIFSTOPPED(status)) return -1;
  CHECK(WSTOPSIG(status) == SIGTSTP);
  CHECK(witness.most_n > 0.5);
  CHECK(witness.last_n == 0.0);
  CHECK(witness.last_was_stop);
  const int then = witness.exchanges;
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  CHECK(witness.exchanges == then);
  witness.most_n = 0.0;
  kill(child, SIGCONT);
  while (witness.exchanges < then + 300) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  CHECK(witness.most_n == 0.0);  // the finger is 1 mm deep
  kill(child, SIGTERM);
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {}
  CHECK(WIFSIGNALED(status));
  CHECK(WTERMSIG(status) == SIGTERM);
  return 0;
}

/// A shell's part: a job on a terminal of its own, in the foreground. The number of the first thing that was wrong.
int run_on_terminal(int slave) {
  const auto raw = [slave] {
    termios now{};
    tcgetattr(slave, &now);
    return (now.c_lflag & (ICANON | ECHO)) == 0;
  };
  const auto waits_for = [](const std::function<bool()>& what) {
    for (int ms = 0; ms < 20'000 && !what(); ++ms) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return what();
  };
  setsid();
  if (ioctl(slave, TIOCSCTTY, 0) != 0) return 1;
  dup2(slave, STDIN_FILENO);
  std::signal(SIGTTOU, SIG_IGN);
  const pid_t job = fork();
  if (job == 0) {
    setpgid(0, 0);
    for (int signal = 1; signal < NSIG; ++signal) std::signal(signal, SIG_DFL);
    while (tcgetpgrp(STDIN_FILENO) != getpgrp()) std::this_thread::yield();
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    install_crash_stop();
    const RawTerminal terminal;
    for (;;) pause();
  }
  setpgid(job, job);
  if (tcsetpgrp(slave, job) != 0) return 2;
  if (raw() || !waits_for(raw)) return 3;
  int status = 0;
  kill(job, SIGTSTP);
  if (waitpid(job, &status, WUNTRACED) != job || !WIFSTOPPED(status)) return 4;
  if (raw()) return 5;
  kill(job, SIGCONT);
  if (!waits_for(raw)) return 6;
  kill(job, SIGQUIT);
  if (waitpid(job, &status, 0) != job || !WIFSIGNALED(status)) return 7;
  return raw() ? 8 : 0;
}

}  // namespace

TEST_CASE("suspended, the last command is zero force, and it goes on disarmed") {
  Witness& witness = shared_witness();
  for (const bool called : {false, true}) {
    CAPTURE(called);
    int done = -1;
    for (int attempt = 0; attempt < 20 && done < 0; ++attempt) done = suspend_once(witness, called);
    CHECK(done == 0);
  }
  munmap(&witness, sizeof witness);
}

TEST_CASE("a terminal that gives single keys is itself again while the program is suspended, and after SIGQUIT") {
  int master = -1, slave = -1;
  REQUIRE(openpty(&master, &slave, nullptr, nullptr, nullptr) == 0);
  std::cout.flush();
  const pid_t shell = fork();
  if (shell == 0) _exit(run_on_terminal(slave));
  int status = 0;
  while (waitpid(shell, &status, 0) < 0 && errno == EINTR) {}
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  close(slave);
  close(master);
}

#endif
