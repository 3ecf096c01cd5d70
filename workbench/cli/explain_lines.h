// What solve --explain prints: a line for each tick that wants explaining, and how often each cause was told.
#pragma once

#include "core/lab/explain/explain_tick.h"

#include <array>
#include <cstdint>
#include <string>

namespace tangent {

std::string iterations_count(const TickOutput& output);  ///< "1 iteration", "2 iterations"

class ExplainLines {
 public:
  ExplainLines(std::shared_ptr<const ContactScene> scene, const Preset& preset, const ExplainOptions& options)
      : scene_(std::move(scene)), preset_(preset), options_(options) {}

  /// After every tick, in order; `before`: the state that it was given. Prints its line where it wants one.
  void after(std::uint64_t tick, const TickInput& input, const TickState& before, const TickOutput& output);

  const std::array<std::uint64_t, kTickCauses.size()>& counts() const { return counts_; }

 private:
  bool wanted(const TickOutput& output);

  std::shared_ptr<const ContactScene> scene_;
  const Preset& preset_;
  ExplainOptions options_;
  TickOutput last_;
  bool has_last_ = false;
  std::array<std::uint64_t, kTickCauses.size()> counts_{};
};

}  // namespace tangent
