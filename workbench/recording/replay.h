// Computes the ticks of a recording again and compares every bit of their outputs. The kept states divide it, so that
// several threads work on it at once.
#pragma once

#include "workbench/recording/computable_recording.h"

#include <atomic>
#include <functional>
#include <map>

namespace tangent {

struct ReplayOptions {
  /// Only the ticks with a kept state: about one a second.
  bool every_second = false;
  unsigned threads = 2;
  /// In place of the scenes in the file, for one that was recorded without them; must have the recorded hash.
  std::shared_ptr<const ContactScene> scene;
  std::function<bool()> cancelled = [] { return false; };
  std::function<void(std::uint64_t)> progress = [](std::uint64_t) {};  ///< ticks so far, from any thread
};

struct TickDifference {
  std::uint64_t tick = 0;
  std::string field;  ///< a column; "state": what the tick before left; "digest": the file's own digest is wrong
  std::string recorded, computed;
};

struct ReplayReport {
  std::uint64_t checked = 0;    ///< ticks
  std::uint64_t different = 0;  ///< of those
  std::uint64_t states = 0;     ///< kept states that ticks led to, compared too
  std::optional<TickDifference> first;
  std::map<std::string, double> largest;         ///< of each number that differs: the largest difference
  std::map<std::string, std::uint64_t> changed;  ///< of each field that differs: in how many ticks
  bool cancelled = false;
  bool same() const { return different == 0 && !first; }
};

/// Fails where the recording can't be computed again: its kept states are of another layout, its mesh is missing, a
/// preset is not there, or it is damaged.
Result<ReplayReport> replay(const std::filesystem::path& path, const ReplayOptions& options = {});

}  // namespace tangent
