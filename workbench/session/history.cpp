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

template <class Records>
const ServoRecord* record_of(const Records& records, std::uint64_t tick) {
  if (records.empty() || tick < records.oldest().tick.tick) return nullptr;
  // Without dropped records the index follows from the tick.
  const std::uint64_t guess = tick - records.oldest().tick.tick;
  if (guess < records.size() && records[guess].tick.tick == tick) return &records[guess];
  const std::size_t i = first_not_before(records, tick);
  return i < records.size() && records[i].tick.tick == tick ? &records[i] : nullptr;
}

}  // namespace

std::size_t HistorySnapshot::lower_bound(std::uint64_t tick) const { return first_not_before(*this, tick); }

const ServoRecord* HistorySnapshot::find(std::uint64_t tick) const { return record_of(*this, tick); }

HistorySnapshot HistorySnapshot::slice(std::size_t begin, std::size_t end) const {
  HistorySnapshot out;
  out.block_ = block_;
  if (begin == end) return out;
  const std::size_t first = (head_ + begin) / block_, last = (head_ + end - 1) / block_;
  out.blocks_.assign(blocks_.begin() + static_cast<std::ptrdiff_t>(first),
                     blocks_.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  out.head_ = head_ + begin - first * block_;
  out.size_ = end - begin;
  return out;
}

void HistorySnapshot::collect_blocks(std::map<const ServoRecord*, std::size_t>& blocks) const {
  for (const auto& block : blocks_) blocks[block.get()] = block_ * sizeof(ServoRecord);
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

const ServoRecord* History::find(std::uint64_t tick) const { return record_of(*this, tick); }

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
