#include "workbench/gui/model/live_beside.h"

#include "workbench/gui/model/ghost_channels.h"

#include <algorithm>

namespace tangent {

void LiveBeside::clear() {
  channels_.reset();
  stepper_.reset();
  newest_.reset();
  trace_->clear();
}

void LiveBeside::take(const PastPart& past, const Preset& preset, std::size_t capacity) {
  if (!(preset == preset_) || channels_ == nullptr) {
    clear();
    preset_ = preset;
    channels_ = std::make_shared<ChannelStore>(kGhostChannelCount, capacity);
  }
  const HistorySnapshot& records = past.records;
  if (records.empty()) return;
  if (newest_ && *newest_ > records.newest().tick.tick) newest_.reset();  // a new run
  const std::size_t next = newest_ ? records.lower_bound(*newest_ + 1) : 0;
  const std::size_t begin = std::max(next, records.size() > kMostAtOnce ? records.size() - kMostAtOnce : 0);
  for (std::size_t i = begin; i < records.size(); ++i) step(past, records[i], i + 1 == records.size());
  channels_->drop_before(records.oldest().tick.tick);
}

void LiveBeside::step(const PastPart& past, const ServoRecord& record, bool last) {
  const bool follows = newest_ && *newest_ + 1 == record.tick.tick && scene_id_ == record.scene_id && stepper_;
  if (!follows) {
    const auto scene = past.scenes.find(record.scene_id);
    if (scene == past.scenes.end()) return stepper_.reset();
    if (!stepper_ || &stepper_->scene() != scene->second.get()) stepper_.emplace(scene->second);
    state_ = record.tick.kept;
  }
  newest_ = record.tick.tick;
  scene_id_ = record.scene_id;
  trace_->clear();
  output_ = stepper_->step(preset_, record.tick.input, state_, last ? trace_.get() : nullptr);
  channels_->push(record.tick.tick, ghost_row(output_));
}

}  // namespace tangent
