// What one tick hands to the next, as bytes in a recording. Field by field: the same from every compiler.
#pragma once

#include "core/base/result.h"
#include "core/tick/scene.h"
#include "core/tick/tick.h"
#include "workbench/session/servo_record.h"

#include <span>
#include <vector>

namespace tangent {

/// Changes with the fields of TickState; states of another layout can't be used, and ticks are then computed from the
/// first one on.
inline constexpr int kStateLayout = 4;

std::vector<unsigned char> state_bytes(const TickState& state);
/// Fails on bytes that no tick on this scene can have left: a wrong length, an unknown feature, a triangle that it does
/// not have.
Result<TickState> state_from(std::span<const unsigned char> bytes, const ContactScene& scene);

/// Whether something else than the last tick had a hand in it: another preset, or a scene under the finger that is to
/// be looked at anew. `before`: the record of the tick before; null: none.
bool state_was_touched(const ServoRecord& now, const ServoRecord* before);

}  // namespace tangent
