// A wait-free mailbox that hands whole values from one thread to another: the latest wins, no value is torn.
//
// Triple buffer: one slot belongs to the writer, one to the reader, the third is exchanged. put swaps the writer's slot
// with the third and marks it fresh; take swaps the reader's slot with it. Each slot has one owner at any time, so its
// bytes need no atomics.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace tangent {

template <class T>
class Mailbox {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  /// Writer's thread. Replaces a value not yet taken.
  void put(const T& value) noexcept {
    slots_[writing_].value = value;
    writing_ = shared_.exchange(static_cast<std::uint8_t>(writing_ | kFresh), std::memory_order_acq_rel) & kIndex;
  }

  /// Reader's thread. False, and `value` unchanged, when nothing new was put since the last take.
  bool take(T& value) noexcept {
    if ((shared_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    reading_ = shared_.exchange(reading_, std::memory_order_acq_rel) & kIndex;
    value = slots_[reading_].value;
    return true;
  }

 private:
  static constexpr std::uint8_t kIndex = 3, kFresh = 4;
  static constexpr std::size_t kCacheLine = 64;  // avoids false sharing between writer and reader
  struct alignas(kCacheLine) Slot {
    T value{};
  };

  std::array<Slot, 3> slots_{};
  alignas(kCacheLine) std::uint8_t writing_ = 0;
  alignas(kCacheLine) std::uint8_t reading_ = 1;
  alignas(kCacheLine) std::atomic<std::uint8_t> shared_{2};
};

}  // namespace tangent
