#include "workbench/session/history.h"

#include <algorithm>
#include <cassert>

namespace tangent {

History::History(std::size_t capacity) : capacity_(std::max<std::size_t>(1, capacity)) {
  // Address space alone: pages are touched as records come, and growing later would copy everything at once.
  records_.reserve(capacity_);
}

void History::push(const ServoRecord& record) {
  if (!empty() && record.tick.tick <= newest().tick.tick) clear();
  if (records_.size() < capacity_) {
    records_.push_back(record);
    return;
  }
  records_[head_] = record;
  head_ = (head_ + 1) % capacity_;
}

void History::clear() {
  records_.clear();
  head_ = 0;
}

const ServoRecord& History::operator[](std::size_t i) const {
  assert(i < records_.size());
  const std::size_t at = head_ + i;
  return records_[at < records_.size() ? at : at - records_.size()];
}

std::size_t History::lower_bound(std::uint64_t tick) const {
  std::size_t low = 0, high = size();
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if ((*this)[middle].tick.tick < tick) low = middle + 1;
    else high = middle;
  }
  return low;
}

const ServoRecord* History::find(std::uint64_t tick) const {
  if (empty() || tick < oldest().tick.tick) return nullptr;
  // Without drops the place is known at once.
  const std::uint64_t guess = tick - oldest().tick.tick;
  if (guess < size() && (*this)[guess].tick.tick == tick) return &(*this)[guess];
  const std::size_t i = lower_bound(tick);
  return i < size() && (*this)[i].tick.tick == tick ? &(*this)[i] : nullptr;
}

}  // namespace tangent
