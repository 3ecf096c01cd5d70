// The last minutes of servo records, for whoever looks at them: bounded memory, oldest first, found by tick.
#pragma once

#include "workbench/session/servo_record.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tangent {

class History {
 public:
  /// Memory is touched as it fills: capacity * sizeof(ServoRecord) at most. Precondition: capacity > 0.
  explicit History(std::size_t capacity);

  /// Overwrites the oldest when full. A tick not after the last one (another run) clears the history first.
  void push(const ServoRecord& record);
  void clear();

  std::size_t size() const { return records_.size(); }
  std::size_t capacity() const { return capacity_; }
  bool empty() const { return records_.empty(); }
  /// i = 0 is the oldest. Precondition: i < size().
  const ServoRecord& operator[](std::size_t i) const;
  const ServoRecord& oldest() const { return (*this)[0]; }
  const ServoRecord& newest() const { return (*this)[size() - 1]; }

  /// The record of that tick; null when it was dropped, overwritten or is yet to come. Valid until the next push.
  const ServoRecord* find(std::uint64_t tick) const;
  /// Index of the first record with that tick or a later one; size() if there is none.
  std::size_t lower_bound(std::uint64_t tick) const;
  std::size_t memory_bytes() const { return records_.capacity() * sizeof(ServoRecord); }

 private:
  std::size_t capacity_;
  std::size_t head_ = 0;   ///< where the oldest is, once full
  std::vector<ServoRecord> records_;
};

}  // namespace tangent
