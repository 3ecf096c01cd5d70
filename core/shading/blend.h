// A force and a display that never leap: what the finger's motion does not explain is faded in.
//
// A contact that switches to a deeper place, is found anew or comes back, and a preset that changes, would move force
// and display at once by as much as they differ. The finger feels a smooth surface only if such decisions are not felt:
// the force may change by kForceFade a second, and by what the finger's own motion explains, twice stiffness times its
// way. Until then the old plane fades into the new one; the old plane stays where it is, so that moving off it ends its
// force. What remains of the old plane is known from the last rendered force f alone: a plane across f, |f|/stiffness
// deep where the finger was then.
#pragma once

#include "core/shading/render.h"

namespace tangent {

/// What the last tick rendered: where the next one starts from.
struct RenderedState {
  Vec3 force_n{0.0};  ///< world
  double cld_m = 0.0;
  double force_rule = 0.0;       ///< a number that tells presets apart whose force has edges of its own; 0: smooth
  double display_rule = 0.0;     ///< likewise of the display
  Vec3 velocity{0.0};            ///< of the finger, filtered for damping, world, m/s
  double display_waits_s = 0.0;  ///< after a switch of contacts the display stays this much longer
  std::uint8_t has = 0;          ///< the above is set
  std::uint8_t changes = 0;      ///< begin_change's stricter fade is not over
  std::uint8_t force_fades = 0, display_fades = 0;  ///< a change of preset is still being faded in
  double change_s = 0.0;                            ///< since begin_change
  double stiffness_n_per_m = 0.0;                   ///< of the stiffest preset that is still in the force
};

/// The next tick runs under another preset, or on another scene: by whoever changes it, between two ticks. Until the
/// decided force is reached, the finger's motion then explains only what moving off the old plane does, and all else
/// goes at the fade's rate (kChangeFade), with force.blend off, too. Otherwise a finger that a stiffer preset pushes
/// out would itself explain more force: from 100 to 3,500 N/m, 2.7 mm deep, it left at 0.15 to 0.34 m/s.
void begin_change(RenderedState& state);

/// Of the finger since the last tick.
struct FingerWay {
  Vec3 moved{0.0};        ///< world, m
  double dt_s = 0.0;      ///< 0: none, or not known
  bool over_gap = false;  ///< moved in more than dt_s: ticks between had no pose
};

/// Most by which force and display may change in a tick: by what the finger's motion explains, and at the rate of a
/// fade.
double most_force_change_n(const Preset& preset, const FingerWay& way);
double most_display_change_m(const Preset& preset, const FingerWay& way);

/// Whether the display stays where it is while the contact is off the pad.
bool holds_off_pad(const Preset& preset);

/// What a tick is to render, from what it decided to and what the last one rendered; updates `state`. Where the
/// preset's force has edges of its own (facet, force shading, two-pass) only a change of preset fades, likewise its
/// display, and what begin_change said. The display holds where the contact is off the pad, and for kDisplayWait after
/// the contact `switched` to another place. An unconverged tick that ramps to zero is not held up, and the preset's
/// force limit holds at once.
Rendered blend(const Preset& preset, const FingerWay& way, const Rendered& decided, bool switched,
               RenderedState& state);

}  // namespace tangent
