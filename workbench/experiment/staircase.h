// An adaptive staircase: the number of segments follows the answers, so that it stays where a participant is right
// with a known probability (Levitt 1971). After one wrong answer the next comparison has fewer segments and is easier,
// after `down` right ones in a row it has more.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace tangent::experiment {

enum class StepScale : std::uint8_t {
  ratio,     ///< a step multiplies or divides the number of segments
  segments,  ///< a step adds or takes so many
};
inline constexpr std::array<std::string_view, 2> kStepScaleNames{"ratio", "segments"};

struct StaircaseRule {
  StepScale scale = StepScale::ratio;
  double start = 20.0;                 ///< segments
  double large_step = 2.0;             ///< up to and with the step that makes reversal `large_reversals`
  double small_step = 1.19;            ///< after it
  int large_reversals = 3;             ///< 5.2.4
  int reversals = 11;                  ///< ends the staircase, 5.2.4
  int averaged = 6;                    ///< of the last reversals, 5.2.5
  int down = 2;                        ///< right answers in a row for a harder comparison, 5.2.4
  double fewest = 2.0, most = 2000.0;  ///< segments
  int most_trials = 400;               ///< ends a staircase that does not settle
  bool operator==(const StaircaseRule&) const = default;
};

/// The probability of a right answer at which up and down balance: the root of p^down = 1/2.
double balance_point(const StaircaseRule& rule);

class Staircase {
 public:
  explicit Staircase(const StaircaseRule& rule) : rule_(rule), level_(rule.start) {}

  /// Of the next comparison.
  int segments() const;
  /// Takes the answer to it. True: it made a reversal.
  bool answer(bool right);
  /// All reversals are there, or the trials ran out.
  bool done() const;
  /// All reversals are there.
  bool settled() const { return reversals_.size() >= static_cast<std::size_t>(rule_.reversals); }
  int trials() const { return trials_; }
  const std::vector<double>& reversals() const { return reversals_; }  ///< segments shown where it turned
  /// Mean of the last `averaged` reversals, segments. Precondition: settled().
  double threshold() const;

 private:
  void step(int direction);
  StaircaseRule rule_;
  double level_;
  int direction_ = 0;  ///< of the last step: +1 harder, -1 easier, 0 none yet
  int right_in_row_ = 0, trials_ = 0;
  std::vector<double> reversals_;
};

}  // namespace tangent::experiment
