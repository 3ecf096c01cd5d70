// The part of the model that is about the window itself: what is kept between runs, views, screenshots.
#include "workbench/gui/model/app_model.h"

#include <imgui.h>

#include <algorithm>
#include <ctime>
#include <system_error>

namespace tangent {

namespace {

std::string time_stamp() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[32];
  std::strftime(text, sizeof text, "%Y%m%d-%H%M%S", &local);
  return text;
}

}  // namespace

void AppModel::take_settings() {
  if (auto read = read_window_settings(options_.settings))
    settings_ = std::move(*read);
  else
    say(Severity::warning, read.error().message());
  written_settings_ = settings_;
  if (options_.settings.empty()) return;
  sizes_.left = static_cast<float>(settings_.left);
  sizes_.right = static_cast<float>(settings_.right);
  sizes_.plots = static_cast<float>(settings_.plots);
  sizes_.show_left = settings_.show_left;
  sizes_.show_right = settings_.show_right;
  sizes_.show_plots = settings_.show_plots;
  theme_ = settings_.light_theme ? Theme::light : Theme::dark;
  ui_scale_ = static_cast<float>(settings_.text_size);
  view_.camera.y_up = settings_.y_up;
  favourites_ = settings_.favourites;
  const auto names = colour_map_names();
  const auto found = std::find(names.begin(), names.end(), settings_.colour_map);
  if (found != names.end()) map_.colours = static_cast<ColourMap>(found - names.begin());
}

void AppModel::show_section(const std::string& title, bool in_left_column) {
  (in_left_column ? sizes_.show_left : sizes_.show_right) = true;
  section_wanted_ = title;
}

void AppModel::keep_settings() {
  settings_looked_at_s_ = now_s_;
  settings_.left = static_cast<double>(sizes_.left);
  settings_.right = static_cast<double>(sizes_.right);
  settings_.plots = static_cast<double>(sizes_.plots);
  settings_.show_left = sizes_.show_left;
  settings_.show_right = sizes_.show_right;
  settings_.show_plots = sizes_.show_plots;
  settings_.light_theme = theme_ == Theme::light;
  settings_.text_size = static_cast<double>(ui_scale_);
  settings_.y_up = view_.camera.y_up;
  settings_.favourites = favourites_;
  settings_.colour_map = colour_map_names()[static_cast<std::size_t>(map_.colours)];
  if (options_.settings.empty() || settings_ == written_settings_) return;
  if (auto written = write_window_settings(settings_, options_.settings); !written)
    say(Severity::warning, written.error().message());
  written_settings_ = settings_;  // said once, not every two seconds
}

void AppModel::reset_layout() {
  sizes_ = {};
  settings_.sections.clear();
}

// Who looks at the whole scene goes on doing so; who has gone near to something stays there.
void AppModel::look_from_standard(StandardView view) {
  const bool whole =
      view_.camera.target == view_.camera.scene_centre && view_.camera.distance_m == view_.framed_distance_m;
  view_.camera = standard_view(view, view_.camera);
  if (whole) frame_scene();
}

void AppModel::set_y_up(bool y_up) {
  view_.camera.y_up = y_up;
  frame_scene();
}

void AppModel::copy_camera() {
  ImGui::SetClipboardText(camera_text(view_.camera).c_str());
  say(Severity::note, "the camera is on the clipboard");
}

void AppModel::paste_camera() {
  const char* text = ImGui::GetClipboardText();
  const auto camera = parse_camera(text != nullptr ? text : "", view_.camera);
  if (camera)
    view_.camera = *camera;
  else
    say(Severity::error, "the clipboard holds no camera; copy one with Ctrl+Shift+C");
}

std::optional<std::filesystem::path> AppModel::take_screenshot_request() {
  if (!screenshot_wanted_) return std::nullopt;
  screenshot_wanted_ = false;
  const std::string name = "tangent-workbench-" + time_stamp();
  std::filesystem::path path = options_.screenshots / (name + ".png");
  std::error_code ignored;
  for (int i = 2; std::filesystem::exists(path, ignored); ++i)
    path = options_.screenshots / (name + "-" + std::to_string(i) + ".png");
  return path;
}

}  // namespace tangent
