#include "workbench/gui/platform/frame_times.h"

#include "core/base/text.h"
#include "core/io/atomic_file.h"

#include <cstdlib>
#include <ctime>
#include <string>

namespace tangent {
namespace {

double monotonic_s() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

FrameTimes::FrameTimes() {
  if (const char* file = std::getenv("TANGENT_FRAME_TIMES")) file_ = file;
}

void FrameTimes::begin() {
  if (!file_.empty()) frames_.push_back({.begin_s = monotonic_s()});
}

void FrameTimes::end(bool input, bool drawn) {
  if (file_.empty() || frames_.empty()) return;
  frames_.back().end_s = monotonic_s();
  frames_.back().input = input;
  frames_.back().drawn = drawn;
}

Status FrameTimes::write() const {
  if (file_.empty()) return {};
  std::string text = "begin_s,end_s,input,drawn\n";
  for (const Frame& frame : frames_) {
    append_double(text, frame.begin_s);
    text += ',';
    append_double(text, frame.end_s);
    text += frame.input ? ",1" : ",0";
    text += frame.drawn ? ",1\n" : ",0\n";
  }
  return write_file_atomic(file_, text, false);
}

}  // namespace tangent
