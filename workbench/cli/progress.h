// One line on standard error that says how far long work is: only when it is a terminal.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace tangent {

class Progress {
 public:
  /// `what`: "ticks". Total: how many there will be.
  Progress(std::string what, std::uint64_t total);
  ~Progress();  ///< wipes the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Cheap enough for every tick: looks at the clock once in kStride calls, draws ten times a second.
  void update(std::uint64_t done) {
    if (terminal_ && done % kStride == 0) draw(done);
  }
  /// For work whose end moves: looks at the clock every time.
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
