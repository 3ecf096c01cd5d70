// A value that is made when it is first asked for.
#pragma once

#include <atomic>
#include <memory>

namespace tangent {

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
