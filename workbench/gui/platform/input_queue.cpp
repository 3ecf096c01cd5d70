#include "workbench/gui/platform/input_queue.h"

#include <algorithm>
#include <bitset>

namespace tangent {

namespace {

constexpr int kShiftLeft = 340, kSuperRight = 347;  // GLFW's codes of the modifiers lie between these

bool either(const ImGuiIO& io, int left, int right) { return io.KeysDown[left] || io.KeysDown[right]; }

}  // namespace

struct InputQueue::Shown {
  std::bitset<IM_ARRAYSIZE(ImGuiIO::KeysDown)> keys;  ///< went down or up
  std::bitset<5> buttons;
  bool press = false, text = false, wheel = false, moved = false;
};

bool InputQueue::Event::modifier() const { return kind == Kind::key && code >= kShiftLeft && code <= kSuperRight; }

void InputQueue::key(int code, bool down) {
  if (code >= 0 && code < IM_ARRAYSIZE(ImGuiIO::KeysDown)) events_.push_back({Kind::key, code, down});
}

void InputQueue::character(unsigned int code_point) {
  events_.push_back({Kind::character, static_cast<int>(code_point)});
}

void InputQueue::button(int index, bool down) {
  if (index < 0 || index >= static_cast<int>(buttons_.size())) return;
  events_.push_back({Kind::button, index, down});
  const unsigned int bit = 1u << index;
  held_ = down ? held_ | bit : held_ & ~bit;
}

void InputQueue::position(float x, float y) { events_.push_back({.kind = Kind::position, .at = {x, y}}); }

void InputQueue::pointer_left() {
  if (held_ == 0) position(-FLT_MAX, -FLT_MAX);
}

void InputQueue::wheel(float x, float y) { events_.push_back({.kind = Kind::wheel, .at = {x, y}}); }

bool InputQueue::fits(const Event& event, const Shown& shown, const ImGuiIO& io) {
  switch (event.kind) {
    case Kind::key: {
      const auto key = static_cast<std::size_t>(event.code);
      if (io.KeysDown[key] == event.down) return true;  // no change
      if (shown.keys[key]) return false;
      if (event.modifier()) return !shown.press && shown.buttons.none() && !shown.wheel;
      return !event.down || (!shown.press && !shown.text && shown.buttons.none());
    }
    case Kind::character:
      return shown.buttons.none();
    case Kind::button:
      return !shown.buttons[static_cast<std::size_t>(event.code)] && !shown.press && !shown.text && !shown.moved;
    case Kind::position:
      return shown.buttons.none() && !shown.wheel;
    case Kind::wheel:
      return shown.buttons.none();
  }
  return true;
}

void InputQueue::show(const Event& event, Shown& shown, ImGuiIO& io) {
  switch (event.kind) {
    case Kind::key:
      if (io.KeysDown[event.code] == event.down) return;
      io.KeysDown[event.code] = event.down;
      shown.keys.set(static_cast<std::size_t>(event.code));
      shown.press |= event.down && !event.modifier();
      return;
    case Kind::character:
      io.AddInputCharacter(static_cast<unsigned int>(event.code));
      shown.text = true;
      return;
    case Kind::button:
      buttons_[static_cast<std::size_t>(event.code)] = event.down;
      shown.buttons.set(static_cast<std::size_t>(event.code));
      return;
    case Kind::position:
      pointer_ = event.at;
      shown.moved = true;
      return;
    case Kind::wheel:
      io.MouseWheelH += event.at.x;
      io.MouseWheel += event.at.y;
      shown.wheel = true;
      return;
  }
}

void InputQueue::apply(ImGuiIO& io) {
  Shown shown;
  while (!events_.empty() && fits(events_.front(), shown, io)) {
    show(events_.front(), shown, io);
    events_.pop_front();
  }
  io.KeyShift = either(io, 340, 344);
  io.KeyCtrl = either(io, 341, 345);
  io.KeyAlt = either(io, 342, 346);
  io.KeySuper = either(io, 343, 347);
  std::copy(buttons_.begin(), buttons_.end(), io.MouseDown);
  io.MousePos = pointer_;
}

}  // namespace tangent
