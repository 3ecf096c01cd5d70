// Why ticks of a recording did what they did: computed again from the last kept state, and explained
// (core/lab/explain).
#pragma once

#include "core/lab/explain/explain_tick.h"
#include "workbench/recording/tick_walk.h"

#include <functional>

namespace tangent {

struct ExplainedTick {
  std::uint64_t tick = 0;
  double t_s = 0.0;
  TickExplanation why;
  bool same_bits = false;  ///< computed again it is what was recorded; else what is explained is this program's tick
};

struct ExplainRecordingOptions {
  ExplainOptions explain;
  /// In place of the scenes in the file, for one that was recorded without them; must have the recorded hash.
  std::shared_ptr<const ContactScene> scene;
  std::uint64_t most = 20'000;  ///< ticks to explain at most; over that only the first of each 8 s
  unsigned threads = 2;
  std::function<bool()> cancelled = [] { return false; };
  std::function<void(std::uint64_t)> progress = [](std::uint64_t) {};  ///< ticks so far, from any thread
};

/// One tick. Fails as replay does, and where there is no such tick.
Result<ExplainedTick> explain_recorded_tick(const std::filesystem::path& path, std::uint64_t tick,
                                            const ExplainRecordingOptions& options = {});

struct CauseInRecording {
  TickCause cause = TickCause::not_told;
  std::uint64_t ticks = 0;
  ExplainedTick worst;  ///< without a contact before those with one, then by error, then by planes
};

struct ExplainedRecording {
  std::uint64_t ticks = 0, wanted = 0, explained = 0;
  std::vector<CauseInRecording> causes;  ///< the most frequent first
  bool cancelled = false;                ///< then it is of the ticks until then
};

/// All ticks that want explaining. Fails as replay does.
Result<ExplainedRecording> explain_recording(const std::filesystem::path& path,
                                             const ExplainRecordingOptions& options = {});

}  // namespace tangent
