// What the program has to say: shown for a while in the window, kept in the log. Never modal.
#pragma once

#include <algorithm>
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
  bool toast = true;  ///< false: in the log alone, because too many came at once
};

class MessageLog {
 public:
  static constexpr std::size_t kKept = 500;
  static constexpr double kToastBurst = 4.0;    ///< toasts that may come at once ...
  static constexpr double kToastEvery_s = 2.0;  ///< ... and then one in so long
  static constexpr double kHeldBackShown_s = 5.0;
  static constexpr double kSameWithin_s = 10.0;  ///< the same text within this is counted, not repeated

  void add(Severity severity, std::string text, double now_s) {
    if (!messages_.empty() && messages_.back().text == text && now_s - messages_.back().at_s < kSameWithin_s) {
      messages_.back().at_s = now_s;
      messages_.back().dismissed = false;
      ++messages_.back().times;
      return;
    }
    messages_.push_back({severity, std::move(text), now_s});
    messages_.back().toast = take_toast(now_s);
    if (messages_.size() > kKept) messages_.pop_front();
  }
  /// The clock of what is said from now on.
  void set_now(double now_s) { now_s_ = now_s; }
  double now_s() const { return now_s_; }
  void say(Severity severity, std::string text) { add(severity, std::move(text), now_s_); }
  /// Oldest first.
  const std::deque<Message>& all() const { return messages_; }
  void clear() { messages_.clear(); }
  /// Messages of the last seconds that are in the log alone.
  std::size_t held_back(double now_s) const {
    std::size_t n = 0;
    for (const Message& m : messages_) n += !m.toast && now_s - m.at_s < kHeldBackShown_s ? 1u : 0u;
    return n;
  }
  void dismiss(std::size_t i) { messages_[i].dismissed = true; }

  /// Errors stay longer than notes.
  static bool visible(const Message& m, double now_s) {
    return m.toast && !m.dismissed && now_s - m.at_s < (m.severity == Severity::note ? 5.0 : 15.0);
  }

 private:
  /// A bucket of toasts, filled again one at a time.
  bool take_toast(double now_s) {
    toasts_left_ = std::min(kToastBurst, toasts_left_ + std::max(0.0, now_s - toasts_at_s_) / kToastEvery_s);
    toasts_at_s_ = now_s;
    if (toasts_left_ < 1.0) return false;
    toasts_left_ -= 1.0;
    return true;
  }

  std::deque<Message> messages_;
  double now_s_ = 0.0;
  double toasts_left_ = kToastBurst, toasts_at_s_ = 0.0;
};

}  // namespace tangent
