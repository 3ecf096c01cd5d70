// What happens in a run besides answers, as a table: when each interval began, notes of the operator, faults, pauses.
// One row an event, on the disk before the run goes on; a row file as the answers are.
#pragma once

#include "workbench/experiment/experiment_folder.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tangent::experiment {

/// `trial`: the first of two, or the object to be named, is shown; `second`: the second of two. Those of Phase besides.
enum class TrialEvent : std::uint8_t {
  started,
  trial,
  note,
  paused,
  resumed,
  ended,
  training,
  guide,
  second,
  rest,
  armed,
};

class TrialEvents {
 public:
  /// Makes the table, with what its columns mean beside it, or goes on with it. Fails where its end was cut off.
  static Result<TrialEvents> open(const std::filesystem::path& rows, const Enrolment& enrolment);

  /// Tabs and line ends of the text become spaces. `onset_s`: since the first start; never before `newest_s`.
  Status add(double onset_s, int trial, TrialEvent event, const std::string& text);
  /// How often the trial was begun, in all starts of the program.
  int begun(int trial) const;
  /// Onset of the newest start that began before this trial: of the session before, where the trial begins a session.
  std::optional<double> started_before_s(int trial) const;
  double newest_s() const { return newest_s_; }  ///< onset of the newest, 0: there is none
  std::size_t count() const { return file_.count(); }

 private:
  explicit TrialEvents(RowFile file) : file_(std::move(file)) {}
  RowFile file_;
  std::map<int, int> begun_;
  std::vector<std::pair<int, double>> starts_;  ///< trial under way, onset
  double newest_s_ = 0.0;
};

/// Why the events beside a participant's rows do not fit these: lines that were changed, left out or cut off, or a
/// trial that was begun after one whose answer is missing. Empty: they fit, or there never were any.
Result<std::string> events_complaint(const std::filesystem::path& rows, const Sidecar& sidecar, std::size_t answers);

}  // namespace tangent::experiment
