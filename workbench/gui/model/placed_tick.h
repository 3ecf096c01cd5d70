// A tick at a chosen place of the mesh: the finger rests there and moves by one tick's travel in a direction
// (core/lab/measure/place_moves.h). For looking at planes where no finger has been.
#pragma once

#include "core/lab/measure/place_moves.h"
#include "workbench/session/servo_record.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace tangent {

class PlacedTick {
 public:
  /// The moves from there; the worst of them is chosen. Empty: the finger can't rest there, or the triangle is
  /// unusable.
  static std::optional<PlacedTick> at(const std::shared_ptr<const ContactScene>& scene, const Preset& preset,
                                      std::uint32_t triangle, double u, double v, const MoveOptions& options);

  const std::vector<PlaceMove>& moves() const { return moves_; }
  std::size_t chosen() const { return chosen_; }
  void choose(std::size_t move) { chosen_ = move < moves_.size() ? move : chosen_; }
  std::size_t worst() const { return worst_move(moves_); }

  const Preset& preset() const { return preset_; }  ///< under which the moves were solved
  const std::shared_ptr<const ContactScene>& scene() const { return stepper_.shared_scene(); }
  std::uint32_t triangle() const { return triangle_; }
  double u() const { return u_; }
  double v() const { return v_; }

  /// The chosen move as a record, as if the servo had run it.
  ServoRecord record(std::uint64_t tick, std::uint32_t preset_id, std::uint32_t scene_id) const;
  /// The chosen move under a preset, with its planes.
  TickOutput solve(const Preset& preset, IterationTrace& trace);

 private:
  PlacedTick(std::shared_ptr<const ContactScene> scene, const Preset& preset) : stepper_(scene), preset_(preset) {}
  Stepper stepper_;
  Preset preset_;
  std::uint32_t triangle_ = kNone;
  double u_ = 0.0, v_ = 0.0;
  std::vector<PlaceMove> moves_;
  std::size_t chosen_ = 0;
};

}  // namespace tangent
