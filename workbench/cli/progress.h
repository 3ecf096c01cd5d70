// One-line progress display on standard error, only if that is a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace tangent {

class Progress {
 public:
  /// `what`: the unit counted, e.g. "ticks"; `total`: their final number.
  Progress(std::string what, std::uint64_t total);
  ~Progress();  ///< erases the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Cheap enough for every tick: reads the clock once in kStride calls, draws ten times a second.
  void update(std::uint64_t done) {
    if (terminal_ && done % kStride == 0) draw(done);
  }
  /// For work whose total changes: reads the clock at every call.
  void update(std::uint64_t done, std::uint64_t total) {
    total_ = total;
    if (terminal_) draw(done);
  }

 private:
  static constexpr std::uint64_t kStride = 64;
  void draw(std::uint64_t done);

  std::string what_;
  std::uint64_t total_;
  bool terminal_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace tangent
