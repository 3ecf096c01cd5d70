#include "workbench/gui/platform/input_queue.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace tangent;

namespace {

constexpr int kCtrl = 341, kEnter = 257;

/// ImGui with a field to type in and two buttons; counts what a frame made of the input.
class Window {
 public:
  Window() {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {400.0f, 300.0f};
    io.DeltaTime = 0.1f;  // a slow frame
    io.KeyMap[ImGuiKey_Enter] = kEnter;
    unsigned char* pixels = nullptr;
    int w = 0, h = 0;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &w, &h);
    frame();
  }
  ~Window() { ImGui::DestroyContext(); }

  void frame() {
    queue.apply(ImGui::GetIO());
    ImGui::NewFrame();
    for (int key = 0; key < IM_ARRAYSIZE(ImGui::GetIO().KeysDown); ++key) {
      if (ImGui::IsKeyPressed(key, false)) pressed.push_back((ImGui::GetIO().KeyCtrl ? 1000 : 0) + key);
    }
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({400, 300});
    ImGui::Begin("window", nullptr, ImGuiWindowFlags_NoDecoration);
    ImGui::SetCursorPos({10, 10});
    if (open_field) ImGui::SetKeyboardFocusHere();
    open_field = false;
    if (ImGui::InputText("##field", text, sizeof text, ImGuiInputTextFlags_EnterReturnsTrue)) entered.push_back(text);
    ImGui::SetCursorPos({10, 100});
    if (ImGui::Button("left", {100, 50})) clicked.emplace_back("left");
    ImGui::SetCursorPos({200, 100});
    if (ImGui::Button("right", {100, 50})) clicked.emplace_back("right");
    ImGui::End();
    ImGui::Render();
  }
  int frames_until_still() {
    int n = 0;
    for (; queue.waiting() && n < 1000; ++n) frame();
    frame();
    return n;
  }
  void tap(int key) {
    queue.key(key, true);
    queue.key(key, false);
  }
  void click(float x, float y) {
    queue.position(x, y);
    queue.button(0, true);
    queue.button(0, false);
  }

  InputQueue queue;
  char text[64] = "";
  bool open_field = false;
  std::vector<int> pressed;
  std::vector<std::string> entered, clicked;
};

}  // namespace

TEST_CASE("a chord that came and went between two frames is pressed with its modifier") {
  Window window;
  window.queue.key(kCtrl, true);
  window.tap('Q');
  window.queue.key(kCtrl, false);
  window.tap('W');
  window.frames_until_still();
  CHECK(window.pressed == std::vector<int>{1000 + 'Q', 1000 + kCtrl, 'W'});
  CHECK_FALSE(ImGui::GetIO().KeyCtrl);
}

TEST_CASE("a key released and pressed again between two frames is pressed twice") {
  Window window;
  window.queue.key(' ', true);
  window.frame();
  window.queue.key(' ', false);
  window.queue.key(' ', true);
  window.frames_until_still();
  CHECK(window.pressed == std::vector<int>{' ', ' '});
  CHECK(ImGui::GetIO().KeysDown[static_cast<int>(' ')]);
  window.queue.key(' ', false);
  window.queue.key(' ', true);
  window.queue.key(' ', false);
  window.frames_until_still();
  CHECK(window.pressed.size() == 3);
  CHECK_FALSE(ImGui::GetIO().KeysDown[static_cast<int>(' ')]);
}

TEST_CASE("taps in a row are all pressed, in their order") {
  Window window;
  for (const char c : std::string("KKKABBA")) window.tap(c);
  CHECK(window.frames_until_still() <= 15);
  CHECK(window.pressed == std::vector<int>{'K', 'K', 'K', 'A', 'B', 'B', 'A'});
}

TEST_CASE("what is typed after the key that opens a field, and Enter after it, arrive whole in one poll") {
  Window window;
  window.open_field = true;
  window.frame();
  window.frame();
  for (const char c : std::string("window light")) {
    window.queue.key(c == ' ' ? ' ' : c - 32, true);
    window.queue.character(static_cast<unsigned int>(c));
    window.queue.key(c == ' ' ? ' ' : c - 32, false);
  }
  window.tap(kEnter);
  window.frames_until_still();
  CHECK(window.entered == std::vector<std::string>{"window light"});
}

TEST_CASE("a click followed by a move counts where it was made, and two clicks in one poll are two") {
  Window window;
  window.click(50, 125);
  window.queue.position(250, 125);
  window.frames_until_still();
  CHECK(window.clicked == std::vector<std::string>{"left"});
  window.click(250, 125);
  window.click(250, 125);
  window.click(50, 125);
  window.frames_until_still();
  CHECK(window.clicked == std::vector<std::string>{"left", "right", "right", "left"});
}

TEST_CASE("a drag that began and ended between two frames is a drag to its end, with the button down") {
  Window window;
  ImGuiIO& io = ImGui::GetIO();
  window.queue.position(350, 250);
  window.queue.button(0, true);
  window.queue.position(360, 250);
  window.queue.position(375, 255);
  window.queue.button(0, false);
  float dragged = 0.0f;  // the way to the press is none of it
  while (window.queue.waiting()) {
    window.frame();
    if (io.MouseDown[0]) dragged += io.MouseDelta.x;
  }
  CHECK(dragged == 25.0f);
  CHECK_FALSE(io.MouseDown[0]);
}

TEST_CASE("moves and turns of the wheel of one poll are one frame's") {
  Window window;
  for (int i = 0; i < 100; ++i) window.queue.position(static_cast<float>(i), 20.0f);
  for (int i = 0; i < 5; ++i) window.queue.wheel(0.0f, 1.0f);
  ImGui::GetIO().MouseWheel = 0.0f;
  window.queue.apply(ImGui::GetIO());
  CHECK_FALSE(window.queue.waiting());
  CHECK(ImGui::GetIO().MousePos.x == 99.0f);
  CHECK(ImGui::GetIO().MouseWheel == 5.0f);
  window.queue.wheel(0.0f, 1.0f);
  window.queue.position(300.0f, 20.0f);  // the wheel belongs to what was under the pointer
  window.queue.apply(ImGui::GetIO());
  CHECK(ImGui::GetIO().MousePos.x == 99.0f);
  CHECK(window.queue.waiting());
}

TEST_CASE("the pointer is nowhere after it left, but a drag goes on outside") {
  Window window;
  ImGuiIO& io = ImGui::GetIO();
  window.queue.position(20.0f, 20.0f);
  window.queue.button(0, true);
  window.queue.pointer_left();
  window.queue.position(-30.0f, 20.0f);
  window.frames_until_still();
  CHECK(io.MousePos.x == -30.0f);
  CHECK(io.MouseDown[0]);
  window.queue.button(0, false);
  window.queue.pointer_left();
  window.frames_until_still();
  CHECK_FALSE(ImGui::IsMousePosValid());
}

TEST_CASE("codes that ImGui has no room for are left out, and the window system's repeated words change nothing") {
  Window window;
  window.queue.key(-1, true);
  window.queue.key(100'000, true);
  window.queue.button(-1, true);
  window.queue.button(99, true);
  CHECK_FALSE(window.queue.waiting());
  for (int i = 0; i < 3; ++i) window.queue.key('A', true);
  for (int i = 0; i < 3; ++i) window.queue.key('A', false);
  window.frames_until_still();
  CHECK(window.pressed == std::vector<int>{'A'});
}
