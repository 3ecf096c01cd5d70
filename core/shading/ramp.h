// Where a contact was lost while a decision still faded: what was rendered last ramps to zero.
#pragma once

#include "core/shading/blend.h"

namespace tangent {

/// An unconverged tick ramps to zero and nothing holds it up, but what was still fading when the ramp began is not
/// leapt to: then what was rendered `last` ramps on, in `decided`. As in a fade moving off its plane ends its force,
/// and the preset's limit holds at once. `share`: of the ramp that is left; a ramp that is over, as after `facing`
/// ticks, is zero at once. `display_ramps`: no plane of its own keeps the display.
void ramp_what_was_rendered(const Preset& preset, const FingerWay& way, double share, bool display_ramps,
                            const RenderedState& last, Rendered& decided);

}  // namespace tangent
