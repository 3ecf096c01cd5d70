// A measurement: when each frame of the window began, when it was on the screen, and whether it shows input. For
// workbench/bench/README.md; `TANGENT_FRAME_TIMES=F.csv workbench gui` writes it when the window is closed.
#pragma once

#include "core/base/result.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace tangent {

class FrameTimes {
 public:
  /// Does nothing unless the environment names a file.
  FrameTimes();

  void begin();                      ///< of a frame: its input is taken now
  void end(bool input, bool drawn);  ///< it is shown; `input`: events were waiting for it; `drawn`: it was another one
  /// Columns begin_s and end_s (CLOCK_MONOTONIC, which other programs can read), input and drawn (0 or 1).
  Status write() const;

 private:
  struct Frame {
    double begin_s = 0.0, end_s = 0.0;
    bool input = false, drawn = false;
  };
  std::filesystem::path file_;  ///< empty: nothing is measured
  std::vector<Frame> frames_;
};

}  // namespace tangent
