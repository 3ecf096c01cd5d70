#include "workbench/experiment/order.h"

#include "core/base/split_mix.h"

#include <algorithm>
#include <charconv>

namespace tangent::experiment {
namespace {

/// The same for a participant wherever in a run they are.
SplitMix random_at(std::uint64_t seed, std::uint64_t a, std::uint64_t b) {
  return SplitMix(SplitMix(seed, a).next(), b);
}

}  // namespace

std::optional<std::uint64_t> participant_number(std::string_view participant) {
  std::size_t first = participant.size();
  while (first > 0 && participant[first - 1] >= '0' && participant[first - 1] <= '9') --first;
  std::uint64_t number = 0;
  const auto read = std::from_chars(participant.data() + first, participant.data() + participant.size(), number);
  if (first == participant.size() || read.ec != std::errc{}) return std::nullopt;
  return number;
}

std::vector<std::size_t> latin_row(std::size_t conditions, std::uint64_t participant) {
  const std::size_t rows = conditions % 2 == 0 ? conditions : 2 * conditions;
  const std::size_t row = participant % rows, shift = row % conditions;
  std::vector<std::size_t> out;
  // 0, 1, n-1, 2, n-2, ...: neighbours differ by every distance once
  for (std::size_t i = 0; i < conditions; ++i) {
    const std::size_t step = (i + 1) / 2;
    out.push_back((i % 2 == 1 ? step : conditions - step) % conditions);
  }
  for (std::size_t& at : out) at = (at + shift) % conditions;
  if (row >= conditions) std::reverse(out.begin(), out.end());
  return out;
}

bool reference_first(std::uint64_t seed, std::size_t condition, std::size_t trial) {
  return random_at(seed, condition + 1, trial + 1).below(2) == 0;
}

std::vector<ObjectTrial> object_trials(const Identification& design, std::uint64_t participant, std::uint64_t seed) {
  std::vector<ObjectTrial> out;
  const bool begins_tactile = (participant % 2 == 0) == design.tactile_first_even;
  const auto both_ways = [&](std::size_t object) {
    const auto& names = design.both_ways;
    return std::find(names.begin(), names.end(), design.objects[object]) != names.end();
  };
  for (int session = 0; session < design.sessions; ++session) {
    for (int block = 0; block < design.blocks; ++block) {
      const auto place = static_cast<std::uint64_t>(session * design.blocks + block);
      SplitMix of_block = random_at(seed, 1000 + place, 1);
      // Which way each object points in the first run of a pair; in the second it is the other.
      std::vector<std::array<bool, 2>> left(design.objects.size());
      for (int run = 0; run < design.runs; ++run) {
        if (run % 2 == 0)
          for (auto& ways : left) ways = {of_block.below(2) == 0, of_block.below(2) == 0};
        std::vector<ObjectTrial> trials;
        for (std::size_t object = 0; object < design.objects.size(); ++object) {
          for (const bool shaded : {false, true}) {
            const bool points_left = both_ways(object) && left[object][shaded ? 1 : 0] == (run % 2 == 0);
            const bool tactile = begins_tactile == (block < design.blocks / 2);
            trials.push_back(
                {session, block, run, object, shaded, tactile, points_left ? Facing::left : Facing::right});
          }
        }
        of_block.shuffle(std::span(trials));
        out.insert(out.end(), trials.begin(), trials.end());
      }
    }
  }
  return out;
}

}  // namespace tangent::experiment
