#include "core/lab/gains/ground.h"

#include "core/surface/mesh_patch.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tangent {

const char* to_string(Ground ground) {
  switch (ground) {
    case Ground::flat:
      return "flat";
    case Ground::gentle:
      return "gentle";
    case Ground::tight:
      return "tight";
    case Ground::sharp:
      break;
  }
  return "sharp";
}

Ground ground_of(const ContactMesh& mesh, const Preset& preset, const TickOutput& output) {
  if (output.status == TickStatus::edge || output.status == TickStatus::vertex) return Ground::sharp;
  const PnPatch patch = make_patch(mesh, output.triangle, preset.solver.normal_form);
  const PrincipalCurvatures k =
      principal_curvatures(evaluate(patch, output.u, output.v), evaluate_second(patch, output.u, output.v));
  const double turn = preset.finger.reach_m() * std::max(std::abs(k.k1), std::abs(k.k2));
  return turn < kFlatBelow ? Ground::flat : turn < kTightFrom ? Ground::gentle : Ground::tight;
}

double GroundCounts::share(Ground ground) const {
  const auto all = std::accumulate(ticks.begin(), ticks.end(), std::uint64_t{0});
  return all == 0 ? 0.0 : static_cast<double>(ticks[static_cast<std::size_t>(ground)]) / static_cast<double>(all);
}

double GroundCounts::mean_iterations(Ground ground) const {
  const auto at = static_cast<std::size_t>(ground);
  return ticks[at] == 0 ? 0.0 : static_cast<double>(iterations[at]) / static_cast<double>(ticks[at]);
}

}  // namespace tangent
