// A bounded history of servo records, oldest first, searchable by tick.
//
// Records are stored in blocks that are written once. A snapshot shares the blocks, so that another thread can read the
// records it contains while new ones are added.
#pragma once

#include "workbench/session/servo_record.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <vector>

namespace tangent {

/// The records of a history at one moment. Any thread may read it without a lock; copies share the blocks. Blocks that
/// the history has dropped since are freed with the last snapshot.
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
  /// The record of that tick; null when it is not in the snapshot.
  const ServoRecord* find(std::uint64_t tick) const;
  /// Records begin ... end - 1, holding only the blocks that contain them. Precondition: begin <= end <= size().
  HistorySnapshot slice(std::size_t begin, std::size_t end) const;
  /// Adds its blocks' addresses and sizes to `blocks`, to count what several snapshots hold together.
  void collect_blocks(std::map<const ServoRecord*, std::size_t>& blocks) const;

 private:
  friend class History;
  std::vector<std::shared_ptr<const ServoRecord[]>> blocks_;
  std::size_t head_ = 0, size_ = 0, block_ = 1;
};

/// One thread owns it: every call, snapshot() included, comes from that thread.
class History {
 public:
  /// Allocates block by block as it fills, at most `capacity` records plus one block. Precondition: capacity > 0.
  explicit History(std::size_t capacity);

  /// Drops the oldest when full. A tick number that does not increase (a new run) clears the history first.
  void push(const ServoRecord& record);
  void clear();

  std::size_t size() const { return size_; }
  std::size_t capacity() const { return capacity_; }
  bool empty() const { return size_ == 0; }
  /// i = 0 is the oldest. Precondition: i < size(). Valid until the next push.
  const ServoRecord& operator[](std::size_t i) const { return blocks_[(head_ + i) / block_][(head_ + i) % block_]; }
  const ServoRecord& oldest() const { return (*this)[0]; }
  const ServoRecord& newest() const { return (*this)[size_ - 1]; }

  /// The record of that tick; null when it is not in the history. Valid until the next push.
  const ServoRecord* find(std::uint64_t tick) const;
  /// Index of the first record with that tick or a later one; size() if there is none.
  std::size_t lower_bound(std::uint64_t tick) const;
  /// Shares the blocks; copies only pointers to them.
  HistorySnapshot snapshot() const;

  std::size_t memory_bytes() const { return blocks_.size() * block_ * sizeof(ServoRecord); }
  std::size_t most_memory_bytes() const;  ///< upper bound of memory_bytes()

 private:
  std::size_t capacity_, block_;
  std::size_t head_ = 0;  ///< index of the oldest in the first block
  std::size_t size_ = 0;
  std::deque<std::shared_ptr<ServoRecord[]>> blocks_;
};

}  // namespace tangent
