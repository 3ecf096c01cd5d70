// Experiment 2 as it runs: the finger is drawn to the start and waits there, a ding, one object is explored and named
// by a key, which can't be taken back (5.3.4). Before each kind of feedback a practice object in view; a rest between
// blocks. A session is a run of the program.
#pragma once

#include "workbench/experiment/order.h"
#include "workbench/experiment/shown.h"
#include "workbench/experiment/trial_clock.h"

#include <optional>
#include <vector>

namespace tangent::experiment {

/// One object that was named.
struct NamingRow {
  int trial = 0;                        ///< from 0, over all sessions
  int session = 1, block = 1, run = 1;  ///< from 1; block of its session, run of its block
  std::string object;
  bool shaded = false, tactile = false;
  Facing facing = Facing::right;
  std::string answer;
  bool right = false;
  double began_s = 0.0;        ///< the ding, since this program was started
  double since_touch_s = 0.0;  ///< from the first touch to the answer
  double touching_s = 0.0;     ///< of that, touching
  bool operator==(const NamingRow&) const = default;
};

class NamingRun {
 public:
  using Row = NamingRow;
  /// `done`: the rows of earlier starts, in order. Goes on with the session of the first trial that is missing. Fails
  /// when they are not this protocol's and seed's, naming the row.
  static Result<NamingRun> start(const Protocol& protocol, std::uint64_t participant, std::uint64_t seed,
                                 const std::vector<NamingRow>& done = {});

  const Shown& shown() const { return shown_; }
  bool finished() const { return shown_.phase == Phase::finished; }  ///< this session
  bool all_done() const { return next_ == trials_.size(); }
  /// What comes next is the first trial of another session than the one before.
  bool begins_session() const;
  std::string session_text() const;  ///< of the newest answer: "session 1 of 2"; the first where there is none
  Progress progress() const { return {static_cast<int>(next_), static_cast<int>(trials_.size())}; }
  /// A finished trial, which has to be on the disk before the next moment.
  std::optional<NamingRow> advance(const Moment& moment);
  /// The trial, or the practice, that was cut begins again: the finger is drawn to the start.
  void repeat(double t_s);
  int trial() const { return static_cast<int>(next_); }  ///< that is under way, from 0
  std::string what_is_next() const;                      ///< for the operator

 private:
  NamingRun(const Protocol& protocol, std::uint64_t participant, std::uint64_t seed);
  const Identification& design() const { return *protocol_.identification(); }
  void begin(double t_s, bool first);
  void show(Phase phase, double t_s);
  void wait_at_start(const Moment& moment);
  std::optional<NamingRow> take_digit(int digit, double t_s);
  NamingRow row_of(std::size_t trial, std::size_t answer) const;

  Protocol protocol_;
  std::vector<ObjectTrial> trials_;
  std::size_t next_ = 0;
  double held_since_s_ = -1.0;  ///< at the start; below 0: not there
  TrialClock clock_;
  Shown shown_;
};

}  // namespace tangent::experiment
