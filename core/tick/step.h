// One haptic tick: (scene, preset, input, state) -> output. The servo, replay, sweeps, the command line and
// the tests all call this and nothing else. Pure: no clock, thread, file, allocation or exception.
// The same arguments give the same bits, traced or not.
#pragma once

#include "core/contact/contact_hierarchy.h"
#include "core/contact/nearest_triangles.h"
#include "core/mesh/contact_mesh.h"
#include "core/planar/curve.h"
#include "core/preset/preset.h"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>

namespace tangent {

/// What a tick needs besides its preset: mesh and query structures. Immutable; share it freely.
class ContactScene {
 public:
  static Result<std::shared_ptr<const ContactScene>> build(ContactMesh mesh);
  /// A 2D scene. Its mesh is a ribbon along the polygon, for views; contacts are the curve's (planar/planar_step.h).
  static Result<std::shared_ptr<const ContactScene>> build(PlanarCurve curve);
  const PlanarCurve* planar() const { return planar_.get(); }  ///< null: a 3D scene
  const ContactMesh& mesh() const { return mesh_; }
  const NearestTriangles& nearest() const { return *nearest_; }
  const ContactHierarchy& hierarchy() const { return hierarchy_; }
  std::size_t memory_bytes() const;

 private:
  explicit ContactScene(ContactMesh mesh) : mesh_(std::move(mesh)) {}
  static Result<std::shared_ptr<const ContactScene>> with_queries(std::shared_ptr<ContactScene> scene);
  ContactMesh mesh_;
  std::unique_ptr<NearestTriangles> nearest_;
  ContactHierarchy hierarchy_;
  std::unique_ptr<const PlanarCurve> planar_;
};

enum class Feature : std::uint8_t { none, face, edge, vertex };
enum class TickStatus : std::uint8_t { free, face, edge, vertex, unconverged };
enum class TickEvent : std::uint8_t { none, first, reseed, switched, branch };
const char* to_string(Feature feature);
const char* to_string(TickStatus status);
const char* to_string(TickEvent event);  ///< "switch" for switched
const char* to_string(Method method);    ///< "force-shading", "two-pass"

/// A place on the smooth surface. u and v are the barycentric weights on `triangle` (for an edge or vertex they lie on
/// that edge or corner).
struct SurfacePlace {
  Feature feature = Feature::none;
  std::uint8_t side = 0;  ///< edge: which edge of the triangle; vertex: which corner
  std::uint32_t triangle = kNone;
  double u = 0.0, v = 0.0;
};

/// Where the tangent plane touches the smooth surface. The normal belongs to the place for faces; on edges and vertices
/// it turns within the fan.
struct TrackedPlane : SurfacePlace {
  Vec3 point{0.0};             ///< S, local mesh coordinates, m
  Vec3 normal{0.0, 0.0, 1.0};  ///< N, unit
  Vec2 turn{1.0, 0.0};         ///< edge: direction of N about the edge (contact/edge_fan.h); else unused

  /// Point and normal there are still to be computed.
  void move_to(const SurfacePlace& place) { static_cast<SurfacePlace&>(*this) = place; }
};

/// A triangle that holds no deeper contact, but could before others do.
struct WatchedTriangle {
  std::uint32_t triangle = kNone;
  float margin_m = 0.0f;  ///< how far from Clearance::centre the finger may go before it must be looked at again
  bool operator==(const WatchedTriangle&) const = default;
};

/// Where no other place can be deeper than the tracked one: in a ball about the place where that was found out last.
/// Within it nothing is asked, however long the finger moves there. All distances are the finger's from `centre` and
/// `orientation` (contact/rivals.h: gone_m).
struct Clearance {
  static constexpr std::size_t kWatched = 8;
  Vec3 centre{0.0};  ///< local
  Quat orientation{1.0, 0.0, 0.0, 0.0};
  double free_m = -1.0;  ///< radius of the ball: up to here nothing needs to be looked at; negative: not known
  double margin_m =
      -1.0;               ///< up to here no triangle outside the tracked basin and the watched ones holds a contact ...
  double height_m = 0.0;  ///< ... of a rank below this less the distance gone
  std::array<WatchedTriangle, kWatched> watched;

