// The library; tests/CMakeLists.txt builds it, and once more without hdEndFrame and hdUnschedule (STUB_LACKS).
#include "tests/devices/openhaptics/stub_hd.h"

#include <cstring>
#include <ctime>
#include <mutex>
#include <new>
#include <thread>

using tangent::test::StubHd;

namespace {

using Callback = unsigned (*)(void*);
struct ErrorInfo {
  unsigned code;
  int internal;
  unsigned device;
};

constexpr unsigned kTheDevice = 1, kNoDevice = 0xFFFFFFFF;

StubHd script;
std::mutex in_turn;  // hdStopScheduler returns after the last call
std::mutex guard;    // of what follows
std::vector<unsigned> errors;
std::vector<std::string> calls;
Callback callback = nullptr;
void* context = nullptr;
bool was_pushing = false;
std::atomic<bool> running{false};
int frames_since_start = 0;  // scheduler's thread
thread_local bool in_scheduler = false;
thread_local bool in_frame = false;
std::thread scheduler;

void note_call(const std::string& call) {
  const std::lock_guard lock(guard);
  calls.push_back(call);
}

void push_error(unsigned code) {
  const std::lock_guard lock(guard);
  errors.push_back(code);
}

void broke(const char* rule) {
  if (script.broken_rules.fetch_add(1) != 0) return;
  const std::lock_guard lock(guard);
  script.first_broken = rule;
}

void turn() {
  const std::lock_guard one(in_turn);
  Callback now = nullptr;
  void* with = nullptr;
  {
    const std::lock_guard lock(guard);
    now = callback;
    with = context;
  }
  if (now == nullptr || (!running && !script.calls_late) || script.silent) return;
  in_scheduler = true;
  now(with);
  in_scheduler = false;
}

void keep_calling() {
  timespec due{};
  clock_gettime(CLOCK_MONOTONIC, &due);
  while (running) {
    due.tv_nsec += 1'000'000;
    if (due.tv_nsec >= 1'000'000'000) due.tv_sec += 1, due.tv_nsec -= 1'000'000'000;
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr);
    turn();
  }
}

std::vector<std::string> copy_of_log() {
  const std::lock_guard lock(guard);
  return calls;
}

void start_anew() {
  script.~StubHd();
  new (&script) StubHd;
  script.log = copy_of_log;
  script.step = turn;
  script.reset = start_anew;
  const std::lock_guard lock(guard);
  errors.clear();
  calls.clear();
  callback = nullptr;
  was_pushing = false;
}

}  // namespace

// NOLINTBEGIN(readability-identifier-naming): the published names.
extern "C" {

StubHd* tangent_stub_hd() {
  start_anew();
  return &script;
}

unsigned hdInitDevice(const char* name) {
  note_call(name == nullptr ? "init" : std::string("init ") + name);
  if (script.unplugged) push_error(0x0302);
  if (script.init_error != 0) push_error(script.init_error);
  const bool there = name == nullptr || std::strcmp(name, script.name) == 0;
  return there && !script.unplugged && script.init_error == 0 ? kTheDevice : kNoDevice;
}

void hdDisableDevice(unsigned device) {
  if (running) broke("device disabled while the scheduler runs");
  note_call("disable device");
  if (device != kTheDevice) push_error(0x0104);
}

void hdBeginFrame(unsigned) {
  if (!in_scheduler) broke("frame outside the scheduler's thread");
  if (in_frame) broke("frame within a frame");
  in_frame = true;
  if (script.unplugged) push_error(0x0302);
  if (script.frame_error != 0) push_error(script.frame_error);
}

#ifndef STUB_LACKS
void hdEndFrame(unsigned) {
  if (!in_frame) broke("frame ended that was not begun");
  in_frame = false;
  if (frames_since_start++ < script.frames_refused) push_error(0x0401);
  ++script.frames;
}

void hdUnschedule(unsigned long handle) {
  note_call("unschedule");
  const std::lock_guard lock(guard);
  if (handle == 5 && !script.calls_late) callback = nullptr;
}
#endif

void hdEnable(unsigned what) { note_call(what == 0x4000 ? "enable force" : "enable ?"); }
void hdDisable(unsigned what) { note_call(what == 0x4000 ? "disable force" : "disable ?"); }

void hdGetDoublev(unsigned what, double* values) {
  const auto copy = [values](const auto& from) { std::memcpy(values, from, sizeof from); };
  switch (what) {
    case 0x2050:
      return copy(script.position_mm);
    case 0x2051:
      return copy(script.velocity_mm_per_s);
    case 0x2052:
      return copy(script.transform);
    case 0x2550:
      return copy(script.reach_mm);
    case 0x2551:
      return copy(script.usable_mm);
    case 0x2602:
      *values = script.max_stiffness_n_per_mm;
      return;
    case 0x2603:
      *values = script.max_force_n;
      return;
    case 0x2604:
      *values = script.continuous_force_n;
      return;
    default:
      push_error(0x0100);
  }
}

void hdGetIntegerv(unsigned what, int* values) {
  switch (what) {
    case 0x2000:
      *values = script.buttons;
      return;
    case 0x2553:
      *values = script.dof;
      return;
    case 0x2555:
      *values = script.styles;
      return;
    default:
      push_error(0x0100);
  }
}

const char* hdGetString(unsigned what) {
  switch (what) {
    case 0x2500:
      return script.version;
    case 0x2501:
      return script.model;
    case 0x2502:
      return "2023.11";
    case 0x2504:
      return script.serial;
    default:
      push_error(0x0100);
      return nullptr;
  }
}

void hdSetDoublev(unsigned what, const double* values) {
  if (what != 0x2700) return push_error(0x0100);
  if (!in_frame) broke("force outside a frame");
  std::memcpy(script.force_n, values, sizeof script.force_n);
  const bool pushes = values[0] != 0.0 || values[1] != 0.0 || values[2] != 0.0;
  if (pushes != was_pushing) note_call(pushes ? "force" : "zero force");
  was_pushing = pushes;
}

ErrorInfo hdGetError() {
  const std::lock_guard lock(guard);
  if (errors.empty()) return {0, 0, kNoDevice};
  const unsigned code = errors.back();
  errors.pop_back();
  return {code, -1, kTheDevice};
}

unsigned hdCheckCalibration() {
  if (!in_scheduler || !in_frame) broke("calibration checked outside a frame");
  return script.calibration;
}

void hdUpdateCalibration(unsigned style) {
  script.calibrated_with = style;
  note_call("calibrate");
  if (script.calibrates_when_told) script.calibration = 0x5000;
}

unsigned long hdScheduleAsynchronous(Callback function, void* with, unsigned short) {
  note_call("schedule");
  const std::lock_guard lock(guard);
  callback = function;
  context = with;
  return 5;
}

void hdSetSchedulerRate(unsigned long rate_hz) { note_call("rate " + std::to_string(rate_hz)); }

void hdStartScheduler() {
  note_call("start");
  if (running.exchange(true)) return;
  frames_since_start = 0;
  if (script.own_thread) scheduler = std::thread(keep_calling);
}

void hdStopScheduler() {
  running = false;
  if (scheduler.joinable()) scheduler.join();
  { const std::lock_guard after_the_last(in_turn); }
  note_call("stop");
}
}
// NOLINTEND(readability-identifier-naming)
