#include "workbench/sweep/front.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tangent::sweep {

bool dominates(const Trial& a, const Trial& b) {
  if (a.missed != b.missed) return a.missed < b.missed;
  bool better = false;
  for (std::size_t i = 0; i < a.objectives.size(); ++i) {
    if (a.objectives[i] > b.objectives[i]) return false;
    better = better || a.objectives[i] < b.objectives[i];
  }
  return better;
}

std::vector<std::size_t> front_of(std::span<const Trial> trials) {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    bool kept = true;
    for (std::size_t k = 0; k < trials.size() && kept; ++k) {
      const bool same = trials[k].objectives == trials[i].objectives && trials[k].missed == trials[i].missed;
      kept = !dominates(trials[k], trials[i]) && !(same && k < i);
    }
    if (kept) front.push_back(i);
  }
  std::sort(front.begin(), front.end(),
            [&](std::size_t a, std::size_t b) { return trials[a].objectives < trials[b].objectives; });
  return front;
}

std::size_t balanced(std::span<const Trial> trials, std::span<const std::size_t> front) {
  const std::size_t objectives = trials[front.front()].objectives.size();
  std::vector<double> least(objectives, std::numeric_limits<double>::infinity()), most(objectives, 0.0);
  for (const std::size_t i : front) {
    for (std::size_t k = 0; k < objectives; ++k) {
      least[k] = std::min(least[k], trials[i].objectives[k]);
      most[k] = std::max(most[k], trials[i].objectives[k]);
    }
  }
  std::size_t best = front.front();
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::size_t i : front) {
    double squares = 0.0;
    for (std::size_t k = 0; k < objectives; ++k) {
      const double extent = most[k] - least[k];
      const double off = extent > 0.0 ? (trials[i].objectives[k] - least[k]) / extent : 0.0;
      squares += off * off;
    }
    if (squares < nearest) nearest = squares, best = i;
  }
  return best;
}

bool clearly_better(const Trial& a, const Trial& b, double share) {
  if (a.missed != b.missed) return a.missed < b.missed;
  bool better = false;
  for (std::size_t i = 0; i < a.objectives.size(); ++i) {
    const double size = std::max(std::abs(a.objectives[i]), std::abs(b.objectives[i]));
    const double gain = b.objectives[i] - a.objectives[i];
    if (gain < -share * size) return false;
    better = better || gain > share * size;
  }
  return better;
}

}  // namespace tangent::sweep
