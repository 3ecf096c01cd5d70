#include "workbench/bringup/proved_devices.h"

#include "core/io/atomic_file.h"
#include "core/io/file_format.h"
#include "core/io/toml_file.h"
#include "workbench/bringup/bring_up_text.h"
#include "workbench/session/file_lock.h"
#include "workbench/session/window_settings.h"

#include <array>
#include <cstdio>
#include <map>
#include <sstream>
#include <system_error>

namespace tangent {
namespace {

constexpr std::size_t kMostProvedBytes = std::size_t{1} << 20;
constexpr std::array<MigrationStep, 1> kProvedSteps{only_number};
constexpr FileFormats kProvedFormats{"list of proved devices", kProvedSteps};
constexpr const char* kProvedRemedy = "correct it, or delete the file and bring the devices up again";

using ProvedByName = std::map<std::string, ProvedDevice>;  // "falcon 77"

std::string proved_key(const std::string& kind, const std::string& serial) { return kind + " " + serial; }

ProvedDevice read_one(const std::string& key, const toml::table& table) {
  ProvedDevice d;
  const std::size_t space = key.find(' ');
  d.kind = key.substr(0, space);
  d.serial = space == std::string::npos ? "" : key.substr(space + 1);
  d.name = table["name"].value_or("");
  d.date = table["date"].value_or("");
  d.program = table["program"].value_or("");
  d.most_n = table["most_n"].value_or(0.0);
  d.all = table["all"].value_or(false);
  if (const toml::array* steps = table["proved"].as_array())
    for (const toml::node& step : *steps)
      if (const auto word = step.value<std::string>()) d.proved.push_back(*word);
  return d;
}

Result<ProvedByName> read_all(const std::filesystem::path& path) {
  ProvedByName all;
  auto root = read_settings_file(path, kMostProvedBytes, kProvedRemedy);
  if (!root) return tl::unexpected(root.error());
  if (const Status status = migrate(*root, kProvedFormats, path.string()); !status)
    return tl::unexpected(status.error());
  for (const auto& [key, node] : *root) {
    const std::string name(key.str());
    if (!node.is_table()) return fail("is not a table", path.string() + " " + name, kProvedRemedy);
    all[name] = read_one(name, *node.as_table());
  }
  return all;
}

std::string format_all(const ProvedByName& all) {
  toml::table root;
  for (const auto& [key, d] : all) {
    toml::array steps;
    for (const std::string& word : d.proved) steps.push_back(word);
    root.insert(key, toml::table{{"name", d.name},
                                 {"date", d.date},
                                 {"program", d.program},
                                 {"most_n", d.most_n},
                                 {"all", d.all},
                                 {"proved", std::move(steps)}});
  }
  std::ostringstream text;
  text << "# Force devices that were brought up (workbench devices --check), by driver and serial number.\n"
       << kProvedFormats.line() << root << "\n";
  return text.str();
}

}  // namespace

std::filesystem::path proved_devices_path() {
  const std::filesystem::path window = window_settings_path();
  return window.empty() ? window : window.parent_path() / kProvedFile;
}

ProvedDevice proved_device(const BringUpProtocol& p) {
  ProvedDevice d{p.kind, p.device.serial, p.device.name, p.date, p.program, 0.0, p.result.all_proved(), {}};
  for (std::size_t i = 0; i < p.result.facts.push_count; ++i)
    d.most_n = std::max(d.most_n, p.result.facts.pushes[i].force_n);
  for (std::size_t i = 0; i < kBringUpSteps; ++i)
    if (p.result.verdicts[i] == StepVerdict::proved) d.proved.emplace_back(step_word(static_cast<BringUpStep>(i)));
  return d;
}

std::string proved_text(const ProvedDevice& d) {
  char force[48];
  std::snprintf(force, sizeof force, ", up to %.1f N", d.most_n);
  std::string text =
      (d.all ? "all proved on " : "brought up on ") + d.date.substr(0, 10) + (d.most_n > 0.0 ? force : "");
  if (d.all) return text;
  text += "; proved: ";
  for (std::size_t i = 0; i < d.proved.size(); ++i) text += (i > 0 ? ", " : "") + d.proved[i];
  return text + (d.proved.empty() ? "nothing" : "");
}

Result<std::optional<ProvedDevice>> read_proved(const std::filesystem::path& path, const std::string& kind,
                                                const std::string& serial) {
  const auto all = read_all(path);
  if (!all) return tl::unexpected(all.error());
  const auto found = all->find(proved_key(kind, serial));
  return found == all->end() ? std::optional<ProvedDevice>() : std::optional<ProvedDevice>(found->second);
}

Status keep_proved(const std::filesystem::path& path, const ProvedDevice& proved) {
  if (proved.serial.empty())
    return fail("it has no serial number, so what was proved is not kept", proved.name, "keep the protocol (--out)");
  std::error_code failed;
  std::filesystem::create_directories(path.parent_path(), failed);
  const FileLock lock(path);
  if (!lock.held())
    return fail("another program holds its lock, or none can be made", path.string(), "close the other program");
  auto all = read_all(path);
  if (!all) return tl::unexpected(all.error());
  (*all)[proved_key(proved.kind, proved.serial)] = proved;
  return write_file_atomic(path, format_all(*all));
}

}  // namespace tangent
