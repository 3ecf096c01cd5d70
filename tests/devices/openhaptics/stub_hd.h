// A stand-in for OpenHaptics' libHD.so: the published function names alone, with a script and a log. It keeps HDAPI's
// rules and says where one was broken: frames in pairs and in the scheduler's thread, a force within a frame,
// calibration in the scheduler's thread.
#pragma once

#include <atomic>
#include <string>
#include <vector>

namespace tangent::test {

struct StubHd {
  // The script. Set while nothing runs, but for the atomics.
  const char* version = "3.4.0";
  const char* name = "Default Device";  ///< in the setup program
  const char* model = "Touch";
  std::atomic<const char*> serial{"TOUCH-7"};
  unsigned init_error = 0;
  double position_mm[3] = {0.0, 30.0, -5.0};
  double velocity_mm_per_s[3] = {0.0, 0.0, 0.0};
  double transform[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  double usable_mm[6] = {-80, -30, -40, 80, 90, 30};
  double reach_mm[6] = {-200, -150, -100, 200, 250, 150};
  double max_force_n = 3.3, continuous_force_n = 0.88, max_stiffness_n_per_mm = 1.0;
  int buttons = 0, dof = 6, styles = 4;
  unsigned calibration = 0x5000;
  bool calibrates_when_told = false;  ///< hdUpdateCalibration makes it HD_CALIBRATION_OK
  int frames_refused = 2;             ///< of the first ones after the scheduler starts: HD_ILLEGAL_END
  bool calls_late = false;            ///< also when it was told to stop
  bool own_thread = false;            ///< the scheduler calls at 1 kHz; else `step` does
  std::atomic<bool> unplugged{false}, silent{false};
  std::atomic<unsigned> frame_error{0};  ///< that every frame has

  // What happened.
  double force_n[3] = {0.0, 0.0, 0.0};  ///< of the newest frame
  std::atomic<int> frames{0}, broken_rules{0};
  std::atomic<unsigned> calibrated_with{0};
  std::string first_broken;

  /// The calls that are not of every frame, in order, and every change between a force and none.
  std::vector<std::string> (*log)() = nullptr;
  /// One turn of the scheduler, on this thread.
  void (*step)() = nullptr;
  /// Everything as at first. While nothing runs.
  void (*reset)() = nullptr;
};

}  // namespace tangent::test
