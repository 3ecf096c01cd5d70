// A run of either experiment with its rows on disk: an answer is in the file before the next stimulus is shown, or the
// run says what it owes and takes nothing more.
#pragma once

#include "workbench/experiment/comparison_run.h"
#include "workbench/experiment/experiment_folder.h"
#include "workbench/experiment/naming_run.h"

#include <optional>
#include <variant>

namespace tangent::experiment {

class TrialRun {
 public:
  /// Enrols the participant, or goes on where their rows end. Fails as enrol does, for a participant without a number,
  /// and for one who has answered everything.
  static Result<TrialRun> start(const std::filesystem::path& folder, const Protocol& protocol,
                                const std::string& protocol_text, const Enrolment& enrolment,
                                std::int64_t now_utc_s = utc_now_s());

  const Shown& shown() const;
  bool finished() const { return shown().phase == Phase::finished && !owed_; }
  Progress progress() const;
  int trial() const;  ///< that is under way, from 0
  std::string what_is_next() const;
  /// Of a comparison's condition: segments, and whether the answer was right. Empty: objects are named.
  std::vector<std::pair<int, bool>> staircase() const;
  const std::filesystem::path& rows() const { return rows_; }
  std::size_t answers() const { return file_.count(); }  ///< on the disk
  /// "complete", "session 1 of 2 complete", or that it was ended before.
  std::string outcome() const;
  /// Whether what comes next begins another session than the newest answer's.
  bool begins_session() const;
  /// Added to the onsets of rows: how long after the first start of the program this one began.
  void set_begun_after(double seconds) { begun_after_s_ = seconds; }

  /// The next moment. Fails where an answer can't be written: it is kept, and nothing is taken until `settle` succeeds.
  Status advance(const Moment& moment, const RowOrigin& origin);
  /// Tries again to write the answer that is owed.
  Status settle();
  bool owes() const { return owed_.has_value(); }
  /// The trial that was cut begins again.
  void repeat(double t_s);

 private:
  using Either = std::variant<ComparisonRun, NamingRun>;
  TrialRun(Either run, RowFile file, RunMark mark, std::filesystem::path rows)
      : run_(std::move(run)), file_(std::move(file)), mark_(std::move(mark)), rows_(std::move(rows)) {}

  Either run_;
  RowFile file_;
  RunMark mark_;
  std::filesystem::path rows_;
  std::optional<Fields> owed_;
  double begun_after_s_ = 0.0;
};

}  // namespace tangent::experiment
