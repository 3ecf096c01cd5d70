// How long a question of a guided run has been in view: the next one has its buttons where the last one had them, and a
// double click there is no answer to both.
#pragma once

#include <cstdint>

namespace tangent {

class AskedSince {
 public:
  static constexpr double kShortest_s = 0.5;  ///< between two clicks that are one double click, at the most

  void forget() { *this = {}; }
  /// At each look at the run: which question it puts, and its time. True: another one than at the look before.
  bool look(std::uint32_t question, double t_s) {
    t_s_ = t_s;
    if (question == question_) return false;
    question_ = question;
    since_s_ = t_s;
    return true;
  }
  /// Whoever clicks now has had the time to read it.
  bool long_enough() const { return t_s_ - since_s_ >= kShortest_s; }

 private:
  std::uint32_t question_ = 0;  ///< 0: none so far
  double since_s_ = 0.0, t_s_ = 0.0;
};

}  // namespace tangent
