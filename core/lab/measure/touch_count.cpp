#include "core/lab/measure/touch_count.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace tangent {
namespace {

std::string length_text(double m) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), m < 1.0 ? "%.4g mm" : "%.4g m", m < 1.0 ? m * 1e3 : m);
  return text.data();
}

}  // namespace

void TouchCount::add(const TickOutput& output) {
  ++ticks_;
  // `free` also says of a finger that began behind the surface that this does not push.
  if (output.status != TickStatus::free && output.penetration_m > 0.0) ++touched_;
  if (output.triangle != kNone && output.penetration_m <= 0.0) nearest_m_ = std::min(nearest_m_, -output.penetration_m);
}

std::string TouchCount::note() const {
  if (ticks_ == 0 || touched_ > 0) return {};
  const std::string count = std::to_string(ticks_);
  const std::string nothing = "the finger touched nothing in " + count + " of " + count + " ticks; ";
  if (!std::isfinite(nearest_m_))
    return nothing +
           "it was always behind the surface, which pushes only from outside: check whether the mesh is "
           "inside out (--turn-over), and where the poses begin";
  return nothing + "the nearest it came was " + length_text(nearest_m_) +
         ": check the units, metres of the poses and --unit of the mesh";
}

TouchCount count_until_touched(const std::shared_ptr<const ContactScene>& scene, const Preset& preset,
                               std::span<const TickInput> motion, const std::function<bool()>& stop) {
  constexpr std::uint64_t kAskedEvery = 512;
  Preset robust = preset;
  robust.solver.method = Method::robust;
  Stepper stepper(scene);
  TickState state;
  TouchCount count;
  for (const TickInput& input : motion) {
    if (stop && count.ticks() % kAskedEvery == 0 && stop()) break;
    count.add(stepper.step(robust, input, state));
    if (count.touched() > 0) break;
  }
  return count;
}

}  // namespace tangent
