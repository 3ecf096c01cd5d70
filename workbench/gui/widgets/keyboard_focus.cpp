#include "workbench/gui/widgets/keyboard_focus.h"

#include "workbench/gui/widgets/widgets.h"

#include <imgui_internal.h>

#include <algorithm>
#include <tuple>
#include <vector>

namespace tangent {

namespace {

constexpr int kF6 = 295, kUp = 265, kDown = 264;  // GLFW's codes

struct Stop {
  const std::string* path = nullptr;
  const ImGuiWindow* window = nullptr;
  int order = 0;
};

/// What Tab stops at, in the order in which one reads: parts of the window from the top left, in each as drawn. While a
/// menu or a list is open, only what is in it.
std::vector<Stop> stops(const ItemMap& items, bool popup) {
  std::vector<Stop> out;
  for (const auto& [path, rect] : items.all()) {
    if (rect.id == 0 || path.starts_with("splitter/")) continue;
    const ImGuiWindow* window = ImGui::FindWindowByID(rect.window);
    if (window == nullptr || ((window->Flags & ImGuiWindowFlags_Popup) != 0) != popup) continue;
    out.push_back({&path, window, rect.order});
  }
  const auto key = [](const Stop& s) { return std::tuple(s.window->Pos.y, s.window->Pos.x, s.window->ID, s.order); };
  std::sort(out.begin(), out.end(), [&](const Stop& a, const Stop& b) { return key(a) < key(b); });
  return out;
}

/// The first stop of the next part of the window, or of the one before.
std::size_t next_part(const std::vector<Stop>& all, std::size_t at, int by) {
  const std::size_t n = all.size();
  const auto step = [&](std::size_t i) { return (i + n + static_cast<std::size_t>(by + static_cast<int>(n))) % n; };
  std::size_t i = at;
  while (all[i].window == all[at].window && step(i) != at) i = step(i);
  const ImGuiWindow* part = all[i].window;
  return static_cast<std::size_t>(
      std::find_if(all.begin(), all.end(), [&](const Stop& s) { return s.window == part; }) - all.begin());
}

}  // namespace

void KeyboardFocus::update(ItemMap& items, ImU32 ink) {
  const ImGuiIO& io = ImGui::GetIO();
  const auto named = [](ImGuiKey key, bool repeat) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeat); };
  if (io.MouseClicked[0] || io.MouseClicked[1] || named(ImGuiKey_Escape, false)) items.set_focus({}, ink);
  if (text_is_edited() || io.KeyCtrl || io.KeyAlt) return;
  const bool popup = GImGui->OpenPopupStack.Size > 0;
  if (!popup && !before_popup_.empty()) {
    if (!items.focus().empty()) items.set_focus(before_popup_, ink);
    before_popup_.clear();
  } else if (popup && before_popup_.empty()) {
    before_popup_ = items.focus();
  }
  const bool f6 = ImGui::IsKeyPressed(kF6, false), tab = named(ImGuiKey_Tab, true);
  const bool down = popup && ImGui::IsKeyPressed(kDown), up = popup && ImGui::IsKeyPressed(kUp);
  if (f6 || tab || down || up) {
    const std::vector<Stop> all = stops(items, popup);
    if (all.empty()) return;
    const auto found = std::find_if(all.begin(), all.end(), [&](const Stop& s) { return *s.path == items.focus(); });
    const auto n = static_cast<int>(all.size()), at = static_cast<int>(found - all.begin());
    const int by = up || (io.KeyShift && !down) ? -1 : 1;
    std::size_t to = found == all.end() ? (by > 0 ? 0 : all.size() - 1) : static_cast<std::size_t>((at + by + n) % n);
    if (f6 && found != all.end()) to = next_part(all, static_cast<std::size_t>(at), by);
    items.set_focus(*all[to].path, ink);
  } else if (!items.focus().empty() && named(ImGuiKey_Enter, false)) {
    items.want(items.focus());
  }
}

}  // namespace tangent
