// Both screens of a running experiment, from what it says of itself.
#pragma once

#include "workbench/experiment/trial_session.h"
#include "workbench/gui/experiment/force_trace.h"
#include "workbench/gui/experiment/screens.h"

#include <optional>
#include <string>
#include <string_view>

namespace tangent {

/// Of a view, and the protocol that all participants share: nothing else is known to it.
ParticipantScreen participant_screen(const experiment::ParticipantView& view, const experiment::Protocol& protocol,
                                     int choice);

/// What stays the same while it runs.
struct ExperimentFacts {
  experiment::Protocol protocol;
  std::string participant, simulated, sound;
  bool pilot = false;
};

/// Feeds the force of new ticks to the operator's curve.
class TraceFeeder {
 public:
  void take(const Session& session);
  const ForceTrace& trace() const { return trace_; }

 private:
  ForceTrace trace_;
  std::optional<std::uint64_t> last_tick_;
};

OperatorScreen operator_screen(const experiment::TrialSession& trials, const ExperimentFacts& facts,
                               const ForceTrace& trace);

/// Conditions or runs in this participant's order, with how far they are. `condition`: that runs now; `in_condition`:
/// its trials so far.
std::vector<ExperimentStage> experiment_stages(const experiment::Protocol& protocol, std::string_view participant,
                                               const std::string& condition, int in_condition, int done);

/// The staircase's answers with its reversals, by its rule.
std::vector<StaircasePoint> staircase_points(const experiment::Protocol& protocol, const std::string& condition,
                                             const std::vector<std::pair<int, bool>>& answers);

}  // namespace tangent
