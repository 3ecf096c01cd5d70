// What goes into one haptic tick, what comes out, and what one tick hands to the next: plain data.
#pragma once

#include "core/contact/clearance.h"
#include "core/contact/decide/tick_event.h"
#include "core/contact/touched.h"
#include "core/contact/tracked_plane.h"
#include "core/finger/finger.h"
#include "core/shading/blend.h"

#include <array>
#include <cstdint>
#include <optional>

namespace tangent {

enum class TickStatus : std::uint8_t {
  free,  ///< not touching: out of reach of the surface, or behind a place that was never entered from outside
  face,
  edge,
  vertex,
  unconverged,
  facing,  ///< the surface offers no contact here: the nearest place, its plane turned to face the finger
  busy,    ///< no tick was computed: another thread is in this stepper (step.h)
};
/// Those that a tick can have.
inline constexpr std::array kTickStatuses{TickStatus::free,   TickStatus::face,        TickStatus::edge,
                                          TickStatus::vertex, TickStatus::unconverged, TickStatus::facing};
const char* to_string(TickStatus status);
/// Whether the tick found a contact with the surface, or that there is none in reach. Otherwise force and display come
/// from the last tick that did, and fade.
inline bool is_converged(TickStatus status) {
  return status != TickStatus::facing && status != TickStatus::unconverged && status != TickStatus::busy;
}
/// Of a converged contact: `free` where the finger does not reach the surface.
TickStatus status_of(Feature feature, double penetration_m);

/// What is rendered on while no contact is found.
struct ConvergedPlane {
  Vec3 point{0.0};  ///< local, m
  Vec3 normal{0.0, 0.0, 1.0};
};

/// What a first search, that of a first tick or of one after a leap, has come to. All that the finger is in then counts
/// as entered, however deep.
enum class Start : std::uint8_t {
  found,      ///< the contact to follow
  searching,  ///< it goes on: what comes up deeper is still where the finger starts
  in_vain,    ///< there is no contact where the finger is
};

/// TickState::has_previous where the ticks since last_position had no usable pose: last_t_s is the time of the last.
inline constexpr std::uint8_t kPoseIsOlder = 2;

/// Everything one tick hands to the next. Trivially copyable.
struct TickState {
  TrackedPlane plane;             ///< feature none: nothing tracked yet
  ConvergedPlane last_converged;  ///< of the last converged tick, if has_converged
  double last_converged_s = 0.0;  ///< its time
  Vec3 last_position{0.0};        ///< finger position of the previous tick, world, m
  Quat last_orientation{1.0, 0.0, 0.0, 0.0};
  double last_t_s = 0.0;
  std::uint8_t has_previous = 0;   ///< last_position, last_orientation and last_t_s are set; kPoseIsOlder
  std::uint8_t has_converged = 0;  ///< there was a converged tick
  std::uint8_t has_proxy = 0;      ///< proxy is set
  std::uint8_t unentered = 0;      ///< the tracked place was found from behind: it does not push until it is left
  Start start = Start::found;
  float late_m = 0.0f;  ///< the finger's way while a search for deeper places was not done, so late one may be found
  /// Half of how much deeper a contact that was lost was than what is gone on with, and the way since: it may come up
  /// again. 0: none was, or too far from here.
  float lost_m = 0.0f;
  Clearance clearance;
  Vec3 proxy{0.0};        ///< of the two-pass method, local, m
  TouchedPlaces touched;  ///< beside `plane`, where the force comes from all of them
  RenderedState rendered;
};

/// The next tick runs on another scene, with the finger where it is: what the last one rendered is faded out of.
inline void forget_scene(TickState& state) {
  TickState fresh;
  fresh.rendered = state.rendered;
  fresh.last_position = state.last_position;
  fresh.last_orientation = state.last_orientation;
  fresh.last_t_s = state.last_t_s;
  fresh.has_previous = state.has_previous;
  begin_change(fresh.rendered);
  state = fresh;
}

struct TickInput {
  double t_s = 0.0;
  FingerPose finger;
  std::optional<Vec3> velocity = std::nullopt;  ///< of the finger, world, m/s, by the device; none: from its positions
  /// What a search would read is not built yet and this tick does not wait for it: nothing is searched, force and
  /// display come from the last converged tick and fade (`unconverged`).
  bool unready = false;
  /// A first search is done in this tick, however long it takes: of a pose that no tick follows, and nobody waits for.
  bool all_at_once = false;
};

/// One row of ticks.csv. World frame, SI.
struct TickOutput {
  TickStatus status = TickStatus::unconverged;
  TickEvent event = TickEvent::none;
  std::uint32_t triangle = kNone;
  double u = 0.0, v = 0.0;
  Vec3 contact{0.0};
  Vec3 normal{0.0, 0.0, 1.0};
  double penetration_m = 0.0;
  Vec3 force_n{0.0};
  double cld_m = 0.0;
  double error_m = 0.0;         ///< `facing`: how far that place is from being a contact
  std::int32_t iterations = 0;  ///< surface evaluations of this tick, seeds included
  std::int32_t triangle_changes = 0;
  Vec3 decided_force_n{0.0};  ///< force and display before they were blended with those of the last tick
  double decided_cld_m = 0.0;
  Vec3 way_out_m{0.0};  ///< of several places at once, which the force comes from (shading/way_out.h); 0: of the one
  /// The search for deeper places has taken more than a tick's work and goes on at the next: there may be one.
  bool searching = false;
};

/// What crosses the rings from the servo to its watchers: enough to compute the tick again.
struct TickRecord {
  std::uint64_t tick = 0;
  std::uint32_t preset_id = 0;
  TickState kept;  ///< the state before the tick
  TickInput input;
  TickOutput output;
  double solve_ns = 0.0;
};

}  // namespace tangent
