// The last minutes of servo records, for whoever looks at them: bounded memory, oldest first, found by tick.
//
// Records lie in blocks that are written once. A snapshot shares the blocks, so that another thread can read the
// records that were there while new ones are being added.
#pragma once

#include "workbench/session/servo_record.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

namespace tangent {

/// Records of a history at one moment. Copies share the blocks; reading needs no lock. Memory that the history has
/// given up meanwhile stays until the snapshot goes.
class HistorySnapshot {
 public:
  HistorySnapshot() = default;

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// i = 0 is the oldest. Precondition: i < size().
  const ServoRecord& operator[](std::size_t i) const { return blocks_[(head_ + i) / block_][(head_ + i) % block_]; }
  const ServoRecord& oldest() const { return (*this)[0]; }
  const ServoRecord& newest() const { return (*this)[size_ - 1]; }
  /// Index of the first record with that tick or a later one; size() if there is none.
  std::size_t lower_bound(std::uint64_t tick) const;
  /// Records begin ... end - 1. Precondition: begin <= end <= size().
  HistorySnapshot slice(std::size_t begin, std::size_t end) const;

 private:
  friend class History;
  std::vector<std::shared_ptr<const ServoRecord[]>> blocks_;
  std::size_t head_ = 0, size_ = 0, block_ = 1;
};

class History {
 public:
  /// Memory comes block by block as it fills: capacity records and one block at most. Precondition: capacity > 0.
  explicit History(std::size_t capacity);

  /// Drops the oldest when full. A tick not after the last one (another run) clears the history first.
  void push(const ServoRecord& record);
  void clear();

  std::size_t size() const { return size_; }
  std::size_t capacity() const { return capacity_; }
  bool empty() const { return size_ == 0; }
  /// i = 0 is the oldest. Precondition: i < size(). Valid until the next push.
  const ServoRecord& operator[](std::size_t i) const { return blocks_[(head_ + i) / block_][(head_ + i) % block_]; }
  const ServoRecord& oldest() const { return (*this)[0]; }
  const ServoRecord& newest() const { return (*this)[size_ - 1]; }

  /// The record of that tick; null when it was dropped, overwritten or is yet to come. Valid until the next push.
  const ServoRecord* find(std::uint64_t tick) const;
  /// Index of the first record with that tick or a later one; size() if there is none.
  std::size_t lower_bound(std::uint64_t tick) const;
  HistorySnapshot snapshot() const;

  std::size_t memory_bytes() const { return blocks_.size() * block_ * sizeof(ServoRecord); }
  std::size_t most_memory_bytes() const;  ///< what memory_bytes() grows to

 private:
  std::size_t capacity_, block_;
  std::size_t head_ = 0;  ///< where the oldest is in the first block
  std::size_t size_ = 0;
  std::deque<std::shared_ptr<ServoRecord[]>> blocks_;
};

}  // namespace tangent
