// The psychometric function of a comparison of two: how often the answer is right, by how many segments the polygon
// has. Between guessing (1/2: too many segments to tell it from the arc) and 1 less the lapses (few segments) it falls
// along a logistic curve in the logarithm of the number of segments (Wichmann & Hill 2001).
#pragma once

namespace tangent::experiment {

inline constexpr double kGuess = 0.5;  ///< of two intervals

struct Psychometric {
  double middle = 100.0;  ///< segments at which the curve is half way down
  double spread = 0.3;    ///< of the logistic curve, in ln(segments); above 0
  double lapse = 0.02;    ///< share of answers given without having felt; below 1/2

  /// Probability of a right answer. Precondition: segments > 0.
  double right(double segments) const;
  /// Segments at which a share `right` of the answers is right. Precondition: kGuess < right < 1 - lapse.
  double segments_at(double right) const;
};

}  // namespace tangent::experiment
