// How rough force and display are over a run of ticks: how much they change from tick to tick, and by how much more
// than the finger's motion explains. Before they are faded (what each tick decided) and after (what it rendered).
#pragma once

#include "core/tick/step.h"

#include <cstdint>

namespace tangent {

/// Of one signal, N or m.
struct SignalRoughness {
  double mean = 0.0;              ///< change from tick to tick
  double largest = 0.0;           ///< of what changes went over their bound (shading/blend.h); 0: none did
  std::uint64_t unexplained = 0;  ///< ticks over it

  void add(double change, double most, std::uint64_t pairs);
};

struct Roughness {
  SignalRoughness force, decided_force;      ///< N
  SignalRoughness display, decided_display;  ///< m
  std::uint64_t pairs = 0;                   ///< ticks that had one before them
};

/// Gathers it tick by tick.
class RoughnessCounter {
 public:
  void add(const Preset& preset, const TickInput& input, const TickOutput& output);
  const Roughness& result() const { return sum_; }

 private:
  Roughness sum_;
  TickInput input_;
  TickOutput output_;
  bool any_ = false;
};

}  // namespace tangent
