// What the program has to say: shown for a while in the window, kept in the log. Never modal.
#pragma once

#include <cstdint>
#include <deque>
#include <string>

namespace tangent {

enum class Severity : std::uint8_t { note, warning, error };

struct Message {
  Severity severity = Severity::note;
  std::string text;
  double at_s = 0.0;        ///< when it came last
  std::uint32_t times = 1;  ///< the same text over and over is one message
  bool dismissed = false;
};

class MessageLog {
 public:
  static constexpr std::size_t kKept = 200;
  static constexpr double kSameWithin_s = 10.0;  ///< the same text within this is counted, not repeated

  void add(Severity severity, std::string text, double now_s) {
    if (!messages_.empty() && messages_.back().text == text && now_s - messages_.back().at_s < kSameWithin_s) {
      messages_.back().at_s = now_s;
      messages_.back().dismissed = false;
      ++messages_.back().times;
      return;
    }
    messages_.push_back({severity, std::move(text), now_s});
    if (messages_.size() > kKept) messages_.pop_front();
  }
  /// Oldest first.
  const std::deque<Message>& all() const { return messages_; }
  void dismiss(std::size_t i) { messages_[i].dismissed = true; }

  /// Errors stay longer than notes.
  static bool visible(const Message& m, double now_s) {
    return !m.dismissed && now_s - m.at_s < (m.severity == Severity::note ? 5.0 : 15.0);
  }

 private:
  std::deque<Message> messages_;
};

}  // namespace tangent
