#include "workbench/session/history.h"

#include <algorithm>

namespace tangent {

namespace {

constexpr std::size_t kBlockRecords = 1024;  // a second at 1 kHz

template <class Records>
std::size_t first_not_before(const Records& records, std::uint64_t tick) {
  std::size_t low = 0, high = records.size();
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (records[middle].tick.tick < tick)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

}  // namespace

std::size_t HistorySnapshot::lower_bound(std::uint64_t tick) const { return first_not_before(*this, tick); }

HistorySnapshot HistorySnapshot::slice(std::size_t begin, std::size_t end) const {
  HistorySnapshot out = *this;
  out.head_ = head_ + begin;
  out.size_ = end - begin;
  return out;
}

History::History(std::size_t capacity)
    : capacity_(std::max<std::size_t>(1, capacity)), block_(std::min(capacity_, kBlockRecords)) {}

void History::push(const ServoRecord& record) {
  if (!empty() && record.tick.tick <= newest().tick.tick) clear();
  if (size_ == capacity_) {
    --size_;
    if (++head_ == block_) {
      head_ = 0;
      blocks_.pop_front();  // a snapshot may still share it, so it is never reused
    }
  }
  const std::size_t at = head_ + size_;
  if (at / block_ == blocks_.size()) blocks_.push_back(std::shared_ptr<ServoRecord[]>(new ServoRecord[block_]));
  blocks_[at / block_][at % block_] = record;
  ++size_;
}

void History::clear() {
  blocks_.clear();
  head_ = size_ = 0;
}

std::size_t History::lower_bound(std::uint64_t tick) const { return first_not_before(*this, tick); }

const ServoRecord* History::find(std::uint64_t tick) const {
  if (empty() || tick < oldest().tick.tick) return nullptr;
  // Without dropped records the index follows from the tick.
  const std::uint64_t guess = tick - oldest().tick.tick;
  if (guess < size() && (*this)[guess].tick.tick == tick) return &(*this)[guess];
  const std::size_t i = lower_bound(tick);
  return i < size() && (*this)[i].tick.tick == tick ? &(*this)[i] : nullptr;
}

HistorySnapshot History::snapshot() const {
  HistorySnapshot out;
  out.blocks_.assign(blocks_.begin(), blocks_.end());
  out.head_ = head_;
  out.size_ = size_;
  out.block_ = block_;
  return out;
}

std::size_t History::most_memory_bytes() const {
  return (capacity_ + block_ - 1 + block_) / block_ * block_ * sizeof(ServoRecord);
}

}  // namespace tangent
