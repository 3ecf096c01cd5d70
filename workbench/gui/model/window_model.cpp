#include "workbench/gui/model/window_model.h"

#include "core/preset/schema.h"

#include <algorithm>

namespace tangent {

namespace {

constexpr double kSettingsEvery_s = 2.0;

}  // namespace

WindowModel::WindowModel(const AppOptions& options, MessageLog& messages)
    : settings_file_(options.settings), messages_(messages), theme_(options.theme) {}

std::optional<KeptLook> WindowModel::read_settings() {
  if (auto read = read_window_settings(settings_file_))
    settings_ = std::move(*read);
  else {
    const std::filesystem::path aside = put_aside(settings_file_);
    settings_are_unread_ = aside.empty();
    messages_.say(Severity::warning,
                  read.error().message() + (aside.empty() ? " (it is left as it is; no layout is saved)"
                                                          : " (it is kept as " + aside.string() + ")"));
  }
  written_settings_ = settings_;
  if (settings_file_.empty()) return std::nullopt;
  first_start_ = !std::filesystem::exists(settings_file_);
  sizes_are_read_ = !first_start_;
  favourites_ = settings_.favourites;
  return take_look();
}

/// From settings_.
KeptLook WindowModel::take_look() {
  sizes_.left = static_cast<float>(settings_.left);
  sizes_.right = static_cast<float>(settings_.right);
  sizes_.plots = static_cast<float>(settings_.plots);
  sizes_.show_left = settings_.show_left;
  sizes_.show_right = settings_.show_right;
  sizes_.show_plots = settings_.show_plots;
  const auto task = std::find(kTaskNames.begin(), kTaskNames.end(), settings_.task);
  if (task != kTaskNames.end()) task_ = static_cast<Task>(task - kTaskNames.begin());
  const auto vision = std::find(kVisionNames.begin(), kVisionNames.end(), settings_.vision);
  theme_ = theme_of(!settings_.light_theme,
                    vision != kVisionNames.end() ? static_cast<Vision>(vision - kVisionNames.begin()) : Vision::common);
  ui_scale_ = static_cast<float>(settings_.text_size);
  plots_.take(settings_.plot_channels, settings_.channels);
  KeptLook look{settings_.y_up};
  const auto names = colour_map_names();
  const auto found = std::find(names.begin(), names.end(), settings_.colour_map);
  if (found != names.end()) look.colours = static_cast<ColourMap>(found - names.begin());
  return look;
}

KeptLook WindowModel::take(const WindowSettings& settings) {
  const std::vector<std::string> recent = std::move(settings_.recent_meshes);
  settings_ = settings;
  settings_.recent_meshes = recent;
  sizes_are_read_ = true;
  for (const std::string& key : settings.favourites)
    if (std::find(favourites_.begin(), favourites_.end(), key) == favourites_.end()) favourites_.push_back(key);
  return take_look();
}

WindowSettings WindowModel::settings_now(const KeptLook& look) {
  gather(look);
  return settings_;
}

void WindowModel::update(double now_s, const KeptLook& look) {
  now_s_ = now_s;
  if (now_s_ - settings_looked_at_s_ > kSettingsEvery_s) keep_settings(look);
}

void WindowModel::keep_settings(const KeptLook& look, double wait_s) {
  settings_looked_at_s_ = now_s_;
  gather(look);
  if (settings_file_.empty() || settings_are_unread_ || settings_ == written_settings_) return;
  const auto kept = keep_window_settings(written_settings_, settings_, settings_file_, wait_s);
  const std::string warning = kept ? kept->warning : kept.error().message();
  // Tried again every two seconds, said once.
  if (!warning.empty() && warning != last_warning_) messages_.say(Severity::warning, warning);
  last_warning_ = kept ? std::string() : warning;
  if (kept) written_settings_ = settings_;
}

void WindowModel::gather(const KeptLook& look) {
  settings_.left = static_cast<double>(sizes_.left);
  settings_.right = static_cast<double>(sizes_.right);
  settings_.plots = static_cast<double>(sizes_.plots);
  settings_.show_left = sizes_.show_left;
  settings_.show_right = sizes_.show_right;
  settings_.show_plots = sizes_.show_plots;
  settings_.task = kTaskNames[static_cast<std::size_t>(task_)];
  settings_.light_theme = !is_dark(theme_);
  settings_.vision = kVisionNames[static_cast<std::size_t>(vision_of(theme_))];
  settings_.text_size = static_cast<double>(ui_scale_);
  settings_.y_up = look.y_up;
  settings_.favourites = favourites_;
  settings_.plot_channels = plots_.changed();
  settings_.channels = plots_.made();
  settings_.colour_map = colour_map_names()[static_cast<std::size_t>(look.colours)];
}

void WindowModel::set_ui_scale(float scale) { ui_scale_ = std::clamp(scale, 0.6f, 3.0f); }

void WindowModel::show_section(const std::string& title, bool in_left_column) {
  (in_left_column ? sizes_.show_left : sizes_.show_right) = true;
  sizes_.prefer_right = !in_left_column;
  if (!in_left_column) task_ = task_with(title, task_);
  section_wanted_ = title;
}

void WindowModel::reset_layout() {
  sizes_ = {};
  task_ = Task::look;
  settings_.sections.clear();
  settings_.table_rows = 0.0;
  settings_.left_out.clear();
  plots_.reset();
}

void WindowModel::set_room(float width, float height) {
  const auto share = [](float& size, float at_first, double then, float now) {
    if (then > 0.0 && size != at_first) size *= now / static_cast<float>(then);
  };
  if (sizes_are_read_) {
    share(sizes_.left, LayoutSizes{}.left, settings_.width, width);
    share(sizes_.right, LayoutSizes{}.right, settings_.width, width);
    share(sizes_.plots, LayoutSizes{}.plots, settings_.height, height);
    sizes_ = within_limits(sizes_);
  }
  sizes_are_read_ = false;
  settings_.width = static_cast<double>(width);
  settings_.height = static_cast<double>(height);
}

bool WindowModel::is_favourite(const PresetKey& key) const {
  return std::find(favourites_.begin(), favourites_.end(), key.full_name()) != favourites_.end();
}

void WindowModel::toggle_favourite(const PresetKey& key) {
  if (std::erase(favourites_, key.full_name()) == 0) favourites_.push_back(key.full_name());
}

}  // namespace tangent
