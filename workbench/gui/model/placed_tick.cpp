#include "workbench/gui/model/placed_tick.h"

#include <utility>

namespace tangent {

std::optional<PlacedTick> PlacedTick::at(const std::shared_ptr<const ContactScene>& scene, const Preset& preset,
                                         std::uint32_t triangle, double u, double v, const MoveOptions& options) {
  if (scene == nullptr || scene->planar() != nullptr || triangle >= scene->mesh().triangle_count() ||
      !scene->mesh().usable(triangle))
    return std::nullopt;
  PlacedTick out(scene, preset);
  out.triangle_ = triangle;
  out.u_ = u;
  out.v_ = v;
  out.moves_ = solve_moves(out.stepper_, preset, triangle, u, v, options);
  if (out.moves_.empty()) return std::nullopt;
  out.chosen_ = out.worst();
  return out;
}

ServoRecord PlacedTick::record(std::uint64_t tick, std::uint32_t preset_id, std::uint32_t scene_id) const {
  const PlaceMove& move = moves_[chosen_];
  ServoRecord record;
  record.tick.tick = tick;
  record.tick.preset_id = preset_id;
  record.tick.kept = move.kept;
  record.tick.input = move.input;
  record.tick.output = move.output;
  record.scene_id = scene_id;
  return record;
}

TickOutput PlacedTick::solve(const Preset& preset, IterationTrace& trace) {
  const PlaceMove& move = moves_[chosen_];
  trace.clear();
  TickState state = move.kept;
  return stepper_.step(preset, move.input, state, &trace);
}

}  // namespace tangent
