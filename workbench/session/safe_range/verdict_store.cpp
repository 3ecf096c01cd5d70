#include "workbench/session/safe_range/verdict_store.h"

#include "core/base/fnv.h"
#include "core/io/atomic_file.h"
#include "core/io/file_bytes.h"
#include "workbench/session/file_lock.h"

#include <algorithm>
#include <charconv>
#include <cinttypes>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace tangent {

namespace {

constexpr std::uint64_t kTrialVersion = 2;  // another one where trials are made or judged otherwise
constexpr std::string_view kFirstLine = "tangent-workbench safe ranges 1\n";
constexpr std::size_t kLineBytes = 22;  // "0123456789abcdef 1234\n": safety, place, grip, why

void append_line(std::string& to, std::uint64_t key, const Verdict& v) {
  char text[kLineBytes + 1];
  std::snprintf(text, sizeof text, "%016" PRIx64 " %u%u%u%u\n", key, static_cast<unsigned>(v.safety) % 10u,
                v.place % 10u, v.grip % 10u, static_cast<unsigned>(v.why) % 10u);
  to += text;
}

/// A line without its end; empty: it is none.
std::optional<std::pair<std::uint64_t, Verdict>> parse_line(std::string_view line) {
  if (line.size() != kLineBytes - 1 || line[16] != ' ') return std::nullopt;
  std::uint64_t key = 0;
  const auto [end, error] = std::from_chars(line.data(), line.data() + 16, key, 16);
  const auto digit = [&](std::size_t i) { return static_cast<unsigned>(line[17 + i]) - unsigned{'0'}; };
  const bool allowed = digit(0) <= 2u && digit(1) < kTouchPlaces && digit(2) <= kGrips.size() && digit(3) <= 3u;
  if (error != std::errc() || end != line.data() + 16 || !allowed) return std::nullopt;
  return std::pair{key, Verdict{static_cast<Safety>(digit(0)), static_cast<std::uint8_t>(digit(1)),
                                static_cast<std::uint8_t>(digit(2)), static_cast<UndoneBecause>(digit(3))}};
}

}  // namespace

bool is_in_loop(const PresetKey& key) { return key.table != "display" && key.table != "controller"; }

bool same_loop(const Preset& a, const Preset& b) {
  const auto keys = preset_keys();
  return std::all_of(keys.begin(), keys.end(),
                     [&](const PresetKey& key) { return !is_in_loop(key) || key.get(a) == key.get(b); });
}

std::uint64_t trial_scene_hash(const ContactScene& scene) {
  Fnv hash;
  hash.add_bits(std::uint64_t{scene.planar() != nullptr});
  if (scene.has_mesh()) {
    hash.add_bits(scene.mesh().content_hash());
    for (int axis = 0; axis < 3; ++axis) hash.add_bits(scene.mesh().origin()[axis]);
  }
  return hash.value();
}

std::uint64_t trial_key(std::uint64_t scene, const TrialDevice& device, const Preset& preset) {
  Fnv hash;
  hash.add_bits(kTrialVersion).add_bits(scene);
  for (const double value : {device.mass_kg, device.friction_n, device.step_m, device.rate_hz, device.scale})
    hash.add_bits(value);
  for (const PresetKey& key : preset_keys())
    if (is_in_loop(key)) hash.add_bits(key.get(preset));
  return hash.value();
}

std::optional<Verdict> VerdictStore::find(std::uint64_t key) const {
  const std::lock_guard lock(mutex_);
  const auto found = verdicts_.find(key);
  return found == verdicts_.end() ? std::nullopt : std::optional(found->second.verdict);
}

void VerdictStore::put(std::uint64_t key, const Verdict& verdict) {
  const std::lock_guard lock(mutex_);
  verdicts_[key] = {verdict, next_++};
}

std::size_t VerdictStore::size() const {
  const std::lock_guard lock(mutex_);
  return verdicts_.size();
}

Status VerdictStore::read(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return {};
  const auto refuse = [&](const char* what) {
    return fail(what, path.string(), "delete it: the safe ranges are then swept again");
  };
  const auto bytes = read_file_bytes(path);
  if (!bytes) return tl::unexpected(bytes.error());
  std::string_view text = bytes->view();
  if (!text.starts_with(kFirstLine)) return refuse("is no file of safe ranges of this program");
  text.remove_prefix(kFirstLine.size());
  if (text.size() % kLineBytes != 0 || text.size() / kLineBytes > 2 * kMost) return refuse("was cut off");
  std::vector<std::pair<std::uint64_t, Verdict>> read;
  for (; !text.empty(); text.remove_prefix(kLineBytes)) {
    const auto line = parse_line(text.substr(0, kLineBytes - 1));
    if (!line || text[kLineBytes - 1] != '\n') return refuse("has a line that is no verdict");
    read.push_back(*line);
  }
  const std::lock_guard lock(mutex_);
  for (const auto& [key, verdict] : read)
    if (!verdicts_.contains(key)) verdicts_[key] = {verdict, next_++};
  return {};
}

Status VerdictStore::write(const std::filesystem::path& path) const {
  std::error_code ignored;
  std::filesystem::create_directories(path.parent_path(), ignored);
  const FileLock file_lock(path);
  if (!file_lock.held())
    return fail("another program holds its lock, or none can be made", path.string(), "close the other program");
  VerdictStore all;
  static_cast<void>(all.read(path));  // what can't be read is written over
  std::vector<std::pair<std::uint64_t, Entry>> entries;
  {
    const std::lock_guard lock(mutex_);
    entries.assign(verdicts_.begin(), verdicts_.end());
  }
  std::sort(entries.begin(), entries.end(),
            [](const auto& a, const auto& b) { return a.second.number < b.second.number; });
  for (const auto& [key, entry] : entries) all.put(key, entry.verdict);
  entries.assign(all.verdicts_.begin(), all.verdicts_.end());
  std::sort(entries.begin(), entries.end(),
            [](const auto& a, const auto& b) { return a.second.number < b.second.number; });
  std::string text(kFirstLine);
  for (std::size_t i = entries.size() - std::min(entries.size(), kMost); i < entries.size(); ++i)
    append_line(text, entries[i].first, entries[i].second.verdict);
  return write_file_atomic(path, text);
}

}  // namespace tangent
