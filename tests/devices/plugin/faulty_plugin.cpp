// A plug-in for the tests: a handle that rests, and goes wrong in the way and at the tick that its settings name. It is
// another plug-in, too, when its file is called so.
//
//   fault=NAME at=TICK for=TICKS   from that tick of the servo on, for so many ticks
//   log=FILE                       appends a word for each call but exchange
//   hoard=MB                       allocates so much in open
#include "devices/plugin/tangent_device.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <thread>

namespace {

struct Handle {
  std::string fault, log;
  std::uint64_t at = 0, lasts = 0;
  double time_s = 0.0;
  std::atomic<int> stops{0};
  std::atomic<bool> leaks{false};
  std::atomic<bool> faulted{false};
  double force_n[3] = {0.0, 0.0, 0.0};

  bool is(const char* name) const { return fault == name; }
  void note(const char* word) const {
    if (log.empty()) return;
    const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    if (file < 0) return;
    static_cast<void>(::write(file, word, std::strlen(word)) > 0);
    ::close(file);
  }
};

std::string failure = "nothing failed";

std::string setting(const tangent_device_settings* settings, const char* key) {
  for (std::uint32_t i = 0; i < settings->count; ++i)
    if (std::strcmp(settings->keys[i], key) == 0) return settings->values[i];
  return {};
}

int say_capabilities(const tangent_device_settings* settings, tangent_device_capabilities* out) {
  const std::string fault = setting(settings, "fault");
  if (fault == "crash in capabilities") std::abort();
  if (fault == "hangs in capabilities") {
    Handle said;
    said.log = setting(settings, "log");
    said.note((std::to_string(::getpid()) + " ").c_str());
    while (true) ::pause();
  }
  if (fault == "capabilities fail") {
    failure = "the calibration is missing; write handle.toml";
    return 1;
  }
  std::strcpy(out->name, "handle of the tests");
  std::strcpy(out->serial, setting(settings, "serial").c_str());
  out->pushes_along = 7;
  out->buttons = 1;
  out->peak_force_n = fault == "nonsense" ? -1.0 : 5.0;
  for (double& half : out->workspace_half_size_m) half = 0.1;
  out->rate_hz = 1000.0;
  out->firmware_timeout_s = 0.05;
  return 0;
}

constexpr std::size_t kPiece = std::size_t{1} << 20;

/// A piece of memory that is used, so that it can't be had for nothing.
void* volatile last_piece = nullptr;
bool take_piece() {
  void* piece = std::malloc(kPiece);
  if (piece == nullptr) return false;
  last_piece = std::memset(piece, 1, kPiece);
  return true;
}

bool hoard(const tangent_device_settings* settings) {
  const std::string mb = setting(settings, "hoard");
  for (unsigned long i = 0; i < std::strtoul(mb.c_str(), nullptr, 10); ++i) {
    if (take_piece()) continue;
    failure = "no room for the pictures";
    return false;
  }
  return true;
}

/// In a thread of its own, which a plug-in may have: from the tick of the fault on, until new throws.
void leak_later(Handle& handle) {
  std::thread([&handle] {
    while (!handle.leaks) ::usleep(1000);
    for (;;) last_piece = std::memset(new char[kPiece], 1, kPiece);
  }).detach();
}

int open_handle(const tangent_device_settings* settings, void** device) {
  const std::string fault = setting(settings, "fault");
  if (fault == "crash in open") std::abort();
  if (fault == "open fails") {
    failure = "no handle on the desk; plug it in";
    return 1;
  }
  while (fault == "open hangs") ::pause();
  if (!hoard(settings)) return 1;
  auto* handle = new Handle;
  handle->fault = fault;
  handle->log = setting(settings, "log");
  handle->at = std::strtoull(setting(settings, "at").c_str(), nullptr, 10);
  handle->lasts = std::strtoull(setting(settings, "for").c_str(), nullptr, 10);
  handle->note("open ");
  if (fault == "leaks") leak_later(*handle);
  *device = handle;
  return 0;
}

void take_all_memory(Handle& handle) {
  while (take_piece()) {}
  handle.note((std::to_string(::getpid()) + " ").c_str());
  if (handle.is("allocates all and does not look")) last_piece = std::memset(std::malloc(kPiece), 1, kPiece);
}

void go_wrong(Handle& handle, tangent_device_sample* sample) {
  if (handle.is("crash")) std::abort();
  if (handle.is("exit")) std::_Exit(3);
  if (handle.is("killed")) ::raise(SIGKILL);
  while (handle.is("hang")) ::pause();
  while (handle.is("spins")) handle.leaks = true;
  if (handle.is("leaks")) handle.leaks = true;
  if (handle.is("allocates all") || handle.is("allocates all and does not look")) take_all_memory(handle);
  if (handle.is("waits for stop")) {
    handle.note("waits ");
    while (handle.stops == 0) ::usleep(1000);
  }
  if (handle.is("nan")) sample->position_m[1] = std::numeric_limits<double>::quiet_NaN();
  if (handle.is("infinite time")) sample->time_s = std::numeric_limits<double>::infinity();
  if (handle.is("nan force")) sample->force_n[0] = std::numeric_limits<double>::quiet_NaN();
  if (handle.is("outside")) sample->position_m[2] = 0.4;
  if (handle.is("backwards")) sample->time_s -= 0.5;
  if (handle.is("no such state")) sample->state = 17;
  if (handle.is("negative age")) sample->age_s = -1.0;
  if (handle.is("unplugged")) sample->state = TANGENT_DEVICE_ABSENT;
  if (handle.is("allocates")) {
    void* volatile memory = std::malloc(100);
    std::free(memory);
  }
}

int exchange_handle(void* device, const tangent_device_command* command, tangent_device_sample* sample) {
  auto& handle = *static_cast<Handle*>(device);
  const bool now = command->tick >= handle.at && command->tick - handle.at < handle.lasts;
  if (!(now && handle.is("stuck"))) handle.time_s += command->dt_s;
  if (command->request == TANGENT_DEVICE_CLEAR_FAULT) handle.faulted = false;
  std::memcpy(handle.force_n, command->force_n, sizeof handle.force_n);
  sample->state = handle.faulted ? TANGENT_DEVICE_FAULTED : TANGENT_DEVICE_READY;
  sample->fault = handle.faulted ? TANGENT_DEVICE_ACTUATOR : TANGENT_DEVICE_NO_FAULT;
  sample->time_s = handle.time_s;
  for (double& x : sample->position_m) x = 0.01;
  std::memcpy(sample->force_n, handle.force_n, sizeof sample->force_n);
  if (!now) return 0;
  go_wrong(handle, sample);
  if (!handle.is("lost")) return 0;
  failure = "the cable is out; plug it in again";
  return 1;
}

void stop_handle(void* device) {
  auto& handle = *static_cast<Handle*>(device);
  if (handle.is("slow stop") && handle.stops == 0) {
    handle.note("stopping ");
    ::usleep(200'000);
  }
  handle.note("stop ");
  ++handle.stops;  // what waits for it goes on after the note
}

void close_handle(void* device) {
  auto* handle = static_cast<Handle*>(device);
  handle->note("close ");
  delete handle;
}

const char* say_error(void*) { return failure.c_str(); }

/// What this file is called, without what is after a dot.
std::string own_name() {
  Dl_info info{};
  ::dladdr(reinterpret_cast<void*>(&say_error), &info);
  const std::string path = info.dli_fname;
  const std::size_t slash = path.rfind('/');
  return path.substr(slash + 1, path.find('.', slash) - slash - 1);
}

}  // namespace

extern "C" const tangent_device_plugin* tangent_device_entry(std::uint32_t) {
  static tangent_device_plugin table = {
      sizeof table, TANGENT_DEVICE_VERSION, say_capabilities, open_handle, exchange_handle,
      stop_handle,  close_handle,           say_error};
  const std::string name = own_name();
  if (name == "old") table.version = TANGENT_DEVICE_VERSION - 1;
  if (name == "small") table.size = 16;
  if (name == "lacking") table.stop = nullptr;
  if (name == "crashing") std::abort();
  return name == "refusing" ? nullptr : &table;
}
