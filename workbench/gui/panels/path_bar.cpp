// Input line for the path of a mesh or a preset: Tab completes, Enter opens, Esc closes.
#include "workbench/gui/panels/panels.h"
#include "workbench/gui/widgets/widgets.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>

namespace tangent {

namespace {

bool is_known_file(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array<const char*, 8> known{".obj", ".ply", ".stl", ".off", ".csv", ".toml", ".sqlite", ".session"};
  return std::find(known.begin(), known.end(), extension) != known.end();
}

std::string expand_home(const std::string& typed) {
  const char* home = std::getenv("HOME");
  return typed.starts_with("~/") && home != nullptr ? home + typed.substr(1) : typed;
}

int complete(ImGuiInputTextCallbackData* data) {
  const std::string typed(data->Buf, static_cast<std::size_t>(data->BufTextLen));
  const std::string longer = common_start(complete_mesh_path(typed, 10'000));
  if (longer.size() > typed.size()) {
    data->DeleteChars(0, data->BufTextLen);
    data->InsertChars(0, longer.c_str());
  }
  return 0;
}

}  // namespace

std::vector<std::string> complete_mesh_path(const std::string& typed, std::size_t most) {
  namespace fs = std::filesystem;
  const std::string expanded = expand_home(typed);
  const std::size_t slash = expanded.rfind('/');
  const std::string folder = slash == std::string::npos ? std::string() : expanded.substr(0, slash + 1);
  const std::string start = slash == std::string::npos ? expanded : expanded.substr(slash + 1);
  std::vector<std::string> out;
  std::error_code failed;
  for (fs::directory_iterator it(folder.empty() ? fs::path(".") : fs::path(folder), failed), end; !failed && it != end;
       it.increment(failed)) {
    const std::string name = it->path().filename().string();
    // Hidden files only when asked for.
    if (!name.starts_with(start) || (start.empty() && name.starts_with("."))) continue;
    std::error_code ignored;
    if (it->is_directory(ignored))
      out.push_back(folder + name + "/");
    else if (is_known_file(it->path()))
      out.push_back(folder + name);
  }
  std::sort(out.begin(), out.end());
  if (out.size() > most) out.resize(most);
  return out;
}

std::string common_start(const std::vector<std::string>& texts) {
  if (texts.empty()) return {};
  std::string common = texts.front();
  for (const std::string& text : texts) {
    const auto differ = std::mismatch(common.begin(), common.end(), text.begin(), text.end());
    common.erase(differ.first, common.end());
  }
  return common;
}

void draw_path_bar(const UiContext& ui, AppModel& model, PathBar& bar, const Rect& under) {
  const float width = std::min(ui.px(560), under.w - ui.px(20));
  ImGui::SetNextWindowPos({under.x + 0.5f * (under.w - width), under.bottom() + ui.px(4)});
  ImGui::SetNextWindowSize({width, 0.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.px(5));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ui.colours.panel_header);
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                                     ImGuiWindowFlags_NoNav;
  if (bar.focus) ImGui::SetNextWindowFocus();
  ImGui::Begin("##path_bar", nullptr, flags);
  ImGui::TextDisabled(
      "Open a mesh (obj, ply, stl, off, csv of a polygon), a preset (toml) a recording (sqlite) or a session. Tab "
      "completes, "
      "Enter "
      "opens");
  ImGui::SetNextItemWidth(-1.0f);
  if (bar.focus) edit_next("##path");
  bar.focus = false;
  const bool enter = ImGui::InputText(
      "##path", &bar.text,
      ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackCompletion | ImGuiInputTextFlags_AutoSelectAll,
      complete);
  ui.items.note_last("path_bar/text");
  const bool left = ImGui::IsItemDeactivated() && !enter;
  bar.matches = complete_mesh_path(bar.text, 8);
  bool picked = false;
  for (const std::string& match : bar.matches) {
    if (match == bar.text) continue;
    ImGui::PushFont(ui.fonts.number);
    const bool chosen = ImGui::Selectable(match.c_str());
    ImGui::PopFont();
    ui.items.note_last("path_bar/match/" + match);
    if (!chosen) continue;
    picked = true;
    bar.text = match;
    bar.focus = match.back() == '/';
    if (match.back() != '/') {
      model.open(match);
      bar.open = false;
    }
  }
  if (enter && !bar.text.empty()) {
    model.open(expand_home(bar.text));
    bar.open = false;
  }
  const bool elsewhere = left && !picked && !ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows);
  if (elsewhere || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) bar.open = false;
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
}

}  // namespace tangent
