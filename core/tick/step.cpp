#include "core/tick/step.h"

#include "core/tick/glide.h"
#include "core/tick/planar_step.h"
#include "core/tick/render.h"

#include <cmath>

namespace tangent {

namespace {

/// Finite, and so far from overflow that squares are: one number that isn't spoils the sum.
bool is_usable(const FingerPose& pose) {
  return std::isfinite(glm::dot(pose.position, pose.position) + glm::dot(pose.orientation, pose.orientation));
}

/// The plane that an unconverged tick renders: the last converged one at the present pose, ramping to zero.
RenderPlane last_converged_plane(const Preset& preset, const TickState& state, const FingerPose& local, double t_s) {
  RenderPlane plane;
  if (!state.has_converged) {
    plane.share = 0.0;
    return plane;
  }
  plane.normal = state.last_converged.normal;
  plane.penetration_m = contact_on_plane(preset.finger, local, state.last_converged.point, plane.normal).penetration_m;
  plane.share = unconverged_share(preset.safety, t_s - state.last_converged_s);
  return plane;
}

/// A tick but for force and display.
TickOutput describe_smooth(const TrackResult& r, const Vec3& origin) {
  const IterationResult& c = r.contact;
  return {.status = r.converged() ? status_of(c.plane.feature, c.contact.penetration_m) : TickStatus::unconverged,
          .event = r.event,
          .triangle = c.plane.triangle,
          .u = c.plane.u,
          .v = c.plane.v,
          .contact = origin + c.plane.point,
          .normal = c.plane.normal,
          .penetration_m = c.contact.penetration_m,
          .force_n = Vec3(0.0),
          .cld_m = 0.0,
          .error_m = c.contact.error_m,
          .iterations = r.evaluations,
          .triangle_changes = r.triangle_changes};
}

}  // namespace

Result<std::shared_ptr<const ContactScene>> ContactScene::build(ContactMesh mesh) {
  return with_queries(std::shared_ptr<ContactScene>(new ContactScene(std::move(mesh))));
}

Result<std::shared_ptr<const ContactScene>> ContactScene::build(PlanarCurve curve) {
  constexpr double kRibbonShare = 0.1;  // half its width, in sizes of the polygon
  ContactMeshOptions options;
  options.normals = NormalSource::file;
  auto mesh = ContactMesh::build(ribbon(curve, kRibbonShare * curve.size_m()), options);
  if (!mesh) return tl::unexpected(mesh.error());
  std::shared_ptr<ContactScene> scene(new ContactScene(std::move(*mesh)));
  scene->planar_ = std::make_unique<const PlanarCurve>(std::move(curve));
  return with_queries(std::move(scene));
}

Result<std::shared_ptr<const ContactScene>> ContactScene::with_queries(std::shared_ptr<ContactScene> scene) {
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
static void track_smooth(const ContactScene& scene, StepCache& cache, const Preset& preset,
                         const SolverSettings& settings, const FingerPose& local, double t_s, TickState& state,
                         IterationTrace* trace, RenderPlane& plane) {
  IterationContext context{cache.patches, settings, preset.finger, local, scene.mesh().origin(), trace, 0};
  track(context, scene, state, cache.holds(state.plane, settings.normal_form), cache.smooth);
  cache.form = settings.normal_form;
  const IterationResult& contact = cache.smooth.contact;
  state.plane = contact.plane;
  if (!cache.smooth.converged()) {
    plane = last_converged_plane(preset, state, local, t_s);
    return;
  }
  state.last_converged = {contact.plane.point, contact.plane.normal};
  state.has_converged = 1;
  state.last_converged_s = t_s;
  plane.normal = contact.plane.normal;
  plane.penetration_m = contact.contact.penetration_m;
}

/// The raw mesh's contact, as facet and with interpolated normals.
static FacetContact find_facet(const ContactScene& scene, const Preset& preset, const FingerPose& local,
                               TickContacts& contacts) {
  const FacetContact facet = facet_contact(scene.mesh(), scene.nearest(), local.position, preset.solver.tolerance_m);
  if (!facet.found) return facet;
  const double depth = contact_on_plane(preset.finger, local, facet.hit.point, facet.normal).penetration_m;
  contacts.facet_plane = {facet.normal, depth, 1.0};
  contacts.shaded_plane = {force_shading_normal(scene.mesh(), facet), depth, 1.0};
  return facet;
}

/// A tick of a pose that is not finite: what was rendered last, at the last position.
static TickOutput step_without_pose(const ContactScene& scene, const Preset& preset, double t_s,
                                    const TickState& state) {
  const FingerPose last{state.last_position, Quat(1.0, 0.0, 0.0, 0.0)};
  TickContacts contacts;
  contacts.smooth_plane =
      last_converged_plane(preset, state, {last.position - scene.mesh().origin(), last.orientation}, t_s);
  contacts.facet_plane = contacts.shaded_plane = contacts.proxy_force = contacts.proxy_place = contacts.smooth_plane;
  TickOutput out;
  render(preset, contacts, last, Vec3(0.0), out);
  return out;
}

/// A tick that asks for contacts on the raw mesh.
static TickOutput step_facets(const ContactScene& scene, StepCache& cache, const Preset& preset, const TickInput& input,
                              const FingerPose& local, TickState& state, IterationTrace* trace) {
  const ContactMesh& mesh = scene.mesh();
  const Method method = preset.solver.method;
  TickOutput out;
  TickContacts contacts;
  if (wants_smooth(preset)) {
    SolverSettings settings = preset.solver;
    if (!is_smooth(method)) settings.method = Method::robust;
    track_smooth(scene, cache, preset, settings, local, input.t_s, state, trace, contacts.smooth_plane);
    if (is_smooth(method)) out = describe_smooth(cache.smooth, mesh.origin());
  }
  if (wants_facet(preset)) {
    const FacetContact facet = find_facet(scene, preset, local, contacts);
    if (method == Method::facet) describe_facet(facet, contacts.facet_plane, mesh.origin(), out);
    if (method == Method::force_shading) describe_facet(facet, contacts.shaded_plane, mesh.origin(), out);
  }
  if (method == Method::two_pass) {
    constexpr double kLeapShare = 0.25;  // of the box's diagonal: a proxy further from the finger is given up
    const MeshProxySurface surface(mesh, scene.nearest(), preset.solver.tolerance_m);
    step_two_pass(surface, preset, local.position, mesh.origin(), kLeapShare * glm::length(mesh.bounds().size()), state,
                  contacts, out);
  }
  render(preset, contacts, input.finger, finger_velocity(preset, input.finger.position, input.t_s, state), out);
  keep_pose(input.finger.position, input.t_s, state);
  return out;
}

/// A tick that asks for the smooth contact alone.
static TickOutput step_smooth(const ContactScene& scene, StepCache& cache, const Preset& preset, const TickInput& input,
                              const FingerPose& local, const FingerSection& section, TickState& state,
                              IterationTrace* trace) {
  RenderPlane plane;
  track_smooth(scene, cache, preset, preset.solver, local, input.t_s, state, trace, plane);
  TickOutput out = describe_smooth(cache.smooth, scene.mesh().origin());
  const Rendered rendered =
      render(preset, plane, section, finger_velocity(preset, input.finger.position, input.t_s, state));
  out.force_n = rendered.force_n;
  out.cld_m = rendered.cld_m;
  keep_pose(input.finger.position, input.t_s, state);
  return out;
}

/// A tick of a 3D scene that does not glide.
static TickOutput step_any(const ContactScene& scene, StepCache& cache, const Preset& preset, const TickInput& input,
                           const FingerPose& local, const FingerSection& section, TickState& state,
                           IterationTrace* trace) {
  if (!is_usable(input.finger)) return step_without_pose(scene, preset, input.t_s, state);
  if (only_smooth(preset)) return step_smooth(scene, cache, preset, input, local, section, state, trace);
  return step_facets(scene, cache, preset, input, local, state, trace);
}

TickOutput Stepper::step(const Preset& preset, const TickInput& input, TickState& state, IterationTrace* trace) {
  const ContactScene& scene = *scene_;
  if (scene.planar()) return step_planar(*scene.planar(), preset, input, state, trace);
  const FingerPose local{input.finger.position - scene.mesh().origin(), input.finger.orientation};
  const FingerSection section = section_of(input.finger.orientation);  // needed last, but has nothing to wait for
  if (!trace && preset.solver.method == Method::robust) {
    Glide plane;
    if (glide(*cache_, preset, local, state, plane))
      return end_glide(*cache_, preset, input, section, scene.mesh().origin(), plane, state);
  }
  return step_any(scene, *cache_, preset, input, local, section, state, trace);
}

const char* to_string(Feature feature) {
  switch (feature) {
    case Feature::face:
      return "face";
    case Feature::edge:
      return "edge";
    case Feature::vertex:
      return "vertex";
    case Feature::none:
      break;
  }
  return "none";
}

const char* to_string(TickStatus status) {
  switch (status) {
    case TickStatus::free:
      return "free";
    case TickStatus::face:
      return "face";
    case TickStatus::edge:
      return "edge";
    case TickStatus::vertex:
      return "vertex";
    case TickStatus::unconverged:
      break;
  }
  return "unconverged";
}

const char* to_string(TickEvent event) {
  switch (event) {
    case TickEvent::none:
      break;
    case TickEvent::first:
      return "first";
    case TickEvent::reseed:
      return "reseed";
    case TickEvent::switched:
      return "switch";
    case TickEvent::branch:
      return "branch";
  }
  return "none";
}

const char* to_string(Method method) {
  switch (method) {
    case Method::paper:
      return "paper";
    case Method::newton:
      return "newton";
    case Method::robust:
      break;
    case Method::facet:
      return "facet";
    case Method::force_shading:
      return "force-shading";
    case Method::two_pass:
      return "two-pass";
  }
  return "robust";
}

const char* to_string(StopReason reason) {
  switch (reason) {
    case StopReason::going_on:
      return "going_on";
    case StopReason::converged:
      return "converged";
    case StopReason::iteration_limit:
      return "iteration_limit";
    case StopReason::cycling:
      return "cycling";
    case StopReason::unstable:
      return "unstable";
    case StopReason::left_boundary:
      return "left_boundary";
    case StopReason::singular_patch:
      return "singular_patch";
    case StopReason::too_far:
      return "too_far";
    case StopReason::leapt:
      return "leapt";
  }
  return "going_on";
}

}  // namespace tangent
