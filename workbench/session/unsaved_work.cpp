#include "workbench/session/unsaved_work.h"

#include "core/base/text.h"
#include "core/io/atomic_file.h"
#include "core/io/file_format.h"
#include "core/io/file_name.h"
#include "core/io/input_file.h"
#include "core/io/toml_file.h"
#include "core/preset/schema.h"
#include "workbench/session/window_settings.h"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <system_error>

namespace tangent {

namespace {

constexpr std::size_t kMostUnsavedBytes = std::size_t{16} << 20;
constexpr std::array<MigrationStep, 1> kUnsavedSteps{only_number};
constexpr FileFormats kUnsavedFormats{"unsaved work", kUnsavedSteps};
constexpr const char* kUnsavedRemedy = "delete the file";

/// As text: TOML's numbers need not read back as the same double.
toml::table values_of(const Preset& preset) {
  toml::table values;
  for (const PresetKey& key : preset_keys()) {
    const double value = key.get(preset);
    if (value == key.default_value()) continue;
    std::string text;
    append_double(text, value);
    values.insert(key.full_name(), text);
  }
  return values;
}

bool read_values(const toml::table* values, Preset& preset) {
  if (values == nullptr) return false;
  for (const PresetKey& key : preset_keys()) {
    const auto text = (*values)[key.full_name()].value<std::string>();
    if (!text) continue;
    double value = 0.0;
    const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
    if (error != std::errc() || end != text->data() + text->size() || !(value == value)) return false;
    key.set(preset, std::clamp(value, key.min, key.max));
  }
  return true;
}

toml::table table_of(const UnsavedPreset& slot) {
  return toml::table{{"name", file_name_text(slot.name)},
                     {"path", file_name_text(slot.path)},
                     {"loaded", values_of(slot.loaded)},
                     {"current", values_of(slot.current)}};
}

bool read_slot(const toml::table* table, UnsavedPreset& slot) {
  if (table == nullptr) return false;
  slot.name = file_named((*table)["name"].value_or(std::string())).string();
  slot.path = file_named((*table)["path"].value_or(std::string()));
  return read_values((*table)["loaded"].as_table(), slot.loaded) &&
         read_values((*table)["current"].as_table(), slot.current);
}

bool read_step(const toml::node& node, UnsavedStep& step) {
  const toml::table* table = node.as_table();
  if (table == nullptr) return false;
  step.what = file_named((*table)["what"].value_or(std::string())).string();  // may name a file
  step.active = (*table)["active"].value_or(std::int64_t{0}) == 1 ? 1 : 0;
  return read_slot((*table)["a"].as_table(), step.slots[0]) && read_slot((*table)["b"].as_table(), step.slots[1]);
}

toml::array array_of(const std::vector<UnsavedBookmark>& marks) {
  toml::array bookmarks;
  for (const UnsavedBookmark& mark : marks)
    bookmarks.push_back(
        toml::table{{"tick", static_cast<std::int64_t>(mark.tick)}, {"t_s", mark.t_s}, {"note", mark.note}});
  return bookmarks;
}

std::uint64_t tick_in(const toml::table& table) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, table["tick"].value_or(std::int64_t{0})));
}

bool read_bookmarks(const toml::array* marks, std::vector<UnsavedBookmark>& out) {
  if (marks == nullptr) return true;
  for (const toml::node& node : *marks) {
    const toml::table* table = node.as_table();
    if (table == nullptr) return false;
    out.push_back({tick_in(*table), (*table)["t_s"].value_or(0.0), (*table)["note"].value_or(std::string())});
  }
  return true;
}

/// Files of older programs have none.
bool read_opened(const toml::table* table, UnsavedRecording& opened) {
  if (table == nullptr) return true;
  opened.file = file_named((*table)["file"].value_or(std::string()));
  opened.tick = tick_in(*table);
  return read_bookmarks((*table)["bookmarks"].as_array(), opened.bookmarks);
}

}  // namespace

std::string format_unsaved(const UnsavedWork& work) {
  toml::array steps;
  for (const UnsavedStep& step : work.steps) {
    steps.push_back(toml::table{{"what", file_name_text(step.what)},
                                {"active", static_cast<std::int64_t>(step.active)},
                                {"a", table_of(step.slots[0])},
                                {"b", table_of(step.slots[1])}});
  }
  toml::table root{
      {"at", static_cast<std::int64_t>(work.at)}, {"steps", std::move(steps)}, {"bookmarks", array_of(work.bookmarks)}};
  if (!work.opened.file.empty())
    root.insert("opened", toml::table{{"file", file_name_text(work.opened.file)},
                                      {"tick", static_cast<std::int64_t>(work.opened.tick)},
                                      {"bookmarks", array_of(work.opened.bookmarks)}});
  if (!work.made.empty()) root.insert("made", file_name_text(work.made));
  std::ostringstream text;
  text << "# What is in no other file, for the case that the program crashes. Removed when its window is closed.\n"
       << kUnsavedFormats.line() << root << "\n";
  return text.str();
}

