// Messages to the user: shown in the window for a while, kept in the log. Never modal.
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
  double at_s = 0.0;        ///< time of the last occurrence
  std::uint32_t times = 1;  ///< a repeated text is one message
  bool dismissed = false;
  bool toast = true;  ///< false: only in the log, because there were too many at once
};

class MessageLog {
 public:
  static constexpr std::size_t kKept = 500;
  static constexpr double kToastBurst = 4.0;    ///< toasts that may be shown at once,
  static constexpr double kToastEvery_s = 2.0;  ///< then one per this time
  static constexpr double kHeldBackShown_s = 5.0;
  static constexpr double kSameWithin_s = 10.0;  ///< a repeated text within this time is counted, not shown again

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
  /// Time stamp of the messages that follow.
  void set_now(double now_s) { now_s_ = now_s; }
  double now_s() const { return now_s_; }
  void say(Severity severity, std::string text) { add(severity, std::move(text), now_s_); }
  /// A note that what was asked for was not done, and why: a line of a script that gets it has failed.
  void refuse(std::string text) {
    last_refusal_ = text;
    ++refusals_;
    say(Severity::note, std::move(text));
  }
  std::uint64_t refusals() const { return refusals_; }  ///< since the program began
  const std::string& last_refusal() const { return last_refusal_; }
  /// Oldest first.
  const std::deque<Message>& all() const { return messages_; }
  void clear() { messages_.clear(); }
  /// Number of recent messages that are only in the log.
  std::size_t held_back(double now_s) const {
    std::size_t n = 0;
    for (const Message& m : messages_) n += !m.toast && now_s - m.at_s < kHeldBackShown_s ? 1u : 0u;
    return n;
  }
  /// Said below the toasts that are shown, of those that are held back; empty: none is.
  std::string held_back_text(double now_s, bool below_toasts) const {
    const std::size_t n = held_back(now_s);
    if (n == 0) return {};
    return below_toasts ? "and " + std::to_string(n) + " more under Messages"
                        : std::to_string(n) + " new under Messages";
  }
  void dismiss(std::size_t i) { messages_[i].dismissed = true; }

  /// Errors stay longer than notes.
  static bool visible(const Message& m, double now_s) {
    return m.toast && !m.dismissed && now_s - m.at_s < (m.severity == Severity::note ? 5.0 : 15.0);
  }

 private:
  /// Token bucket: true if a toast may be shown now.
  bool take_toast(double now_s) {
    toasts_left_ = std::min(kToastBurst, toasts_left_ + std::max(0.0, now_s - toasts_at_s_) / kToastEvery_s);
    toasts_at_s_ = now_s;
    if (toasts_left_ < 1.0) return false;
    toasts_left_ -= 1.0;
    return true;
  }

  std::deque<Message> messages_;
  std::uint64_t refusals_ = 0;
  std::string last_refusal_;
  double now_s_ = 0.0;
  double toasts_left_ = kToastBurst, toasts_at_s_ = 0.0;
};

}  // namespace tangent
