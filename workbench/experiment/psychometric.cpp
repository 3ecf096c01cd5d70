#include "workbench/experiment/psychometric.h"

#include <cmath>

namespace tangent::experiment {

double Psychometric::right(double segments) const {
  const double felt = 1.0 / (1.0 + std::exp((std::log(segments) - std::log(middle)) / spread));
  return kGuess + (1.0 - kGuess - lapse) * felt;
}

double Psychometric::segments_at(double right) const {
  const double felt = (right - kGuess) / (1.0 - kGuess - lapse);
  return middle * std::exp(spread * std::log((1.0 - felt) / felt));
}

}  // namespace tangent::experiment