Result<UnsavedWork> parse_unsaved(std::string_view text, std::string_view name) {
  auto root = parse_toml(text, name, kUnsavedRemedy);
  if (!root) return tl::unexpected(root.error());
  if (const Status status = migrate(*root, kUnsavedFormats, name); !status) return tl::unexpected(status.error());
  const auto broken = [&] { return fail("is not what this program wrote", std::string(name), kUnsavedRemedy); };
  UnsavedWork work;
  if (const toml::array* steps = (*root)["steps"].as_array()) {
    for (const toml::node& node : *steps) {
      if (!read_step(node, work.steps.emplace_back())) return broken();
    }
  }
  if (!read_bookmarks((*root)["bookmarks"].as_array(), work.bookmarks) ||
      !read_opened((*root)["opened"].as_table(), work.opened))
    return broken();
  work.made = file_named((*root)["made"].value_or(std::string()));
  const std::int64_t at = (*root)["at"].value_or(std::int64_t{-1});
  if (at < 0 || (at > 0 && static_cast<std::size_t>(at) >= work.steps.size())) return broken();
  work.at = static_cast<std::size_t>(at);
  return work;
}

// --- Files ---------------------------------------------------------------------------------------------

UnsavedKeeper::UnsavedKeeper(std::filesystem::path folder) {
  if (folder.empty()) return;
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  // A second window of this process, as tests have, takes another name.
  // So does one whose process id a crashed run had: that run's file is still to be offered.
  for (int i = 0; i < 100; ++i) {
    file_ = folder / (std::to_string(::getpid()) + (i > 0 ? "-" + std::to_string(i) : "") + ".toml");
    lock_.emplace(file_, 0.0);
    if (lock_->held() && !std::filesystem::exists(file_, failed)) return;
  }
  lock_.reset();
  file_.clear();
}

UnsavedKeeper::~UnsavedKeeper() {
  if (file_.empty() || (left_ && is_there_)) return;
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
  std::filesystem::remove(file_.string() + ".lock", ignored);
}

Status UnsavedKeeper::keep(const UnsavedWork& work) {
  if (file_.empty()) return {};
  std::string text = work.empty() ? std::string() : format_unsaved(work);
  std::error_code ignored;
  if (is_there_ && !std::filesystem::exists(file_, ignored)) written_.clear();
  if (text == written_) return {};
  written_ = std::move(text);  // so that a failure is reported once
  if (!written_.empty()) {
    const Status written = write_file_atomic(file_, written_, false);  // by the window: no wait for the disk
    is_there_ = written.has_value();
    return written;
  }
  is_there_ = false;
  std::filesystem::remove(file_, ignored);
  return {};
}

namespace {

/// While it is held, so that nobody else takes it meanwhile (file_lock.h).
void remove_lock_of(const std::filesystem::path& file) {
  std::error_code ignored;
  std::filesystem::remove(file.string() + ".lock", ignored);
}

void remove_stray_lock(const std::filesystem::path& lock_file) {
  const std::filesystem::path file = lock_file.parent_path() / lock_file.stem();
  const FileLock lock(file, 0.0);
  std::error_code unknown;
  if (lock.held() && !std::filesystem::exists(file, unknown) && !unknown) remove_lock_of(file);
}

}  // namespace

std::optional<LeftWork> find_left_work(const std::filesystem::path& folder, std::vector<UnreadWork>* unread) {
  std::vector<std::filesystem::path> files, locks;
  std::error_code failed;
  for (std::filesystem::directory_iterator it(folder, failed), end; !failed && it != end; it.increment(failed)) {
    if (it->path().extension() == ".toml") files.push_back(it->path());
    if (it->path().extension() == ".lock" && it->path().stem().extension() == ".toml") locks.push_back(it->path());
  }
  for (const std::filesystem::path& lock : locks) remove_stray_lock(lock);
  const auto age = [](const std::filesystem::path& file) {
    std::error_code unknown;
    return std::filesystem::last_write_time(file, unknown);
  };
  std::sort(files.begin(), files.end(), [&](const auto& a, const auto& b) { return age(a) > age(b); });
  for (const std::filesystem::path& file : files) {
    const FileLock lock(file, 0.0);
    if (!lock.held()) continue;  // its window is open
    const auto text = read_input_file(file, kMostUnsavedBytes);
    const auto work = text ? parse_unsaved(*text, file.string()) : tl::unexpected(text.error());
    if (work && !work->empty()) return LeftWork{*work, file};
    const std::filesystem::path aside = put_aside(file);
    if (!aside.empty()) remove_lock_of(file);
    if (unread != nullptr) unread->push_back({file, aside});
  }
  return std::nullopt;
}

void forget_left_work(const LeftWork& left) {
  const FileLock lock(left.file, 0.0);
  if (!lock.held()) return;  // a window has it for its own work
  std::error_code ignored;
  std::filesystem::remove(left.file, ignored);
  remove_lock_of(left.file);
}

}  // namespace tangent
