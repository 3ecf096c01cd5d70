#include "tests/devices/usb/emulation/usbfs_board.h"

#include <algorithm>
#include <cerrno>
#include <utility>

namespace tangent::emulation {

int UsbfsBoard::ioctl(unsigned long request, void* argument) {
  const std::scoped_lock lock(mutex_);
  if (request == USBDEVFS_REAPURBNDELAY || request == USBDEVFS_REAPURB) return reap(static_cast<void**>(argument));
  if (request == USBDEVFS_DISCARDURB) return discard(static_cast<usbdevfs_urb*>(argument));
  if (!plugged_) return -ENODEV;
  switch (request) {
    case USBDEVFS_GET_CAPABILITIES:
      *static_cast<std::uint32_t*>(argument) = 0;
      return 0;
    case USBDEVFS_SUBMITURB:
      return submit(static_cast<usbdevfs_urb*>(argument));
    case USBDEVFS_CLAIMINTERFACE:
      return -claim_error;
    case USBDEVFS_RELEASEINTERFACE:
    case USBDEVFS_CLEAR_HALT:
    case USBDEVFS_SETINTERFACE:
    case USBDEVFS_SETCONFIGURATION:
    case USBDEVFS_RESET:
      return 0;
    case USBDEVFS_GETDRIVER:
      return -ENODATA;
    case USBDEVFS_IOCTL:
      return -ENODATA;  // no driver to attach or detach
    default:
      return -ENOTTY;
  }
}

void UsbfsBoard::complete(usbdevfs_urb* urb, int status, int actual, Bytes data, std::size_t at) {
  done_.push_back({urb, status, actual, std::move(data), at});
  if (on_ready && done_.size() == 1) on_ready(true);
}

int UsbfsBoard::submit(usbdevfs_urb* urb) {
  urb->status = 0;
  urb->actual_length = 0;
  if (urb->type == USBDEVFS_URB_TYPE_CONTROL) {
    submit_control(urb);
    return 0;
  }
  if (model_.bulk && urb->type == USBDEVFS_URB_TYPE_INTERRUPT) return -EINVAL;
  if ((urb->endpoint & 0x80u) != 0) {
    waiting_.push_back(urb);
    serve_in();
    return 0;
  }
  switch (std::exchange(model_.next_out, BusFault::none)) {
    case BusFault::none:
      model_.on_out(urb->endpoint,
                    {static_cast<std::uint8_t*>(urb->buffer), static_cast<std::size_t>(urb->buffer_length)});
      complete(urb, 0, urb->buffer_length);
      serve_in();
      break;
    case BusFault::stall:
      complete(urb, -EPIPE, 0);
      break;
    case BusFault::error:
      complete(urb, -EPROTO, 0);
      break;
    case BusFault::time_out:
      waiting_.push_back(urb);
      break;  // never answered; the host discards it
  }
  return 0;
}

void UsbfsBoard::submit_control(usbdevfs_urb* urb) {
  const auto* b = static_cast<const std::uint8_t*>(urb->buffer);
  const auto u16 = [b](int at) { return static_cast<std::uint16_t>(b[at] | (b[at + 1] << 8)); };
  const ControlSetup setup{b[0], b[1], u16(2), u16(4), u16(6)};
  const BusFault fault = std::exchange(model_.next_out, BusFault::none);
  if (fault == BusFault::time_out) {
    waiting_.push_back(urb);
    return;
  }
  Bytes answer;
  const bool good = fault == BusFault::none && model_.on_control(setup, answer);
  if (!good) return complete(urb, fault == BusFault::error ? -EPROTO : -EPIPE, 0);
  const std::size_t size = std::min<std::size_t>(answer.size(), setup.length);
  answer.resize(size);
  complete(urb, 0, static_cast<int>(size), std::move(answer), 8);
}

void UsbfsBoard::serve_in() {
  while (!model_.in_packets.empty()) {
    const auto urb = std::find_if(waiting_.begin(), waiting_.end(), [](const usbdevfs_urb* u) {
      return u->type != USBDEVFS_URB_TYPE_CONTROL && (u->endpoint & 0x80u) != 0;
    });
    if (urb == waiting_.end()) return;
    usbdevfs_urb* taken = *urb;
    waiting_.erase(urb);
    switch (std::exchange(model_.next_in, BusFault::none)) {
      case BusFault::stall:
        complete(taken, -EPIPE, 0);
        continue;
      case BusFault::error:
        complete(taken, -EPROTO, 0);
        continue;
      default:
        break;
    }
    Bytes packet = std::move(model_.in_packets.front());
    model_.in_packets.pop_front();
    const std::size_t size = std::min<std::size_t>(packet.size(), static_cast<std::size_t>(taken->buffer_length));
    packet.resize(size);
    complete(taken, 0, static_cast<int>(size), std::move(packet));
  }
}

int UsbfsBoard::discard(usbdevfs_urb* urb) {
  const auto found = std::find(waiting_.begin(), waiting_.end(), urb);
  if (found == waiting_.end()) return -EINVAL;
  waiting_.erase(found);
  complete(urb, -ENOENT, 0);
  return 0;
}

int UsbfsBoard::reap(void** out) {
  if (done_.empty()) return plugged_ ? -EAGAIN : -ENODEV;
  const Done& done = done_.front();
  std::copy(done.data.begin(), done.data.end(), static_cast<std::uint8_t*>(done.urb->buffer) + done.at);
  done.urb->status = done.status;
  done.urb->actual_length = done.actual;
  *out = done.urb;
  done_.pop_front();
  if (done_.empty() && on_ready && plugged_) on_ready(false);
  return 0;
}

void UsbfsBoard::tick() {
  const std::scoped_lock lock(mutex_);
  if (!plugged_) return;
  model_.tick();
  serve_in();
}

void UsbfsBoard::unplug() {
  const std::scoped_lock lock(mutex_);
  plugged_ = false;
  while (!waiting_.empty()) {
    usbdevfs_urb* urb = waiting_.front();
    waiting_.pop_front();
    complete(urb, -ESHUTDOWN, 0);
  }
  model_.in_packets.clear();
}

void UsbfsBoard::plug_in() {
  const std::scoped_lock lock(mutex_);
  model_.reset();
  waiting_.clear();
  done_.clear();
  plugged_ = true;
}

void UsbfsBoard::vanish_handle() {
  const std::scoped_lock lock(mutex_);
  waiting_.clear();
  done_.clear();
}

}  // namespace tangent::emulation
