#include "workbench/session/window_settings.h"

#include "core/io/atomic_file.h"
#include "core/io/file_format.h"
#include "core/io/file_name.h"
#include "core/io/toml_file.h"
#include "workbench/session/file_lock.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>
#include <system_error>

namespace tangent {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;
constexpr std::array<MigrationStep, 1> kSteps{only_number};
constexpr FileFormats kFormats{"window settings", kSteps};

void take(const toml::table& from, const char* key, double low, double high, double& to) {
  if (const auto value = from[key].value<double>()) to = std::clamp(*value, low, high);
}
void take(const toml::table& from, const char* key, bool& to) {
  if (const auto value = from[key].value<bool>()) to = *value;
}
void take(const toml::table& from, const char* key, std::vector<std::string>& to, std::size_t most) {
  const toml::array* list = from[key].as_array();
  if (list == nullptr) return;
  to.clear();
  for (const toml::node& node : *list) {
    if (const auto text = node.value<std::string>(); text && to.size() < most) to.push_back(file_named(*text).string());
  }
}

toml::array as_array(const std::vector<std::string>& texts) {
  toml::array out;
  for (const std::string& text : texts) out.push_back(file_name_text(text));  // meshes may be among them
  return out;
}

}  // namespace

void WindowSettings::opened(const std::string& mesh) {
  std::erase(recent_meshes, mesh);
  recent_meshes.insert(recent_meshes.begin(), mesh);
  if (recent_meshes.size() > kMostRecent) recent_meshes.resize(kMostRecent);
}

namespace {

/// Of this program, below the folder that the variable names; empty when there is no home directory.
std::filesystem::path xdg_folder(const char* variable, const char* below_home) {
  const char* named = std::getenv(variable);
  const char* home = std::getenv("HOME");
  std::filesystem::path folder;
  // The XDG specification says to ignore relative paths.
  if (named != nullptr && named[0] == '/')
    folder = named;
  else if (home != nullptr && home[0] == '/')
    folder = std::filesystem::path(home) / below_home;
  else
    return {};
  return folder / "tangent-workbench";
}

}  // namespace

std::filesystem::path window_settings_path() {
  const std::filesystem::path folder = xdg_folder("XDG_CONFIG_HOME", ".config");
  return folder.empty() ? folder : folder / "window.toml";
}

std::filesystem::path user_presets_path() {
  const std::filesystem::path folder = xdg_folder("XDG_DATA_HOME", ".local/share");
  return folder.empty() ? folder : folder / "presets";
}

namespace {

Result<WindowSettings> settings_from(toml::table root, const std::string& name) {
  WindowSettings out;
  if (const Status status = migrate(root, kFormats, name); !status) return tl::unexpected(status.error());
  if (const toml::table* layout = root["layout"].as_table()) {
    take(*layout, "left", 100.0, 2000.0, out.left);
    take(*layout, "right", 0.0, 2000.0, out.right);
    take(*layout, "plots", 0.0, 4000.0, out.plots);
    take(*layout, "width", 0.0, 20000.0, out.width);
    take(*layout, "height", 0.0, 20000.0, out.height);
    take(*layout, "show_left", out.show_left);
    take(*layout, "show_right", out.show_right);
    take(*layout, "show_plots", out.show_plots);
    if (const auto task = (*layout)["task"].value<std::string>()) out.task = *task;
    take(*layout, "table_rows", 0.0, 200.0, out.table_rows);
  }
  if (const toml::table* look = root["look"].as_table()) {
    take(*look, "light_theme", out.light_theme);
    take(*look, "text_size", 0.6, 3.0, out.text_size);
    take(*look, "y_up", out.y_up);
    if (const auto vision = (*look)["vision"].value<std::string>()) out.vision = *vision;
    if (const auto map = (*look)["colour_map"].value<std::string>()) out.colour_map = *map;
  }
  if (const toml::table* sections = root["sections"].as_table()) {
    for (const auto& [title, open] : *sections) {
      if (const auto value = open.value<bool>()) out.sections[std::string(title.str())] = *value;
    }
  }
  if (const toml::table* plots = root["plots"].as_table()) {
    for (const auto& [plot, channels] : *plots)
      if (channels.is_array())
        take(*plots, std::string(plot.str()).c_str(), out.plot_channels[std::string(plot.str())], 100);
  }
  if (const toml::table* lists = root["lists"].as_table()) {
    take(*lists, "favourites", out.favourites, 100);
    take(*lists, "recent_meshes", out.recent_meshes, WindowSettings::kMostRecent);
    take(*lists, "table_columns_left_out", out.left_out, 100);
    take(*lists, "channels", out.channels, 100);
  }
  return out;
}

constexpr const char* kSettingsRemedy = "delete the file; the window starts with its own layout";

bool is_newer(const std::filesystem::path& path) {
  const auto root = read_settings_file(path, kMaxBytes, "");
  return root && (*root)[kFormatKey].value_or(std::int64_t{0}) > kFormats.newest();
}

}  // namespace

Result<WindowSettings> read_window_settings(const std::filesystem::path& path) {
  auto read = read_settings_file(path, kMaxBytes, kSettingsRemedy);
  if (!read) return tl::unexpected(read.error());
  return settings_from(std::move(*read), path.string());
}

Result<WindowSettings> parse_window_settings(std::string_view text, std::string_view name) {
  auto root = parse_toml(text, name, kSettingsRemedy);
  if (!root) return tl::unexpected(root.error());
  return settings_from(std::move(*root), std::string(name));
}

