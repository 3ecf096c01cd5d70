#include "workbench/bringup/guided_runner.h"

#include "devices/base/mailbox.h"
#include "devices/device_safety.h"
#include "workbench/bringup/bring_up.h"
#include "workbench/bringup/force_calibration.h"
#include "workbench/bringup/guided_hand.h"
#include "workbench/session/crash_stop.h"
#include "workbench/session/deadline_pacer.h"
#include "workbench/session/servo_clock.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>

#include <pthread.h>

namespace tangent {
namespace {

constexpr int kPriority = 40;                  // as the servo's
constexpr std::chrono::seconds kStopAfter{2};  // an exchange that does not return: the device's other way to stop,
constexpr std::chrono::milliseconds kLeaveAfter{8000};  // and then it is left alone,
constexpr std::chrono::milliseconds kLast{100};         // sooner where it has hung for long already
constexpr std::int64_t kHangs_ns = 50'000'000;          // an exchange that is under way for so long
constexpr int kLastExchanges = 3;                       // with zero force, after a stop

}  // namespace

template <class Machine>
struct GuidedRunner<Machine>::Impl {
  struct Shown {
    View view;
    bool settled = false;
  };
  Impl(std::unique_ptr<ForceDevice> given, const GuidedRunOptions<Machine>& wanted)
      : device(std::move(given)),
        options(wanted),
        machine(*device, options.limits),
        hand(device->hand()),
        pacer(options.limits.rate_hz, true) {}

  void tick(double dt_s) noexcept {
    hand.follow(machine.view(), dt_s);
    machine.tick(dt_s);
    shown.put({machine.view(), hand.settled(machine.view())});
  }
  void tick_by_clock() noexcept {
    const std::int64_t now_ns = clock.now_ns();
    const double dt_s = last_ns == 0 ? 1.0 / options.limits.rate_hz : 1e-9 * static_cast<double>(now_ns - last_ns);
    last_ns = now_ns;
    begun_ns.store(now_ns, std::memory_order_relaxed);
    tick(std::max(dt_s, 1e-6));
    begun_ns.store(0, std::memory_order_relaxed);
  }
  /// Stops for good where the process is to end or to be suspended (crash_stop.h). Thread of the ticks.
  void obey_process(RunningServo& servo) noexcept {
    if (!servos_are_to_end() && !servos_are_to_wait()) return servo.goes_on();
    machine.stop();
    if (!machine.view().ended || machine.view().sent_n != Vec3(0.0)) return;
    if (servos_are_to_end()) return servo.ended();
    servo.waits();
  }
  static void release(void* self) noexcept {  // on the thread of the ticks, which crashed
    static_cast<void>(static_cast<Impl*>(self)->device->exchange({}, 1e-3));
  }
  void run() noexcept;
  void called() noexcept;
  void watch_exchange() noexcept;
  bool hangs() noexcept;
  Status begin();
  bool end();  // false: an exchange does not return

  std::unique_ptr<ForceDevice> device;
  GuidedRunOptions<Machine> options;
  Machine machine;
  GuidedHand hand;
  Mailbox<Shown> shown;
  Shown seen;
  DeadlinePacer pacer;
  MonotonicClock clock;
  bool given_up = false;  // it hung for too long, and has ended by that; owner's thread
  std::int64_t last_ns = 0;
  std::atomic<bool> ending{false};
  std::thread thread;
  std::mutex over_lock;
  std::condition_variable over_changed;
  bool over = false;
  std::atomic<std::int64_t> begun_ns{0};  // of the tick under way; 0: none is
  std::optional<RunningServo> running;    // of a driver that calls us
};

template <class Machine>
void GuidedRunner<Machine>::Impl::run() noexcept {
  sched_param priority{};
  priority.sched_priority = kPriority;
  static_cast<void>(pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority));  // refused: the rate says it
  leave_suspending_to_others();
  {
    const AlternateStack stack;
    RunningServo here_runs(&Impl::release, this);
    const RunningServo::Here here(here_runs);
    pacer.start(clock.now_ns());
    for (int left = kLastExchanges; left > 0; left -= ending.load(std::memory_order_relaxed) ? 1 : 0) {
      clock.sleep_until(pacer.deadline_ns());
      static_cast<void>(pacer.begin(clock.now_ns()));
      tick_by_clock();
      obey_process(here_runs);
    }
  }
  const std::lock_guard lock(over_lock);
  over = true;
  over_changed.notify_all();
}

template <class Machine>
void GuidedRunner<Machine>::Impl::called() noexcept {
  thread_local bool new_here = true;
  if (std::exchange(new_here, false)) leave_suspending_to_others();
  const RunningServo::Here here(*running);
  tick_by_clock();
  obey_process(*running);
}

