// A tick under study: solved again with a trace, what its iteration met, and what is found out about it.
#pragma once

#include "core/base/angle.h"
#include "core/base/tolerances.h"
#include "core/base/units.h"
#include "core/lab/explain/tick_trials.h"
#include "core/tick/planar_contacts.h"

#include <memory>
#include <span>

namespace tangent {

/// What the solver takes for a jump of the normal (kJumpCosine).
inline constexpr double kJumpDeg = 10.0;

class TickStudy {
 public:
  TickStudy(std::shared_ptr<const ContactScene> scene, const GivenTick& given);

  const Preset& preset() const { return trials.preset; }
  const TickState& before() const { return trials.before; }
  const TickOutput& tick() const { return result.tick; }
  const ContactMesh& mesh() const { return trials.mesh(); }  ///< precondition: a 3D scene

  /// The run ended with a contact.
  bool followed() const { return !run.empty() && run.back().stop == StopReason::converged; }
  bool is_astray() const { return near.size() < run.size(); }
  /// Null: a mesh.
  const PlanarCurve* planar() const { return trials.scene().planar(); }
  /// Of the finger where it is, with a plane, world frame.
  PlaneContact contact_of(const Vec3& point, const Vec3& normal) const {
    if (planar())
      return contact_on_plane(section_finger(preset().finger), section_pose(trials.input.finger), point, normal);
    return contact_on_plane(preset().finger, trials.input.finger, point, normal);
  }
  void place_at(std::uint32_t triangle, std::uint32_t side, const Vec3& place) {
    result.mesh.triangle = triangle;
    result.mesh.side = side;
    result.mesh.place = place;
    result.mesh.planar = planar() != nullptr;
  }

  TickTrials trials;
  std::unique_ptr<IterationTrace> trace;
  std::span<const IterationRecord> run;   ///< following the kept plane, or the first seed
  std::span<const IterationRecord> near;  ///< of it, what came before it went astray
  TickExplanation result;
};

/// The contact there, on a face, is stable.
inline bool is_stable(const IterationRecord& r) {
  return r.feature != Feature::face || (r.det_m > 0.0 && r.trace_m > 0.0);
}

}  // namespace tangent
