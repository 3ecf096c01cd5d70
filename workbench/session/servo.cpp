#include "workbench/session/servo.h"

#include "workbench/session/crash_stop.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <utility>

namespace tangent {

namespace {

/// Whether memory can be locked without a limit: with a limit, allocations beyond it would fail in the whole program.
bool may_lock_all() noexcept {
  rlimit limit{};
  return geteuid() == 0 || (getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY);
}

/// So that no tick is the first to use a page of its stack. Far more than a tick takes.
void touch_stack() noexcept {
  constexpr std::size_t kBytes = 128 * 1024, kPage = 4096;
  volatile unsigned char room[kBytes];
  for (std::size_t i = 0; i < kBytes; i += kPage) room[i] = 0;
  static_cast<void>(room[0]);
}

}  // namespace

Servo::Servo(ServoTick& tick, ServoStatistics& statistics, const ServoOptions& options, ServoClock& clock,
             ForceDevice* scheduler)
    : tick_(tick),
      statistics_(statistics),
      options_(options),
      clock_(clock),
      pacer_(options.rate_hz, options.time_by_deadlines),
      call_pacer_(options.rate_hz),
      scheduler_(scheduler) {
  pacer_.start(0);
}

Status Servo::start() {
  if (running()) return {};
  stopping_.store(false);
  ended_.store(false);
  statistics_.restart_rate();
  if (scheduler_ == nullptr) {
    thread_ = std::thread([this]() noexcept { loop(); });
  } else if (const Status called = start_called(); !called) {
    return called;
  }
  if (!options_.watch_exchanges) return {};
  wait_for_links();
  watching_.store(true, std::memory_order_relaxed);
  watching_thread_ = std::thread([this]() noexcept { watch(); });
  return {};
}

Status Servo::start_called() {
  call_pacer_.start();
  running_.emplace(&Servo::release_one, this);
  const Status started =
      scheduler_->start_calling({[](void* servo) noexcept { static_cast<Servo*>(servo)->run_called(); }, this});
  called_ = started.has_value();
  if (!called_) running_.reset();
  return started;
}

/// Whether the servo's exchange is beyond waiting for. A servo that is late for another reason is waited for.
bool Servo::in_exchange_for_good() noexcept {
  MonotonicClock clock;
  constexpr std::int64_t kLook_ns = 1'000'000;
  // Sequentially consistent, like the stores: a call that begins now sees that it is to stop.
  while (called_ ? in_call_.load() : !ended_.load()) {
    const std::int64_t now_ns = clock.now_ns();
    if (static_cast<double>(tick_.exchange_watch().lasts_ns(now_ns)) > 1e9 * options_.longest_stop_s) return true;
    clock.sleep_until(now_ns + kLook_ns);
  }
  return false;
}

Servo::~Servo() {
  while (!stop()) {}
}

bool Servo::stop() {
  if (!running()) return true;
  stopping_.store(true);
  if (in_exchange_for_good()) return false;
  if (called_) {
    scheduler_->stop_calling();
    called_ = false;
    release();
    running_.reset();
  } else {
    thread_.join();
  }
  watching_.store(false, std::memory_order_relaxed);  // after the last exchange
  if (watching_thread_.joinable()) watching_thread_.join();
  return true;
}

void Servo::leave_behind() noexcept {
  watching_.store(false, std::memory_order_relaxed);
  if (watching_thread_.joinable()) watching_thread_.detach();
  if (thread_.joinable()) thread_.detach();
}

void Servo::run_one() noexcept { tick_.run(pacer_.begin(pacer_.deadline_ns())); }

// Without these the servo runs with more jitter; the user is shown what was granted.
void Servo::ask_for_realtime() noexcept {
  pthread_setname_np(pthread_self(), "servo");
  prctl(PR_SET_TIMERSLACK, 1UL);  // ns; the default slack delays wake-ups by up to 50 us
  if (!options_.realtime) return;
  sched_param priority{};
  priority.sched_priority = options_.fifo_priority;
  fifo_.store(pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority) == 0);
  // ONFAULT: pages are locked once touched; untouched ones are not loaded.
  locked_.store(may_lock_all() && mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0);
  touch_stack();
  if (options_.cpu < 0) return;
  cpu_set_t only;
  CPU_ZERO(&only);
  CPU_SET(static_cast<std::size_t>(options_.cpu), &only);
  on_cpu_.store(pthread_setaffinity_np(pthread_self(), sizeof only, &only) == 0);
}

bool Servo::ends() const noexcept { return stopping_.load(std::memory_order_relaxed) || servos_are_to_end(); }

// The device's driver has chosen its thread's priority.
void Servo::run_called() noexcept {
  struct InCall {
    std::atomic<bool>& flag;
    explicit InCall(std::atomic<bool>& in) : flag(in) { flag.store(true); }
    ~InCall() { flag.store(false); }
  } const in_call(in_call_);
  if (stopping_.load()) return;
  thread_local bool new_here = true;
  if (std::exchange(new_here, false)) leave_suspending_to_others();
  const RunningServo::Here here(*running_);
  if (servos_are_to_end()) {
    release();  // again with every call, until nobody calls any more
    return running_->ended();
  }
  if (servos_are_to_wait()) {
    tick_.suspend(1.0 / options_.rate_hz);  // again with every call
    call_pacer_.start();
    return running_->waits();
  }
  running_->goes_on();
  const std::int64_t now_ns = clock_.now_ns();
  statistics_.note_start(now_ns);
  tick_.run(call_pacer_.begin(now_ns));
}

// Above the servo's priority: the servo may spin in the exchange that hangs. By the real clock, as the tick is.
void Servo::watch() noexcept {
  pthread_setname_np(pthread_self(), "servo watch");
  sched_param priority{};
  priority.sched_priority = options_.fifo_priority + 1;
  if (options_.realtime) pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority);
  MonotonicClock clock;
  while (watching_.load(std::memory_order_relaxed)) {
    const std::int64_t now_ns = clock.now_ns();
    tick_.exchange_watch().look(now_ns);
    clock.sleep_until(now_ns + ExchangeWatch::kLook_ns);
  }
}

/// Until the process goes on after it was suspended; the deadlines start anew.
void Servo::wait_suspended(RunningServo& running) noexcept {
  constexpr std::int64_t kLook_ns = 5'000'000;
  tick_.suspend(1.0 / options_.rate_hz);
  running.waits();
  while (servos_are_to_wait() && !ends()) clock_.sleep_until(clock_.now_ns() + kLook_ns);
  running.goes_on();
  pacer_.start(clock_.now_ns());
}

void Servo::loop() noexcept {
  ask_for_realtime();
  leave_suspending_to_others();
  const AlternateStack stack;
  RunningServo running(&Servo::release_one, this);
  const RunningServo::Here here(running);
  pacer_.start(clock_.now_ns());
  while (!ends()) {
    clock_.sleep_until(pacer_.deadline_ns());
    if (ends()) break;
    if (servos_are_to_wait()) {
      wait_suspended(running);
      continue;
    }
    const std::int64_t now_ns = clock_.now_ns();
    statistics_.note_start(now_ns);
    tick_.run(pacer_.begin(now_ns));
  }
  release();
  running.ended();
  ended_.store(true);
}

}  // namespace tangent