// By the owner, who looks for the view: the device is told to stop by another way where it has one.
template <class Machine>
void GuidedRunner<Machine>::Impl::watch_exchange() noexcept {
  const std::int64_t begun = begun_ns.load(std::memory_order_relaxed);
  if (begun != 0 && clock.now_ns() - begun > kHangs_ns && seen.view.sent_n != Vec3(0.0)) device->emergency_stop();
}

template <class Machine>
bool GuidedRunner<Machine>::Impl::hangs() noexcept {
  const std::int64_t begun = begun_ns.load(std::memory_order_relaxed);
  return begun != 0 && 1e-9 * static_cast<double>(clock.now_ns() - begun) > options.hangs_after_s;
}

template <class Machine>
Status GuidedRunner<Machine>::Impl::begin() {
  if (!options.threaded) return {};
  if (device->calls_us()) {
    running.emplace(&Impl::release, this);
    return device->start_calling({[](void* context) noexcept { static_cast<Impl*>(context)->called(); }, this});
  }
  try {
    thread = std::thread([this]() noexcept { run(); });
  } catch (const std::system_error&) {
    return fail("no thread could be started", "guided run", "end other programs, or raise the limit on threads");
  }
  return {};
}

template <class Machine>
bool GuidedRunner<Machine>::Impl::end() {
  machine.stop();
  if (!options.threaded) {
    for (int i = 0; i < kLastExchanges; ++i) tick(1.0 / options.limits.rate_hz);
  } else if (thread.joinable()) {
    ending = true;
    std::unique_lock lock(over_lock);
    const bool waited = hangs();  // long enough
    if (!over_changed.wait_for(lock, waited ? std::chrono::seconds{} : kStopAfter, [this] { return over; })) {
      device->emergency_stop();
      if (!over_changed.wait_for(lock, waited ? kLast : kLeaveAfter, [this] { return over; }))
        return thread.detach(), false;
    }
    lock.unlock();
    thread.join();
  } else if (device->calls_us()) {
    device->stop_calling();
    running.reset();
    for (int i = 0; i < kLastExchanges; ++i) tick(1.0 / options.limits.rate_hz);
  }
  device->close();
  return true;
}

template <class Machine>
GuidedRunner<Machine>::GuidedRunner(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

template <class Machine>
GuidedRunner<Machine>::~GuidedRunner() {
  if (!impl_->end()) static_cast<void>(impl_.release());  // its thread still uses it
}

template <class Machine>
Result<std::unique_ptr<GuidedRunner<Machine>>> GuidedRunner<Machine>::start(std::unique_ptr<ForceDevice> device,
                                                                            const GuidedRunOptions<Machine>& options) {
  if (!options.threaded && !device->capabilities().simulated)
    return fail("keeps real time", device->capabilities().name, "leave simulated time out");
  if (const Status opened = open_device(*device); !opened) return tl::unexpected(opened.error());
  std::unique_ptr<GuidedRunner> runner(new GuidedRunner(std::make_unique<Impl>(std::move(device), options)));
  if (const Status begun = runner->impl_->begin(); !begun) return tl::unexpected(begun.error());
  return runner;
}

template <class Machine>
const typename GuidedRunner<Machine>::View& GuidedRunner<Machine>::view() {
  impl_->shown.take(impl_->seen);
  impl_->watch_exchange();
  if (!impl_->given_up && !impl_->seen.view.ended && impl_->hangs()) {
    impl_->given_up = true;
    impl_->machine.stop();  // an exchange that comes back after all is followed by none with force
  }
  if (impl_->given_up) impl_->seen.view.end_with(BringUpWhy::hangs);
  return impl_->seen.view;
}

template <class Machine>
const ForceCapabilities& GuidedRunner<Machine>::capabilities() const {
  return impl_->device->capabilities();
}

template <class Machine>
void GuidedRunner<Machine>::answer(typename Machine::Answer answer) {
  impl_->machine.answer(answer, impl_->seen.view.questions);
}

template <class Machine>
void GuidedRunner<Machine>::stop() {
  impl_->machine.stop();
}

template <class Machine>
std::string GuidedRunner<Machine>::serial() const {
  LinkReport link;
  const std::string& said = impl_->device->capabilities().serial;
  return said.empty() && impl_->device->report(link) ? link.serial : said;
}

template <class Machine>
bool GuidedRunner<Machine>::settled() const {
  return impl_->seen.settled;
}

template <class Machine>
void GuidedRunner<Machine>::advance(std::uint64_t ticks) {
  if (impl_->options.threaded) return;
  for (std::uint64_t i = 0; i < ticks; ++i) impl_->tick(1.0 / impl_->options.limits.rate_hz);
}

template <class Machine>
std::string GuidedRunner<Machine>::link_problem() const {
  LinkReport link;
  return impl_->device->report(link) ? link.problem : std::string();
}

template class GuidedRunner<BringUp>;
template class GuidedRunner<ForceCalibration>;

}  // namespace tangent
