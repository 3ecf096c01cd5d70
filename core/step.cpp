#include "core/step.h"

#include "core/contact/track.h"
#include "core/shading/facet.h"
#include "core/shading/force_law.h"

#include <algorithm>
#include <cmath>

namespace tangent {

class StepCache {
 public:
  explicit StepCache(const ContactMesh& mesh) : patches(mesh) {}

  /// Whether `smooth` still holds the sample of this kept plane: a face at the same place, bit for bit.
  bool holds(const TrackedPlane& kept, NormalForm kept_form) const {
    const TrackedPlane& mine = smooth.contact.plane;
    return kept.feature == Feature::face && mine.feature == Feature::face && kept.triangle == mine.triangle && kept.u == mine.u &&
           kept.v == mine.v && kept_form == form;
  }

  PatchCache patches;
  TrackResult smooth;  ///< of the last tick
  NormalForm form = NormalForm::bernstein;
};

namespace {

/// What a source offers to force and display: a plane in the world and how deep the finger is in it.
struct RenderPlane {
  Vec3 normal{0.0, 0.0, 1.0};
  double penetration_m = 0.0;
  double share = 1.0;  ///< 1; less while an unconverged tick ramps out; 0: nothing to render
};

/// Contacts of one tick: those that the method, the force source and the tactile source ask for.
struct TickContacts {
  RenderPlane smooth_plane, facet_plane, shaded_plane;
};

bool is_smooth(Method m) { return m == Method::paper || m == Method::newton || m == Method::robust; }

double unconverged_share(const SafetySettings& safety, double since_s) {
  if (since_s <= safety.unconverged_hold_s) return 1.0;
  if (safety.unconverged_ramp_s <= 0.0) return 0.0;
  return std::clamp(1.0 - (since_s - safety.unconverged_hold_s) / safety.unconverged_ramp_s, 0.0, 1.0);
}

TickStatus status_of(Feature feature, double penetration_m) {
  if (penetration_m < 0.0) return TickStatus::free;
  switch (feature) {
    case Feature::edge: return TickStatus::edge;
    case Feature::vertex: return TickStatus::vertex;
    default: return TickStatus::face;
  }
}

const RenderPlane& force_plane(const Preset& preset, const TickContacts& contacts) {
  switch (preset.force.source) {
    case ForceSource::facet: return contacts.facet_plane;
    case ForceSource::force_shading: return contacts.shaded_plane;
    case ForceSource::smooth: return contacts.smooth_plane;
    case ForceSource::method: break;
  }
  switch (preset.solver.method) {
    case Method::facet: return contacts.facet_plane;
    case Method::force_shading: return contacts.shaded_plane;
    default: return contacts.smooth_plane;
  }
}

const RenderPlane* tactile_plane(const Preset& preset, const TickContacts& contacts) {
  switch (preset.display.source) {
    case TactileSource::held: return nullptr;
    case TactileSource::facet: return &contacts.facet_plane;
    case TactileSource::smooth: return &contacts.smooth_plane;
    case TactileSource::method: break;
  }
  return is_smooth(preset.solver.method) ? &contacts.smooth_plane : &contacts.facet_plane;
}

/// The plane that an unconverged tick renders: the last converged one at the present pose, ramping to zero.
RenderPlane last_converged_plane(const Preset& preset, const TickState& state, const FingerPose& local, double t_s) {
  RenderPlane plane;
  if (state.last_converged.feature == Feature::none) {
    plane.share = 0.0;
    return plane;
  }
  plane.normal = state.last_converged.normal;
  plane.penetration_m = contact_on_plane(preset.finger, local, state.last_converged.point, plane.normal).penetration_m;
  plane.share = unconverged_share(preset.safety, t_s - state.last_converged_s);
  return plane;
}

void describe_smooth(const TrackResult& r, const Vec3& origin, TickOutput& out) {
  const IterationResult& c = r.contact;
  out.status = r.converged() ? status_of(c.plane.feature, c.contact.penetration_m) : TickStatus::unconverged;
  out.triangle = c.plane.triangle;
  out.u = c.plane.u;
  out.v = c.plane.v;
  out.contact = origin + c.plane.point;
  out.normal = c.plane.normal;
  out.penetration_m = c.contact.penetration_m;
  out.error_m = c.contact.error_m;
  out.event = r.event;
  out.iterations = r.evaluations;
  out.triangle_changes = r.triangle_changes;
}

void describe_facet(const FacetContact& facet, const RenderPlane& plane, const Vec3& origin, TickOutput& out) {
  if (!facet.found) return;
  out.status = status_of(facet.feature, plane.penetration_m);
  out.triangle = facet.hit.triangle;
  out.u = facet.hit.u;
  out.v = facet.hit.v;
  out.contact = origin + facet.hit.point;
  out.normal = plane.normal;
  out.penetration_m = plane.penetration_m;
}

void render(const Preset& preset, const TickContacts& contacts, const FingerPose& pose, const Vec3& velocity, TickOutput& out) {
  const RenderPlane& force = force_plane(preset, contacts);
  if (force.share > 0.0) out.force_n = force.share * contact_force(preset.force, force.normal, force.penetration_m, velocity);
  const RenderPlane* tactile = tactile_plane(preset, contacts);
  if (tactile && tactile->share > 0.0)
    out.cld_m = tactile->share * display_position(preset.display, preset.finger, pose, tactile->normal);
}

}  // namespace

Result<std::shared_ptr<const ContactScene>> ContactScene::build(ContactMesh mesh) {
  std::shared_ptr<ContactScene> scene(new ContactScene(std::move(mesh)));
  auto nearest = NearestTriangles::build(scene->mesh_);
  if (!nearest) return tl::unexpected(nearest.error());
  scene->nearest_ = std::make_unique<NearestTriangles>(std::move(*nearest));
  scene->hierarchy_ = ContactHierarchy::build(scene->mesh_);
  return scene;
}

std::size_t ContactScene::memory_bytes() const {
  return mesh_.memory_bytes() + nearest_->memory_bytes() + hierarchy_.memory_bytes();
}

Stepper::Stepper(std::shared_ptr<const ContactScene> scene)
    : scene_(std::move(scene)), cache_(std::make_unique<StepCache>(scene_->mesh())) {}
Stepper::Stepper(Stepper&&) noexcept = default;
Stepper& Stepper::operator=(Stepper&&) noexcept = default;
Stepper::~Stepper() = default;

/// Solves for the smooth contact and updates what the next tick keeps.
static RenderPlane track_smooth(const ContactScene& scene, StepCache& cache, const Preset& preset, const SolverSettings& settings,
                                const FingerPose& local, double t_s, TickState& state, IterationTrace* trace) {
  IterationContext context{cache.patches, settings, preset.finger, local, scene.mesh().origin(), trace, 0};
  track(context, scene, state, cache.holds(state.plane, settings.normal_form), cache.smooth);
  cache.form = settings.normal_form;
  const IterationResult& contact = cache.smooth.contact;
  state.plane = contact.plane;
  state.clearance = cache.smooth.clearance;
  if (!cache.smooth.converged()) return last_converged_plane(preset, state, local, t_s);
  state.last_converged = contact.plane;
  state.last_converged_s = t_s;
  return {contact.plane.normal, contact.contact.penetration_m, 1.0};
}

/// The raw mesh's contact, as facet and with interpolated normals.
static FacetContact find_facet(const ContactScene& scene, const Preset& preset, const FingerPose& local, TickContacts& contacts) {
  const FacetContact facet = facet_contact(scene.mesh(), scene.nearest(), local.position, preset.solver.tolerance_m);
  if (!facet.found) return facet;
  const double depth = contact_on_plane(preset.finger, local, facet.hit.point, facet.normal).penetration_m;
  contacts.facet_plane = {facet.normal, depth, 1.0};
  contacts.shaded_plane = {force_shading_normal(scene.mesh(), facet), depth, 1.0};
  return facet;
}

TickOutput Stepper::step(const Preset& preset, const TickInput& input, TickState& state, IterationTrace* trace) {
  TickOutput out;
  const ContactMesh& mesh = scene_->mesh();
  TickContacts contacts;
  if (!is_finite(input.finger.position) || !std::isfinite(glm::dot(input.finger.orientation, input.finger.orientation))) {
    const FingerPose last{state.last_position, Quat(1.0, 0.0, 0.0, 0.0)};
    contacts.smooth_plane = last_converged_plane(preset, state, {last.position - mesh.origin(), last.orientation}, input.t_s);
    contacts.facet_plane = contacts.shaded_plane = contacts.smooth_plane;
    render(preset, contacts, last, Vec3(0.0), out);
    return out;
  }
  const FingerPose& pose = input.finger;
  const FingerPose local{pose.position - mesh.origin(), pose.orientation};

  const Method method = preset.solver.method;
  const bool facet_method = !is_smooth(method);
  const bool want_smooth = !facet_method || preset.force.source == ForceSource::smooth || preset.display.source == TactileSource::smooth;
  const bool want_facet = facet_method || preset.force.source == ForceSource::facet ||
                          preset.force.source == ForceSource::force_shading || preset.display.source == TactileSource::facet;
  if (want_smooth && !facet_method) {
    contacts.smooth_plane = track_smooth(*scene_, *cache_, preset, preset.solver, local, input.t_s, state, trace);
    describe_smooth(cache_->smooth, mesh.origin(), out);
  } else if (want_smooth) {
    SolverSettings robust = preset.solver;
    robust.method = Method::robust;
    contacts.smooth_plane = track_smooth(*scene_, *cache_, preset, robust, local, input.t_s, state, trace);
  }
  if (want_facet) {
    const FacetContact facet = find_facet(*scene_, preset, local, contacts);
    if (facet_method)
      describe_facet(facet, method == Method::force_shading ? contacts.shaded_plane : contacts.facet_plane, mesh.origin(), out);
  }
  const double dt = input.t_s - state.last_t_s;
  const Vec3 velocity = state.has_previous && dt > 0.0 ? (pose.position - state.last_position) / dt : Vec3(0.0);
  render(preset, contacts, pose, velocity, out);
  state.last_position = pose.position;
  state.last_t_s = input.t_s;
  state.has_previous = 1;
  return out;
}

const char* to_string(Feature feature) {
  switch (feature) {
    case Feature::face: return "face";
    case Feature::edge: return "edge";
    case Feature::vertex: return "vertex";
    case Feature::none: break;
  }
  return "none";
}

const char* to_string(TickStatus status) {
  switch (status) {
    case TickStatus::free: return "free";
    case TickStatus::face: return "face";
    case TickStatus::edge: return "edge";
    case TickStatus::vertex: return "vertex";
    case TickStatus::unconverged: break;
  }
  return "unconverged";
}

const char* to_string(TickEvent event) {
  switch (event) {
    case TickEvent::none: break;
    case TickEvent::first: return "first";
    case TickEvent::reseed: return "reseed";
    case TickEvent::switched: return "switch";
    case TickEvent::branch: return "branch";
  }
  return "none";
}

const char* to_string(Method method) {
  switch (method) {
    case Method::paper: return "paper";
    case Method::newton: return "newton";
    case Method::robust: break;
    case Method::facet: return "facet";
    case Method::force_shading: return "force-shading";
    case Method::two_pass: return "two-pass";
  }
  return "robust";
}

const char* to_string(StopReason reason) {
  switch (reason) {
    case StopReason::going_on: return "going_on";
    case StopReason::converged: return "converged";
    case StopReason::iteration_limit: return "iteration_limit";
    case StopReason::cycling: return "cycling";
    case StopReason::unstable: return "unstable";
    case StopReason::left_boundary: return "left_boundary";
    case StopReason::singular_patch: return "singular_patch";
    case StopReason::too_far: return "too_far";
    case StopReason::leapt: return "leapt";
  }
  return "going_on";
}

}  // namespace tangent
