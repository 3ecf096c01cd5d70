#include "workbench/session/saved_session.h"

#include "core/io/atomic_file.h"
#include "core/io/file_format.h"
#include "core/io/file_name.h"
#include "core/io/input_file.h"
#include "core/io/toml_file.h"

#include <array>
#include <sstream>

namespace tangent {

namespace {

constexpr std::size_t kMostSessionBytes = std::size_t{16} << 20;
constexpr std::array<MigrationStep, 1> kSessionSteps{only_number};
constexpr FileFormats kSessionFormats{"session", kSessionSteps};
constexpr const char* kSessionRemedy = "open the recording itself";

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return std::filesystem::absolute(file).lexically_normal().parent_path();
}

/// Written by this program just now.
toml::table as_table(const std::string& text) { return std::move(parse_toml(text, "", "").value()); }

std::string as_text(const toml::table* table) {
  std::ostringstream text;
  if (table != nullptr) text << *table << "\n";
  return text.str();
}

}  // namespace

std::string format_session(const SavedSession& session, const std::filesystem::path& file) {
  toml::table view;
  for (const auto& [name, value] : session.view) view.insert(name, value);
  WindowSettings window = session.window;
  window.recent_meshes.clear();  // of one machine
  const std::filesystem::path recording =
      std::filesystem::absolute(session.recording).lexically_normal().lexically_relative(folder_of(file));
  const toml::table root{{"recording", file_name_text(recording)},
                         {"recorded_utc", session.recorded_utc},
                         {"view", std::move(view)},
                         {"window", as_table(format_window_settings(window))},
                         {"work", as_table(format_unsaved(session.work))}};
  std::ostringstream text;
  text << "# A session: a recording, and how it was looked at. `workbench gui` opens it; keep both files together.\n"
       << kSessionFormats.line() << root << "\n";
  return text.str();
}

Result<SavedSession> parse_session(std::string_view text, const std::filesystem::path& file) {
  const std::string name = file.string();
  auto root = parse_toml(text, name, kSessionRemedy);
  if (!root) return tl::unexpected(root.error());
  if (const Status status = migrate(*root, kSessionFormats, name); !status) return tl::unexpected(status.error());
  const auto recording = (*root)["recording"].value<std::string>();
  if (!recording || recording->empty()) return fail("names no recording", name, "give a session, or the recording");
  SavedSession session;
  session.recording = (folder_of(file) / file_named(*recording)).lexically_normal();
  session.recorded_utc = (*root)["recorded_utc"].value_or(std::string());
  if (const toml::table* view = (*root)["view"].as_table())
    for (const auto& [key, node] : *view)
      if (const auto value = node.value<std::string>()) session.view[std::string(key.str())] = *value;
  Result<WindowSettings> window = parse_window_settings(as_text((*root)["window"].as_table()), name);
  if (!window) return tl::unexpected(window.error());
  session.window = std::move(*window);
  Result<UnsavedWork> work = parse_unsaved(as_text((*root)["work"].as_table()), name);
  if (!work) return tl::unexpected(work.error());
  session.work = std::move(*work);
  return session;
}

Result<SavedSession> read_session(const std::filesystem::path& file) {
  const auto text = read_input_file(file, kMostSessionBytes);
  if (!text) return tl::unexpected(text.error());
  return parse_session(*text, file);
}

Status write_session(const SavedSession& session, const std::filesystem::path& file) {
  return write_file_atomic(file, format_session(session, file));
}

}  // namespace tangent
