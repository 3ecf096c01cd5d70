// Did the finger touch anything at all: poses in another unit than the mesh pass it by without a sound.
#pragma once

#include "core/tick/step.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>

namespace tangent {

class TouchCount {
 public:
  void add(const TickOutput& output);  ///< of `robust`: planes of others that don't converge may lie anywhere
  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t touched() const { return touched_; }  ///< ticks in which the surface pushes
  double nearest_m() const { return nearest_m_; }     ///< of the ticks outside the surface; infinite: there was none
  /// Empty where something was touched, or there was no tick. Else how near the finger came, and which units to check.
  std::string note() const;

 private:
  std::uint64_t ticks_ = 0, touched_ = 0;
  double nearest_m_ = std::numeric_limits<double>::infinity();
};

/// Solves the motion by `robust`, whatever the preset's method, until the first touch: a motion that touches costs a
/// few ticks. `stop`, asked every few hundred ticks, ends it as well; the count then says nothing of the rest.
TouchCount count_until_touched(const std::shared_ptr<const ContactScene>& scene, const Preset& preset,
                               std::span<const TickInput> motion, const std::function<bool()>& stop = {});

}  // namespace tangent
