#include "workbench/experiment/stimuli.h"

#include "core/io/rendering_condition.h"
#include "core/lab/objects/arc.h"
#include "workbench/evidence/made_mesh.h"
#include "workbench/recording/scene_bytes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tangent::experiment {
namespace {

constexpr std::array<Facing, 2> kBothFacings{Facing::left, Facing::right};

/// z up in the world, y up in a 2D scene: a quarter turn back about x, the way of the finger.
Placement arc_placement(double radius_m) {
  constexpr double kShare = std::numbers::sqrt2 / 2.0;
  return {1.0, Quat(kShare, -kShare, 0.0, 0.0), Vec3(0.0, radius_m, 0.0)};
}

/// The finger's way, the world's +x, to the scene's +y.
Placement object_placement() {
  constexpr double kShare = std::numbers::sqrt2 / 2.0;
  return {1.0, Quat(kShare, 0.0, 0.0, kShare), Vec3(0.0)};
}

std::string spoken(const std::string& name, bool shaded, bool both_ways, Facing facing) {
  const std::string way = both_ways ? (facing == Facing::left ? " facing left" : " facing right") : "";
  return name + way + (shaded ? ", shaded" : ", unshaded");
}

/// Unshaded objects are felt by their facets: they need no structures of the smooth surface. Never in parts, which a
/// servo would have to build first.
SceneParts parts_of(bool shaded) {
  SceneParts parts;
  parts.hierarchy = shaded;
  parts.whole_up_to = 1u << 24;
  return parts;
}

}  // namespace

int facet_segments(const std::string& object, double facet_deg) {
  constexpr double kBelow = 0.9;  // of the angle, so that it is truly below
  if (object == "cone" || object == "cylinder")
    return std::clamp(static_cast<int>(std::ceil(360.0 / (kBelow * facet_deg))), 3, 4096);
  if (object != "sphere") return 0;
  // Largest angle of the subdivided icosahedron, by `audit`: 0.360 degrees after seven, and half with each further one.
  constexpr double kAngleOfSeven = 0.361;
  const double more = std::log2(kAngleOfSeven / facet_deg);
  return std::clamp(7 + static_cast<int>(std::floor(more)) + 1, 1, 9);
}

Result<Stimuli> Stimuli::make(const Protocol& protocol) {
  Stimuli out;
  out.protocol_ = protocol;
  if (const Discrimination* d = protocol.discrimination()) {
    Result<PlanarCurve> curve = PlanarCurve::build(ArcStimulus{d->angle_rad, d->radius_m}.exact());
    if (!curve) return tl::unexpected(curve.error());
    auto scene = ContactScene::build(std::move(*curve));
    if (!scene) return tl::unexpected(scene.error());
    out.exact_arc_ = {*scene, scene_hash(**scene), {}};
    for (const ComparisonCondition& condition : d->conditions)
      if (auto arc = out.arc(condition.name, 0); !arc) return tl::unexpected(arc.error());
    return out;
  }
  std::vector<std::string> names = protocol.identification()->objects;
  if (!protocol.identification()->practice.empty()) names.push_back(protocol.identification()->practice);
  for (const std::string& name : names)
    for (const bool shaded : {false, true})
      for (const Facing facing : kBothFacings)
        if (Status status = out.add_object(name, shaded, facing); !status) return tl::unexpected(status.error());
  return out;
}

bool Stimuli::has_both_ways(const std::string& name) const {
  const std::vector<std::string>& both = protocol_.identification()->both_ways;
  return std::find(both.begin(), both.end(), name) != both.end();
}

Status Stimuli::add_object(const std::string& name, bool shaded, Facing facing) {
  if (facing == Facing::left && !has_both_ways(name)) return {};
  const Identification& d = *protocol_.identification();
  GenerateOptions options;
  options.facing = facing;
  if (shaded) options.rounding_m = d.rounding_m;
  if (!shaded) options.segments = facet_segments(name, d.facet_deg);
  Result<PolygonMesh> polygons = generate_mesh(name, options);
  if (!polygons) return tl::unexpected(polygons.error());
  Result<ContactMesh> mesh = ContactMesh::build(*polygons);
  if (!mesh) return tl::unexpected(mesh.error());
  auto scene = ContactScene::build(std::move(*mesh), parts_of(shaded));
  if (!scene) return tl::unexpected(scene.error());
  objects_[{name, shaded, facing}] = {*scene, scene_hash(**scene), made_text({name, options})};
  return {};
}

Result<RenderedStimulus> Stimuli::arc(const std::string& condition, int segments) const {
  const Discrimination* d = protocol_.discrimination();
  if (d == nullptr) return fail("the protocol shows objects, not arcs", protocol_.name, "ask for an object");
  const RenderingCondition* found = find_condition(condition);
  if (found == nullptr) return fail("\"" + condition + "\" is no rendering condition", protocol_.name);
  Preset preset = protocol_.preset;
  set_condition(preset, *found);
  const Placement placement = arc_placement(d->radius_m);
  if (segments == 0) return RenderedStimulus{exact_arc_.scene, preset, "exact arc", exact_arc_.hash, {}, placement};
  Result<PlanarPolygon> polygon = ArcStimulus{d->angle_rad, d->radius_m}.polygon(segments, d->placement);
  if (!polygon) return tl::unexpected(polygon.error());
  const std::string name = polygon->name;
  Result<PlanarCurve> curve = PlanarCurve::build(std::move(*polygon));
  if (!curve) return tl::unexpected(curve.error());
  auto scene = ContactScene::build(std::move(*curve));
  if (!scene) return tl::unexpected(scene.error());
  return RenderedStimulus{*scene, preset, name, scene_hash(**scene), {}, placement};
}

Result<RenderedStimulus> Stimuli::object(const std::string& name, bool shaded, bool tactile, Facing facing) const {
  if (protocol_.identification() == nullptr)
    return fail("the protocol shows arcs, not objects", protocol_.name, "ask for an arc");
  const bool both_ways = has_both_ways(name);
  const auto found = objects_.find({name, shaded, both_ways ? facing : Facing::right});
  if (found == objects_.end())
    return fail("\"" + name + "\" is none of the objects", protocol_.name, "name one of them");
  Preset preset = protocol_.preset;
  set_condition(preset, object_condition(shaded, tactile));
  return RenderedStimulus{
      found->second.scene, preset, spoken(name, shaded, both_ways, facing), found->second.hash, found->second.made,
      object_placement()};
}

Result<RenderedStimulus> Stimuli::rendered(const Stimulus& s) const {
  switch (s.kind) {
    case Stimulus::Kind::arc:
      return arc(s.condition, s.segments);
    case Stimulus::Kind::object:
      return object(s.object, s.shaded, s.tactile, s.facing);
    default:
      return fail("nothing is shown now", protocol_.name);
  }
}

}  // namespace tangent::experiment
