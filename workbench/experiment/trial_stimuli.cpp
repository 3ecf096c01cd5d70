#include "workbench/experiment/trial_stimuli.h"

#include "core/io/rendering_condition.h"
#include "core/planar/curve.h"

namespace tangent::experiment {
namespace {

constexpr int kExactSegments = 2000;  // stands in for the circle

std::string object_key(const Stimulus& shown) {
  return shown.object + (shown.shaded ? ", shaded" : ", facets") +
         (shown.facing == Facing::left ? ", points left" : ", points right");
}

}  // namespace

Result<TrialStimuli> TrialStimuli::make(const Protocol& protocol) {
  TrialStimuli out(protocol);
  const Identification* design = protocol.identification();
  if (design == nullptr) return out;
  for (const bool shaded : {true, false}) {
    for (const Facing facing : {Facing::right, Facing::left}) {
      Stimulus shown;
      shown.kind = Stimulus::Kind::object;
      shown.shaded = shaded;
      shown.facing = facing;
      for (const std::string& name : facing == Facing::right ? design->objects : design->both_ways) {
        shown.object = name;
        if (auto made = out.get(shown); !made) return tl::unexpected(made.error());
      }
    }
  }
  return out;
}

Result<TrialStimulus> TrialStimuli::get(const Stimulus& shown) {
  return shown.kind == Stimulus::Kind::arc ? arc(shown) : object(shown);
}

Result<TrialStimulus> TrialStimuli::arc(const Stimulus& shown) const {
  const Discrimination& design = *protocol_.discrimination();
  const int segments = shown.segments == 0 ? kExactSegments : shown.segments;
  auto curve = PlanarCurve::build(make_paper_arc(segments, design.placement, 1, design.radius_m));
  if (!curve) return tl::unexpected(curve.error());
  auto scene = ContactScene::build(std::move(*curve));
  if (!scene) return tl::unexpected(scene.error());
  TrialStimulus out;
  out.scene = std::move(*scene);
  out.preset = protocol_.preset;
  set_condition(out.preset, *find_condition(shown.condition));
  out.name = shown.segments == 0 ? "the exact arc" : std::to_string(segments) + " segments";
  out.mesh_hash = scene_hash(*out.scene);
  out.source = source_of_planar(*out.scene);
  return out;
}

Result<TrialStimulus> TrialStimuli::object(const Stimulus& shown) {
  const std::string key = object_key(shown);
  if (!objects_.contains(key)) {
    GenerateOptions options;
    options.rounding_m = shown.shaded ? protocol_.identification()->rounding_m : 0.0;
    options.facing = shown.facing;
    auto made = generate_mesh(shown.object, options);
    if (!made) return tl::unexpected(made.error());
    auto mesh = ContactMesh::build(*made);
    if (!mesh) return tl::unexpected(mesh.error());
    auto scene = ContactScene::build(std::move(*mesh));
    if (!scene) return tl::unexpected(scene.error());
    const std::string hash = scene_hash(**scene);
    objects_[key] = {*scene, protocol_.preset, key, hash, {std::make_shared<const PolygonMesh>(*made), {}, nullptr}};
  }
  TrialStimulus out = objects_.at(key);
  out.preset.force.source = shown.shaded ? ForceSource::method : ForceSource::facet;
  out.preset.display.source = !shown.tactile ? TactileSource::held
                              : shown.shaded ? TactileSource::method
                                             : TactileSource::facet;
  return out;
}

}  // namespace tangent::experiment
