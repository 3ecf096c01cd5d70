#include "devices/haply/haply_events.h"

namespace tangent {

Status HaplyEvents::start(const HaplyLinkOptions& where, const std::string& device) {
  stop();
  device_ = device;
  {
    const std::lock_guard lock(mutex_);
    newest_.clear();
  }
  return link_.start(where);
}

void HaplyEvents::stop() {
  link_.stop();
  open_ = false;
}

std::string HaplyEvents::newest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

void HaplyEvents::on_message(std::string_view text) noexcept {
  using Level = HaplyEvent::Level;
  if (!read_haply_event(text, event_)) return;  // a later version may say more: no reason to stop
  const bool ours = event_.device == device_, of_all = event_.device.empty();
  if (event_.level < Level::warning || !(ours || of_all)) return;
  {
    const std::lock_guard lock(mutex_);
    newest_ = event_.text;
  }
  if (event_.level >= (ours ? Level::error : Level::critical)) alarms_.fetch_add(1, std::memory_order_release);
}

}  // namespace tangent
