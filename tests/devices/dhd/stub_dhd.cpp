// The library; tests/CMakeLists.txt builds it, and once more without dhdGetStatus (STUB_LACKS).
#include "tests/devices/dhd/stub_dhd.h"

#include <mutex>
#include <new>

using tangent::test::StubDhd;

namespace {

constexpr int kCom = 2, kNoDevice = 5;

StubDhd script;
std::mutex guard;  // of what follows
std::vector<std::string> calls;
bool was_pushing = false;
thread_local int last_error = 0;

void note_call(std::string call) {
  const std::lock_guard lock(guard);
  calls.push_back(std::move(call));
}

std::vector<std::string> copy_of_log() {
  const std::lock_guard lock(guard);
  return calls;
}

void start_anew() {
  script.~StubDhd();
  new (&script) StubDhd;
  script.log = copy_of_log;
  script.reset = start_anew;
  const std::lock_guard lock(guard);
  calls.clear();
  was_pushing = false;
}

/// What a call to the device returns.
int answered(int good = 0) {
  const int error = script.unplugged ? kCom : script.call_error.load();
  if (error == 0) return good;
  last_error = error;
  return -1;
}

int opened(int index) {
  const bool there = index >= 0 && index < script.count && !script.unplugged;
  last_error = !there ? kNoDevice : script.open_error.load();
  return last_error == 0 ? index : -1;
}

}  // namespace

// NOLINTBEGIN(readability-identifier-naming): the published names.
extern "C" {

StubDhd* tangent_stub_dhd() {
  start_anew();
  return &script;
}

void dhdGetSDKVersion(int* major, int* minor, int* release, int* revision) {
  *major = script.major;
  *minor = script.minor;
  *release = *revision = 0;
}

int dhdGetDeviceCount() { return script.unplugged ? 0 : script.count.load(); }

int dhdOpenID(char index) {
  note_call("open " + std::to_string(index));
  return opened(index);
}

int dhdOpenSerial(int serial) {
  note_call("open serial " + std::to_string(serial));
  return opened(serial == script.serials[0] ? 0 : serial == script.serials[1] ? 1 : -1);
}

int dhdClose(char id) {
  note_call("close " + std::to_string(id));
  return 0;
}

int dhdStop(char) {
  script.force_off_cause = 4;  // before it is off, and noted when it is
  script.force_on = false;
  note_call("stop");
  return answered();
}

int dhdErrorGetLast() { return last_error; }

int dhdGetSerialNumber(unsigned short* serial, char id) {
  *serial = static_cast<unsigned short>(script.serials[static_cast<int>(id)]);
  return 0;
}

int dhdGetSystemType(char id) { return script.types[static_cast<int>(id)]; }
const char* dhdGetSystemName(char) { return "a new device"; }
bool dhdHasWrist(char) { return script.wrist; }

#ifndef STUB_LACKS
int dhdGetStatus(int* status, char) {
  for (int i = 0; i < 16; ++i) status[i] = 0;
  status[0] = status[1] = 1;
  status[3] = script.calibrated;
  status[5] = script.force_on;
  status[9] = script.broken;
  status[14] = script.force_off_cause;
  return answered();
}
#endif

int dhdEnableForce(unsigned char on, char) {
  note_call(on != 0 ? "enable force" : "disable force");
  script.force_on = on != 0;
  return answered();
}

int dhdGetPosition(double* x, double* y, double* z, char) {
  *x = script.position_m[0];
  *y = script.position_m[1];
  *z = script.position_m[2];
  return answered(script.position_returns);
}

int dhdGetLinearVelocity(double* x, double* y, double* z, char) {
  *x = script.velocity_m_per_s[0];
  *y = script.velocity_m_per_s[1];
  *z = script.velocity_m_per_s[2];
  return answered();
}

int dhdGetOrientationFrame(double matrix[3][3], char) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) matrix[i][j] = script.matrix[i][j];
  return answered();
}

unsigned dhdGetButtonMask(char) { return script.buttons; }

int dhdSetForceAndTorqueAndGripperForce(double fx, double fy, double fz, double tx, double ty, double tz, double fg,
                                        char) {
  const bool pushes = fx != 0.0 || fy != 0.0 || fz != 0.0;
  if (pushes != was_pushing) note_call(pushes ? "force" : "zero force");
  was_pushing = pushes;
  if (tx != 0.0 || ty != 0.0 || tz != 0.0 || fg != 0.0) note_call("torque");
  script.force_n[0] = fx;
  script.force_n[1] = fy;
  script.force_n[2] = fz;
  ++script.forces;
  return answered();
}

int dhdGetWatchdog(unsigned char* value, char) {
  *value = script.watchdog;
  return 0;
}
}
// NOLINTEND(readability-identifier-naming)
