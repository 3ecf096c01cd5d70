// A wait-free ring of fixed capacity from one producer thread to one consumer thread (Boost.Lockfree). When it is full,
// new items are dropped and counted.
#pragma once

#include <boost/lockfree/spsc_queue.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace tangent {

template <class T>
class Ring {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  /// Allocates all memory and touches it, so that no push causes a page fault. Precondition: capacity > 0.
  explicit Ring(std::size_t capacity) : queue_(capacity) {
    while (queue_.push(T{})) {}
    queue_.reset();
  }

  /// Producer's thread. False, and counted as a drop, when full.
  bool push(const T& item) noexcept {
    if (queue_.push(item)) return true;
    drops_.store(drops_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    return false;
  }
  std::size_t room() const noexcept { return queue_.write_available(); }  ///< producer

  /// Consumer's thread. False when empty.
  bool pop(T& item) noexcept { return queue_.pop(item); }

  std::uint64_t drops() const noexcept { return drops_.load(std::memory_order_relaxed); }  ///< any thread

 private:
  boost::lockfree::spsc_queue<T> queue_;
  std::atomic<std::uint64_t> drops_{0};  // written by the producer only
};

}  // namespace tangent
