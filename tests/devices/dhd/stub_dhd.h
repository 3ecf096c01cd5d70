// A stand-in for Force Dimension's libdhd.so: the published function names alone, with a script and a log.
#pragma once

#include <array>
#include <atomic>
#include <string>
#include <vector>

namespace tangent::test {

struct StubDhd {
  // The script. Set while nothing runs, but for the atomics.
  int major = 3, minor = 14;
  std::atomic<int> count{1};  ///< of attached devices
  int serials[2] = {1234, 1235};
  int types[2] = {33, 104};        ///< omega.3, sigma.7
  std::atomic<int> open_error{0};  ///< of dhdOpenID and dhdOpenSerial
  std::atomic<bool> unplugged{false};
  bool wrist = false;
  double position_m[3] = {0.0, 0.0, 0.0};
  double velocity_m_per_s[3] = {0.0, 0.0, 0.0};
  double matrix[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  unsigned buttons = 0;
  unsigned char watchdog = 240;          ///< 125 us each
  std::atomic<int> call_error{0};        ///< that every call to the device has
  std::atomic<int> position_returns{0};  ///< 1: the time guard
  std::atomic<bool> calibrated{true}, force_on{false}, broken{false};
  std::atomic<int> force_off_cause{0};

  // What happened.
  std::array<std::atomic<double>, 3> force_n{};
  std::atomic<int> forces{0};

  /// The calls that are not of every exchange, in order, and every change between a force and none.
  std::vector<std::string> (*log)() = nullptr;
  /// Everything as at first. While nothing runs.
  void (*reset)() = nullptr;
};

}  // namespace tangent::test
