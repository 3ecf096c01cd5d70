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

  /// The sample of `plane` if it is the one kept from the last tick.
  const PlaceSample* sample_of(const TrackedPlane& plane, NormalForm form) const {
    const bool same = plane.feature == Feature::face && plane_.feature == Feature::face && plane.triangle == plane_.triangle &&
                      plane.u == plane_.u && plane.v == plane_.v && form == form_;
    return same ? &sample_ : nullptr;
  }
  void keep(const TrackedPlane& plane, const PlaceSample& sample, NormalForm form) {
    plane_ = plane;
    sample_ = sample;
    form_ = form;
  }

  PatchCache patches;

 private:
  TrackedPlane plane_;
  PlaceSample sample_{};
  NormalForm form_ = NormalForm::bernstein;
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
  TrackResult smooth;
  FacetContact facet;
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

TickOutput Stepper::step(const Preset& preset, const TickInput& input, TickState& state, IterationTrace* trace) {
  TickOutput out;
  const ContactMesh& mesh = scene_->mesh();
  const bool usable = is_finite(input.finger.position) && std::isfinite(glm::dot(input.finger.orientation, input.finger.orientation));
  const FingerPose pose = usable ? input.finger : FingerPose{state.last_position, Quat(1.0, 0.0, 0.0, 0.0)};
  const FingerPose local{pose.position - mesh.origin(), pose.orientation};
  const double dt = input.t_s - state.last_t_s;
  const Vec3 velocity = state.has_previous && dt > 0.0 ? (pose.position - state.last_position) / dt : Vec3(0.0);

  const Method method = preset.solver.method;
  const bool facet_method = !is_smooth(method);
  const bool want_smooth = !facet_method || preset.force.source == ForceSource::smooth || preset.display.source == TactileSource::smooth;
  const bool want_facet = facet_method || preset.force.source == ForceSource::facet ||
                          preset.force.source == ForceSource::force_shading || preset.display.source == TactileSource::facet;
  TickContacts contacts;
  if (want_smooth && usable) {
    SolverSettings settings = preset.solver;
    if (facet_method) settings.method = Method::robust;
    IterationContext context{cache_->patches, settings, preset.finger, local, mesh.origin(), trace, 0};
    contacts.smooth = track(context, *scene_, state, cache_->sample_of(state.plane, settings.normal_form));
    const IterationResult& c = contacts.smooth.contact;
    state.plane = c.plane;
    state.clearance = contacts.smooth.clearance;
    cache_->keep(c.plane, c.sample, settings.normal_form);
    if (contacts.smooth.converged()) {
      state.last_converged = c.plane;
      state.last_converged_s = input.t_s;
    }
  }
  contacts.smooth_plane = contacts.smooth.converged()
                              ? RenderPlane{contacts.smooth.contact.plane.normal, contacts.smooth.contact.contact.penetration_m, 1.0}
                              : last_converged_plane(preset, state, local, input.t_s);
  if (want_facet && usable) {
    contacts.facet = facet_contact(mesh, scene_->nearest(), local.position, preset.solver.tolerance_m);
    if (contacts.facet.found) {
      const auto plane_with = [&](const Vec3& normal, double penetration) { return RenderPlane{normal, penetration, 1.0}; };
      const double depth = contact_on_plane(preset.finger, local, contacts.facet.hit.point, contacts.facet.normal).penetration_m;
      contacts.facet_plane = plane_with(contacts.facet.normal, depth);
      contacts.shaded_plane = plane_with(force_shading_normal(mesh, contacts.facet), depth);
    }
  }
  if (facet_method) {
    describe_facet(contacts.facet, method == Method::force_shading ? contacts.shaded_plane : contacts.facet_plane, mesh.origin(), out);
  } else if (usable) {
    describe_smooth(contacts.smooth, mesh.origin(), out);
  }
  render(preset, contacts, pose, velocity, out);
  if (usable) {
    state.last_position = pose.position;
    state.last_t_s = input.t_s;
    state.has_previous = 1;
  }
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
  }
  return "going_on";
}

}  // namespace tangent
