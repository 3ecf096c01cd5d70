#include "workbench/gui/platform/key_taps.h"

#include <doctest/doctest.h>

using namespace tangent;

TEST_CASE("a key that went down and up between two frames is down for one frame, with its modifiers") {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  KeyTaps taps;
  taps.pressed('Q', {.ctrl = true});
  taps.apply(io, {});
  CHECK(io.KeysDown['Q']);
  CHECK(io.KeyCtrl);
  taps.apply(io, {});
  CHECK_FALSE(io.KeysDown['Q']);
  CHECK_FALSE(io.KeyCtrl);
  ImGui::DestroyContext();
}

TEST_CASE("a key that is still down is left to the back end") {
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  KeyTaps taps;
  io.KeysDown['A'] = true;  // the back end saw it
  taps.pressed('A', {});
  taps.pressed(-1, {});
  taps.pressed(100'000, {});
  taps.apply(io, {});
  taps.apply(io, {});
  CHECK(io.KeysDown['A']);
  ImGui::DestroyContext();
}

TEST_CASE("taps of one key in a row are pressed one after the other, none is lost") {
  ImGuiIO io;
  KeyTaps taps;
  for (int i = 0; i < 3; ++i) taps.pressed('K', {});
  int presses = 0;
  bool before = false;
  for (int frame = 0; frame < 8; ++frame) {
    taps.apply(io, {});
    if (io.KeysDown['K'] && !before) ++presses;
    before = io.KeysDown['K'];
    if (frame == 3) taps.pressed('K', {});  // while it is up again
  }
  CHECK(presses == 4);
  CHECK_FALSE(io.KeysDown['K']);
  CHECK_FALSE(taps.waiting());
}
