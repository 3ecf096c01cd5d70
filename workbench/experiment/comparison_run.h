// Experiment 1 as it runs: before each condition the exact arc in view as training; then pairs, one after the other.
// Feel the first, raise the finger, Enter; feel the second, raise the finger, 1 or 2, Enter (5.2.4). There is no way
// back, and a stimulus that was not touched, or a finger that is not raised, does not end one.
#pragma once

#include "workbench/experiment/protocol.h"
#include "workbench/experiment/shown.h"
#include "workbench/experiment/trial_clock.h"

#include <optional>
#include <vector>

namespace tangent::experiment {

/// One pair that was answered.
struct ComparisonRow {
  int trial = 0;               ///< from 0, over the whole experiment
  std::string condition;       ///< "C1"
  int condition_place = 0;     ///< from 0: which one of the participant's order
  int trial_in_condition = 0;  ///< from 0
  int segments = 0;            ///< of the comparison
  double angle_deg = 0.0;      ///< between its neighbouring segments
  int reference = 0;           ///< the exact arc was shown first or second: 1, 2
  int answer = 0;              ///< taken for the smooth one: 1, 2
  bool right = false;
  bool reversal = false;                 ///< the staircase turned
  double began_s = 0.0;                  ///< since this program was started
  double first_s = 0.0, second_s = 0.0;  ///< since the first touch of each, until Enter
  double second_touching_s = 0.0;        ///< of second_s, touching
  bool operator==(const ComparisonRow&) const = default;
};

class ComparisonRun {
 public:
  using Row = ComparisonRow;
  /// `done`: the rows of an earlier start, in order. Fails when they are not this protocol's and seed's, naming the
  /// row.
  static Result<ComparisonRun> start(const Protocol& protocol, std::uint64_t participant, std::uint64_t seed,
                                     const std::vector<ComparisonRow>& done = {});

  const Shown& shown() const { return shown_; }
  bool finished() const { return shown_.phase == Phase::finished; }
  Progress progress() const;
  /// Of the condition that runs now. Precondition: not finished.
  int trials_in_condition() const { return staircase_->trials(); }
  /// A finished trial, which has to be on the disk before the next moment.
  std::optional<ComparisonRow> advance(const Moment& moment);
  /// The pair, or the training, that was cut begins again.
  void repeat(double t_s);
  int trial() const { return trial_; }  ///< that is under way, from 0
  std::string what_is_next() const;     ///< for the operator
  /// Of the condition that runs now, or ran last. Each trial: segments, and whether the answer was right.
  const std::vector<std::pair<int, bool>>& answers() const { return answers_; }

 private:
  ComparisonRun(const Protocol& protocol, std::uint64_t participant, std::uint64_t seed);
  const ComparisonCondition& condition() const;
  void begin_condition();
  void show(Phase phase, double t_s);
  std::optional<ComparisonRow> enter(double t_s);
  ComparisonRow take_answer();
  void take(const ComparisonRow& row);
  bool reference_is_first() const;

  Protocol protocol_;
  std::uint64_t seed_;
  std::vector<std::size_t> order_;  ///< conditions
  std::size_t place_ = 0;           ///< in order_
  std::optional<Staircase> staircase_;
  std::vector<std::pair<int, bool>> answers_;
  int trial_ = 0;
  TrialClock clock_;
  ComparisonRow row_;
  Shown shown_;
};

/// Angle between neighbouring segments, degrees, by the protocol's arc. Precondition: segments >= 2.
double comparison_angle_deg(const Discrimination& design, int segments);

}  // namespace tangent::experiment
