// A value that is made when it is first asked for.
#pragma once

#include <atomic>
#include <memory>

namespace tangent {

/// While one exists, its thread makes nothing, for who has no time for it: what is asked for and not made yet is
/// missed, and what came of that is to be thrown away. Needs no memory.
class MakesNothing {
 public:
  MakesNothing() : outer_(here_) { here_ = this; }
  ~MakesNothing() { here_ = outer_; }
  MakesNothing(const MakesNothing&) = delete;
  MakesNothing& operator=(const MakesNothing&) = delete;

  bool missed() const { return missed_; }
  /// Whether this thread makes nothing; then something was missed.
  static bool miss() {
    if (here_) here_->missed_ = true;
    return here_ != nullptr;
  }

 private:
  static inline constinit thread_local MakesNothing* here_ = nullptr;
  MakesNothing* outer_;
  bool missed_ = false;
};

/// Without locks: threads that ask at once may each make it, one of them is kept. So what makes it must give the same
/// value each time, and who asks gets the same whoever was first.
template <class T>
class BuiltOnce {
 public:
  BuiltOnce() = default;
  BuiltOnce(const BuiltOnce&) = delete;
  BuiltOnce& operator=(const BuiltOnce&) = delete;
  ~BuiltOnce() { delete made_.load(std::memory_order_acquire); }

  /// Null: not made yet.
  const T* if_built() const { return made_.load(std::memory_order_acquire); }

  /// Null: not made yet, and this thread makes nothing.
  template <class Make>
  const T* find(Make make) const {
    if (const T* made = if_built()) return made;
    return MakesNothing::miss() ? nullptr : &get(make);
  }

  template <class Make>
  const T& get(Make make) const {
    if (const T* made = if_built()) return *made;
    auto mine = std::make_unique<const T>(make());
    const T* first = nullptr;
    if (!made_.compare_exchange_strong(first, mine.get(), std::memory_order_acq_rel)) return *first;
    return *mine.release();
  }

 private:
  mutable std::atomic<const T*> made_{nullptr};
};

}  // namespace tangent