std::string format_window_settings(const WindowSettings& s) {
  toml::table sections;
  for (const auto& [title, open] : s.sections) sections.insert(title, open);
  toml::table plots;
  for (const auto& [plot, channels] : s.plot_channels) plots.insert(plot, as_array(channels));
  const toml::table root{{"layout", toml::table{{"left", s.left},
                                                {"right", s.right},
                                                {"plots", s.plots},
                                                {"width", s.width},
                                                {"height", s.height},
                                                {"show_left", s.show_left},
                                                {"show_right", s.show_right},
                                                {"show_plots", s.show_plots},
                                                {"task", s.task},
                                                {"table_rows", s.table_rows}}},
                         {"look", toml::table{{"light_theme", s.light_theme},
                                              {"vision", s.vision},
                                              {"text_size", s.text_size},
                                              {"y_up", s.y_up},
                                              {"colour_map", s.colour_map}}},
                         {"sections", sections},
                         {"plots", plots},
                         {"lists", toml::table{{"favourites", as_array(s.favourites)},
                                               {"recent_meshes", as_array(s.recent_meshes)},
                                               {"table_columns_left_out", as_array(s.left_out)},
                                               {"channels", as_array(s.channels)}}}};
  std::ostringstream text;
  text << "# The window's layout and look, kept between runs. Delete the file for the program's own.\n"
       << kFormats.line() << root << "\n";
  return text.str();
}

namespace {

template <class T>
T merged_value(const T& before, const T& ours, const T& theirs) {
  return ours == before ? theirs : ours;
}

/// Theirs, without what we took out and with what we put in.
std::vector<std::string> merged_list(const std::vector<std::string>& before, const std::vector<std::string>& ours,
                                     std::vector<std::string> theirs) {
  const auto has = [](const std::vector<std::string>& list, const std::string& text) {
    return std::find(list.begin(), list.end(), text) != list.end();
  };
  std::erase_if(theirs, [&](const std::string& text) { return has(before, text) && !has(ours, text); });
  for (const std::string& text : ours) {
    if (!has(before, text) && !has(theirs, text)) theirs.push_back(text);
  }
  return theirs;
}

/// Latest first: where we opened any, ours come before theirs.
std::vector<std::string> merged_recent(const WindowSettings& before, const WindowSettings& ours,
                                       const WindowSettings& theirs) {
  if (ours.recent_meshes == before.recent_meshes) return theirs.recent_meshes;
  WindowSettings all = theirs;
  for (auto mesh = ours.recent_meshes.rbegin(); mesh != ours.recent_meshes.rend(); ++mesh) all.opened(*mesh);
  return all.recent_meshes;
}

}  // namespace

WindowSettings merged(const WindowSettings& before, const WindowSettings& ours, const WindowSettings& theirs) {
  WindowSettings out = theirs;
  const auto take_ours = [&](auto field) { out.*field = merged_value(before.*field, ours.*field, theirs.*field); };
  take_ours(&WindowSettings::left);
  take_ours(&WindowSettings::right);
  take_ours(&WindowSettings::plots);
  take_ours(&WindowSettings::show_left);
  take_ours(&WindowSettings::show_right);
  take_ours(&WindowSettings::show_plots);
  take_ours(&WindowSettings::light_theme);
  take_ours(&WindowSettings::text_size);
  take_ours(&WindowSettings::vision);
  take_ours(&WindowSettings::width);
  take_ours(&WindowSettings::height);
  take_ours(&WindowSettings::task);
  take_ours(&WindowSettings::table_rows);
  take_ours(&WindowSettings::y_up);
  take_ours(&WindowSettings::colour_map);
  for (const auto& [title, open] : ours.sections) {
    const auto was = before.sections.find(title);
    if (was == before.sections.end() || was->second != open) out.sections[title] = open;
  }
  std::erase_if(out.sections, [&](const auto& entry) {
    return before.sections.contains(entry.first) && !ours.sections.contains(entry.first);
  });
  take_ours(&WindowSettings::plot_channels);
  out.channels = merged_list(before.channels, ours.channels, theirs.channels);
  out.favourites = merged_list(before.favourites, ours.favourites, theirs.favourites);
  out.recent_meshes = merged_recent(before, ours, theirs);
  out.left_out = merged_list(before.left_out, ours.left_out, theirs.left_out);
  return out;
}

Result<KeptSettings> keep_window_settings(const WindowSettings& before, const WindowSettings& ours,
                                          const std::filesystem::path& path, double wait_s) {
  std::error_code failed;
  std::filesystem::create_directories(path.parent_path(), failed);
  const FileLock lock(path, wait_s);
  if (!lock.held())
    return fail("another window holds its lock, or none can be made", path.string(), "close the other window");
  const auto theirs = read_window_settings(path);
  KeptSettings kept;
  if (!theirs) {
    if (is_newer(path)) return tl::unexpected(theirs.error());
    kept.aside = put_aside(path);
    if (kept.aside.empty()) return tl::unexpected(theirs.error());
    kept.warning = theirs.error().message() + " (it is kept as " + kept.aside.string() + ")";
  }
  if (const Status written = write_window_settings(theirs ? merged(before, ours, *theirs) : ours, path); !written)
    return tl::unexpected(written.error());
  return kept;
}

std::filesystem::path put_aside(const std::filesystem::path& path) {
  for (int i = 1; i < 10; ++i) {
    const std::filesystem::path aside = path.string() + ".bad" + (i > 1 ? std::to_string(i) : "");
    std::error_code failed;
    if (std::filesystem::exists(aside, failed) || failed) continue;
    std::filesystem::rename(path, aside, failed);
    return failed ? std::filesystem::path() : aside;
  }
  return {};
}

Status write_window_settings(const WindowSettings& settings, const std::filesystem::path& path) {
  std::error_code failed;
  std::filesystem::create_directories(path.parent_path(), failed);
  return write_file_atomic(path, format_window_settings(settings), false);  // by the window: no wait for the disk
}

}  // namespace tangent
