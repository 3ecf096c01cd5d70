#include "workbench/cli/explain_lines.h"

#include "core/tick/sources.h"
#include "workbench/cli/count_text.h"
#include "workbench/cli/text_format.h"

#include <cstdio>

namespace tangent {

std::string iterations_count(const TickOutput& output) {
  return count_text(static_cast<std::uint64_t>(output.iterations), "iteration", "iterations");
}

bool ExplainLines::wanted(const TickOutput& output) {
  const bool raw = !is_smooth(reported_method(preset_));
  const bool jumped = raw && has_last_ && normal_jumped(last_, output);
  last_ = output;
  has_last_ = true;
  return jumped || wants_explaining(output, options_);
}

void ExplainLines::after(std::uint64_t tick, const TickInput& input, const TickState& before,
                         const TickOutput& output) {
  if (!wanted(output)) return;
  const TickExplanation e = explain_tick(scene_, preset_, input, before, options_);
  if (e.cause == TickCause::nothing) return;
  ++counts_[static_cast<std::size_t>(e.cause)];
  std::fputs(format("tick %llu at %.6g s, %s, event %s, %s: %s. %s\n", (unsigned long long)tick, input.t_s,
                    to_string(output.status), to_string(output.event), iterations_count(output).c_str(),
                    to_string(e.cause), explanation_text(e).c_str())
                 .c_str(),
             stdout);
}

}  // namespace tangent
