// What happens in a run besides answers, as a table: when each trial began, notes of the operator, faults, pauses. One
// row an event, on the disk before the run goes on; a row file as the answers are.
#pragma once

#include "workbench/experiment/experiment_folder.h"

#include <string>

namespace tangent::experiment {

enum class TrialEvent : std::uint8_t { started, trial, note, paused, resumed, ended };

class TrialEvents {
 public:
  /// Makes the table, or goes on with it.
  static Result<TrialEvents> open(const std::filesystem::path& rows, const Enrolment& enrolment);

  /// Tabs and line ends of the text become spaces.
  Status add(double t_s, int trial, TrialEvent event, const std::string& text);
  /// How often the trial was begun, in all starts of the program.
  int begun(int trial) const;

 private:
  explicit TrialEvents(RowFile file) : file_(std::move(file)) {}
  RowFile file_;
  std::map<int, int> begun_;
};

}  // namespace tangent::experiment
