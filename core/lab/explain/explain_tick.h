// Why a tick did what it did, from a closed list of causes. Pure: a tick depends on its scene, preset, input and the
// state before it alone, so it is solved again, and so are variations of it: with another value of one parameter, with
// a smaller finger, in smaller steps, on a mended copy of the mesh around it. A cause is named where such a variation,
// or what the iteration met on its way, proves it; else the answer is not_told.
#pragma once

#include "core/lab/explain/tick_cause.h"
#include "core/preset/schema.h"
#include "core/tick/step.h"

#include <memory>
#include <string>

namespace tangent {

struct ExplainOptions {
  int many_planes = 8;  ///< a tick of more planes wants explaining; 8: what `robust` spends on following a contact
};

/// What decided it: a number, and the threshold on whose wrong side it is.
struct DecidingNumber {
  const char* what = nullptr;  ///< "gain"; null: none
  const char* against = "";    ///< what the threshold is: "ideal gain in the direction of travel"
  const char* unit = "1";      ///< SI, "deg" or "1"
  double value = 0.0, threshold = 0.0;
  double margin() const { return value - threshold; }
};

enum class CureOutcome : std::uint8_t {
  not_sought,  ///< nothing to cure, or not by a parameter
  found,
  none_in_range,  ///< no value of a parameter that has to do with the cause cures it
};

/// The smallest change of one parameter after which the tick wants no explaining any more: solved again to prove it.
struct TickCure {
  CureOutcome outcome = CureOutcome::not_sought;
  const PresetKey* key = nullptr;  ///< of the changed parameter, where found
  double from = 0.0, to = 0.0;
  bool as_deep = false;  ///< finger.radius_m: the centre was moved along the normal, so that the finger is as deep
  TickOutput proof;      ///< of the tick with `to`
};

/// Where on the mesh the cause lies.
struct MeshPlace {
  std::uint32_t triangle = kNone;  ///< kNone: nowhere; of a 2D scene the vertex
  std::uint32_t side = 0;          ///< crease, boundary: the edge; wild normal: the corner
  Vec3 place{0.0};                 ///< world, m
  bool mended = false;             ///< a copy of the surroundings without the defect cured the tick; unready: built
  TickOutput proof;                ///< there; triangle numbers are the copy's, but for unready
  bool planar = false;             ///< of a 2D scene
};

struct TickExplanation {
  TickCause cause = TickCause::not_told;
  TickOutput tick;  ///< as it was, solved again
  DecidingNumber decided;
  TickCure cure;
  MeshPlace mesh;
  bool untouched = false;  ///< unstable_ground: the finger does not reach the surface
  int solves = 0;          ///< ticks solved to find out
  /// Of a tick that followed others without a contact (explain_run.h): how many there were before it. Cause, number and
  /// place are then those of the first, and the cure is solved again from there on. 0: all is of the tick itself.
  std::uint64_t lost_before = 0;
};

/// Whether an output by itself wants explaining: not converged, any event, more planes than `options` allows. What
/// turns the normal of a raw mesh's contact is seen by explain_tick alone.
bool wants_explaining(const TickOutput& tick, const ExplainOptions& options = {});

/// Whether the contact went over to a triangle with another normal: of a raw mesh's contact that wants explaining, too.
bool normal_jumped(const TickOutput& last, const TickOutput& tick);

/// `before`: the state that the tick was given. Deterministic. Precondition: preset within its ranges.
TickExplanation explain_tick(const std::shared_ptr<const ContactScene>& scene, const Preset& preset,
                             const TickInput& input, const TickState& before, const ExplainOptions& options = {});

/// What the cause's sentence is for this tick, without a full stop.
const char* sentence_of(const TickExplanation& explanation);

/// Some sentences for a person: the cause, what decided it, the cure, the defect to mend. No line end.
std::string explanation_text(const TickExplanation& explanation);

}  // namespace tangent
