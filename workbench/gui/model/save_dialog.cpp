#include "workbench/gui/model/save_dialog.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <utility>

namespace tangent {

namespace fs = std::filesystem;

void SaveDialog::ask(SaveWhat what, const fs::path& folder, std::string stem, std::vector<std::string> endings) {
  what_ = what;
  endings_ = std::move(endings);
  name = std::move(stem) + endings_.front();
  asked_for_.clear();
  open_ = true;
  std::error_code ignored;
  go_to(folder_.empty() ? fs::absolute(folder, ignored) : folder_);
}

void SaveDialog::go_to(const fs::path& folder) {
  problem_.clear();
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(folder, error);
  std::vector<Entry> found;
  for (fs::directory_iterator it(whole, error), end; !error && it != end; it.increment(error)) {
    const std::string called = it->path().filename().string();
    std::error_code ignored;
    const bool is_folder = it->is_directory(ignored);
    const std::string ends_in = it->path().extension().string();
    if (called.front() == '.') continue;
    if (is_folder || std::find(endings_.begin(), endings_.end(), ends_in) != endings_.end())
      found.push_back({called, is_folder});
  }
  if (error) {
    problem_ = folder.string() + ": " + error.message() + "; choose another folder";
    return;
  }
  std::sort(found.begin(), found.end(),
            [](const Entry& a, const Entry& b) { return a.is_folder != b.is_folder ? a.is_folder : a.name < b.name; });
  folder_ = whole;
  entries_ = std::move(found);
}

void SaveDialog::choose(const Entry& entry) {
  if (entry.is_folder)
    go_to(folder_ / entry.name);
  else
    name = entry.name;
}

fs::path SaveDialog::typed() const {
  const char* home = std::getenv("HOME");
  const bool from_home = home != nullptr && (name == "~" || name.starts_with("~/"));
  return from_home ? fs::path(home + name.substr(1)) : folder_ / name;  // an absolute one replaces the folder
}

std::size_t SaveDialog::ending() const {
  const auto found = std::find(endings_.begin(), endings_.end(), fs::path(name).extension().string());
  return found == endings_.end() ? 0 : static_cast<std::size_t>(found - endings_.begin());
}

void SaveDialog::set_ending(std::size_t index) {
  fs::path path(name);
  const std::string now = path.extension().string();
  if (std::find(endings_.begin(), endings_.end(), now) != endings_.end()) path.replace_extension();
  name = path.string() + endings_[index];
}

bool SaveDialog::asks_to_replace() const { return !asked_for_.empty() && asked_for_ == typed(); }

std::optional<fs::path> SaveDialog::accept() {
  problem_.clear();
  std::error_code error;
  if (name.empty() || fs::is_directory(typed(), error)) {
    if (!name.empty()) go_to(typed());
    if (name.empty()) problem_ = "type a name";
    name.clear();
    return std::nullopt;
  }
  const std::string ends_in = fs::path(name).extension().string();
  if (std::find(endings_.begin(), endings_.end(), ends_in) == endings_.end()) name += endings_.front();
  const fs::path file = typed();
  if (!fs::is_directory(file.parent_path(), error)) {
    problem_ = file.parent_path().string() + ": there is no such folder; make it, or choose another";
    return std::nullopt;
  }
  if (fs::exists(file, error) && asked_for_ != file) {
    asked_for_ = file;
    return std::nullopt;
  }
  go_to(file.parent_path());
  open_ = false;
  return file;
}

}  // namespace tangent
