#include "workbench/gui/panels/attempts_text.h"

#include <vector>

namespace tangent {

std::string outcome_text(const TickOutput& output) {
  std::string text = to_string(output.status);
  if (output.event != TickEvent::none) text += std::string(", ") + to_string(output.event);
  if (output.searching) text += ", searching";
  return text;
}

std::string attempts_text(std::span<const IterationRecord> iterations, std::size_t lost, int planes, int limit) {
  constexpr std::size_t kMostListed = 6;
  int tracking = 0, sum = 0;
  std::vector<int> seeds;
  for (std::size_t i = 0; i < iterations.size(); ++i) {
    const std::uint8_t seed = iterations[i].seed;
    if (seed == 0) {
      tracking += i > 0;  // the kept plane is not new
    } else {
      if (i == 0 || iterations[i - 1].seed != seed) seeds.push_back(0);
      ++seeds.back();
      ++sum;
    }
  }
  std::string text = "Tracking " + std::to_string(tracking);
  if (!seeds.empty() && seeds.size() <= kMostListed) {
    text += seeds.size() == 1 ? ", seed " : ", seeds ";
    for (std::size_t k = 0; k < seeds.size(); ++k) text += (k > 0 ? " + " : "") + std::to_string(seeds[k]);
  } else if (!seeds.empty()) {
    text += ", " + std::to_string(seeds.size()) + " seeds " + std::to_string(sum);
  }
  const int searched = planes - tracking - sum;
  if (searched > 0) text += (lost > 0 ? ", not shown " : ", searched ") + std::to_string(searched);
  return text + "; limit " + std::to_string(limit) + " per attempt";
}

}  // namespace tangent
