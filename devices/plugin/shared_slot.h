// A value that one process writes and another reads, in memory that both see. The latest wins; neither waits.
//
// A sequence lock over atomic words: the writer makes the sequence odd, writes, makes it even again; the reader takes
// what it read only when the sequence was even and the same before and after. It gives up after a few attempts: the
// writer may have died in between. No index and no pointer comes from the other side, which may have written over
// anything. One thread writes.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace tangent {

template <class T>
class SharedSlot {
  static_assert(std::is_trivially_copyable_v<T>);
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free, "shared between processes");

 public:
  void put(const T& value) noexcept {
    std::array<std::uint64_t, kWords> words{};
    std::memcpy(words.data(), &value, sizeof value);
    const std::uint32_t odd = sequence_.load(std::memory_order_relaxed) | 1u;
    sequence_.store(odd, std::memory_order_relaxed);
    // Released one by one, and acquired so, instead of fences: the thread sanitizer knows none.
    for (std::size_t i = 0; i < kWords; ++i) words_[i].store(words[i], std::memory_order_release);
    sequence_.store(odd + 1, std::memory_order_release);
  }

  /// False, and `value` unchanged, when nothing was written since the sequence `last`, which it sets.
  bool take(T& value, std::uint32_t& last) const noexcept {
    std::array<std::uint64_t, kWords> words{};
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const std::uint32_t before = sequence_.load(std::memory_order_acquire);
      if (before == last) return false;
      if (before % 2 != 0) continue;
      for (std::size_t i = 0; i < kWords; ++i) words[i] = words_[i].load(std::memory_order_acquire);
      if (sequence_.load(std::memory_order_relaxed) != before) continue;
      std::memcpy(static_cast<void*>(&value), words.data(), sizeof value);
      last = before;
      return true;
    }
    return false;
  }

 private:
  static constexpr std::size_t kWords = (sizeof(T) + 7) / 8;
  static constexpr int kAttempts = 8;
  std::atomic<std::uint32_t> sequence_{0};
  std::array<std::atomic<std::uint64_t>, kWords> words_{};
};

}  // namespace tangent