  /// No other place counts as deeper, however far the finger goes: the contact is only followed.
  static Clearance unlimited() {
    Clearance c;
    c.free_m = c.margin_m = c.height_m = std::numeric_limits<double>::infinity();
    return c;
  }
};

/// What is rendered on while no contact is found.
struct ConvergedPlane {
  Vec3 point{0.0};  ///< local, m
  Vec3 normal{0.0, 0.0, 1.0};
};

/// Everything one tick hands to the next. Trivially copyable.
struct TickState {
  TrackedPlane plane;             ///< feature none: nothing tracked yet
  ConvergedPlane last_converged;  ///< of the last converged tick, if has_converged
  double last_converged_s = 0.0;  ///< its time
  Vec3 last_position{0.0};        ///< finger position of the previous tick, world, m
  double last_t_s = 0.0;
  std::uint8_t has_previous = 0;   ///< last_position and last_t_s are set
  std::uint8_t has_converged = 0;  ///< there was a converged tick
  Clearance clearance;
  Vec3 proxy{0.0};  ///< of the two-pass method, local, m
  std::uint8_t has_proxy = 0;
};

struct TickInput {
  double t_s = 0.0;
  FingerPose finger;
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
  double error_m = 0.0;
  std::int32_t iterations = 0;  ///< surface evaluations of this tick, seeds included
  std::int32_t triangle_changes = 0;
};

enum class StopReason : std::uint8_t {
  going_on,   ///< not the last iteration
  converged,  ///< error below tolerance
  iteration_limit,
  cycling,         ///< came back to a place it had been, or the error stopped falling
  unstable,        ///< the solution it runs to has det M <= 0 or trace M <= 0
  left_boundary,   ///< ran out through a mesh boundary
  singular_patch,  ///< no step can be computed there
  too_far,         ///< the finger is out of reach of the tracked place: the walk to it got lost
  leapt,           ///< converged, but on another place: the normal turned by over 10 degrees in one tick
};
const char* to_string(StopReason reason);

/// One tangent plane of a tick, as computed; the kept plane is iteration 0. World frame, SI.
struct IterationRecord {
  Feature feature = Feature::none;
  StopReason stop = StopReason::going_on;
  std::uint8_t seed = 0;  ///< 0: tracking; n: the n-th seed of a re-seeding
  std::uint32_t triangle = kNone;
  double u = 0.0, v = 0.0;
  Vec3 point{0.0};                    ///< S: where the plane touches the surface
  Vec3 normal{0.0};                   ///< N of the plane
  Vec3 contact{0.0};                  ///< the finger's own contact point, projected on the plane
  Vec3 travel{0.0};                   ///< contact - S
  double error_m = 0.0;               ///< |travel|
  double gain = 0.0;                  ///< Eq. 1; 0 where no step was taken
  double curvature_per_m = 0.0;       ///< |dN/ds| along the step (Eq. 2)
  double distance_m = 0.0;            ///< d of Eq. 1
  double step_m = 0.0;                ///< length of the step on the base triangle
  double det_m = 0.0, trace_m = 0.0;  ///< of M = B A^-1
};

/// Fixed room for a tick's iterations; what doesn't fit is counted.
struct IterationTrace {
  static constexpr std::size_t kCapacity = 1024;
  std::array<IterationRecord, kCapacity> records;
  std::size_t size = 0;
  std::size_t lost = 0;
  void clear() { size = lost = 0; }
  void push(const IterationRecord& r) {
    if (size < kCapacity)
      records[size++] = r;
    else
      ++lost;
  }
  void amend_last(StopReason stop) {
    if (size > 0 && lost == 0) records[size - 1].stop = stop;
  }
  std::span<const IterationRecord> view() const { return {records.data(), size}; }
};

/// Patches and samples that a stepper keeps between ticks; they can always be computed again from the
/// state, so a fresh one gives the same bits, later.
class StepCache;

/// Owns a StepCache for one scene. Not thread-safe; use one per thread.
class Stepper {
 public:
  explicit Stepper(std::shared_ptr<const ContactScene> scene);
  Stepper(Stepper&&) noexcept;
  Stepper& operator=(Stepper&&) noexcept;
  ~Stepper();

  const ContactScene& scene() const { return *scene_; }
  /// Precondition: preset within its ranges. A pose that is not finite gives `unconverged`.
  TickOutput step(const Preset& preset, const TickInput& input, TickState& state, IterationTrace* trace = nullptr);

 private:
  std::shared_ptr<const ContactScene> scene_;
  std::unique_ptr<StepCache> cache_;
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
