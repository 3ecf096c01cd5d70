// Verdicts of presets on trial, by what they hang on. In memory, and in a file that a later run reads: its own folder's
// cache, which may be deleted at any time. Any thread.
#pragma once

#include "core/preset/preset.h"
#include "core/preset/schema.h"
#include "workbench/session/safe_range/loop_trial.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>

namespace tangent {

struct Verdict {
  Safety safety = Safety::unknown;
  std::uint8_t place = 0;                   ///< of the mesh, along the path
  std::uint8_t grip = 0;                    ///< of kGrips; their number: on the device itself
  UndoneBecause why = UndoneBecause::none;  ///< where the guard acted
  bool operator==(const Verdict&) const = default;
};

/// Whether a value pushes or shakes: those of the display and its controller do not move the finger.
bool is_in_loop(const PresetKey& key);
/// Whether all such values are the same.
bool same_loop(const Preset& a, const Preset& b);

/// Of everything a verdict hangs on: scene, device, every value in the loop, and how trials are made (kTrialVersion).
std::uint64_t trial_key(std::uint64_t scene_hash, const TrialDevice& device, const Preset& preset);
std::uint64_t trial_scene_hash(const ContactScene& scene);

class VerdictStore {
 public:
  static constexpr std::size_t kMost = 50'000;  ///< in the file, the newest

  std::optional<Verdict> find(std::uint64_t key) const;
  void put(std::uint64_t key, const Verdict& verdict);
  std::size_t size() const;

  /// Adds what the file holds. A missing one holds nothing. Fails on one that is not of this program or was cut off,
  /// and adds nothing.
  Status read(const std::filesystem::path& path);
  /// Writes it atomically, with what another program wrote meanwhile.
  Status write(const std::filesystem::path& path) const;

 private:
  struct Entry {
    Verdict verdict;
    std::uint64_t number = 0;  ///< the newest has the largest
  };
  mutable std::mutex mutex_;
  std::map<std::uint64_t, Entry> verdicts_;
  std::uint64_t next_ = 0;
};

}  // namespace tangent
