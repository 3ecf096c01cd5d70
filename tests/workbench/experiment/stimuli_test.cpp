// Everything that the shipped protocols show, built and felt.
#include "workbench/experiment/stimuli.h"

#include "core/io/mesh_io.h"
#include "core/io/rendering_condition.h"
#include "core/lab/measure/perception.h"
#include "core/tick/step.h"
#include "tests/support/approx.h"
#include "tests/support/paths.h"
#include "workbench/evidence/made_mesh.h"
#include "workbench/recording/scene_bytes.h"
#include "workbench/session/own_folder.h"

#include <doctest/doctest.h>

#include <set>

namespace tangent::experiment {

using test::approx;
namespace {

Protocol shipped_protocol(const std::string& name) {
  auto protocol =
      read_protocol(std::filesystem::path(testing::source_folder()) / "presets" / "experiments" / (name + ".toml"));
  REQUIRE_MESSAGE(protocol, (protocol ? "" : protocol.error().message()));
  return std::move(*protocol);
}

/// With coarser unshaded objects, which are built sooner.
Protocol coarse_identification() {
  Protocol protocol = shipped_protocol("identification");
  std::get<Identification>(protocol.kind).facet_deg = 3.0;
  return protocol;
}

Stimuli stimuli_of(const Protocol& protocol) {
  auto stimuli = Stimuli::make(protocol);
  REQUIRE_MESSAGE(stimuli, (stimuli ? "" : stimuli.error().message()));
  return std::move(*stimuli);
}

/// A tick of the finger at a place of the device, through the stimulus's placement.
TickOutput felt_at(const RenderedStimulus& stimulus, const Vec3& device_m) {
  Preset preset = stimulus.preset;
  preset.force.blend = ForceBlend::off;
  Stepper stepper(stimulus.scene);
  TickState state;
  TickInput input;
  input.finger = {stimulus.placement.to_scene(device_m),
                  stimulus.placement.orientation_to_scene(Quat(1.0, 0.0, 0.0, 0.0))};
  TickOutput out = stepper.step(preset, input, state);
  out.force_n = stimulus.placement.force_to_device(out.force_n);
  return out;
}

TEST_CASE("arcs of the shipped protocol: the exact one and segments, under each condition, pushing up") {
  const Stimuli stimuli = stimuli_of(shipped_protocol("discrimination"));
  std::set<std::string> hashes;
  for (const std::string condition : {"C1", "C2", "C3", "C4", "P1", "P2"}) {
    CAPTURE(condition);
    for (const int segments : {0, 3, 26, 2000}) {
      CAPTURE(segments);
      const auto arc = stimuli.arc(condition, segments);
      REQUIRE_MESSAGE(arc, (arc ? "" : arc.error().message()));
      CHECK(condition_of(arc->preset)->name == condition);
      CHECK(arc->name == (segments == 0 ? "exact arc" : "arc of " + std::to_string(segments) + " tangent segments"));
      CHECK(arc->mesh_hash == scene_hash(*arc->scene));
      hashes.insert(arc->mesh_hash);
      // The middle of the arc is at the device's origin, a finger of 20 mm above it 1 mm deep; three segments have
      // their corners elsewhere, and the middle of one, which touches the arc, there.
      const TickOutput out = felt_at(*arc, {0.0, 0.0, 0.019});
      CHECK(out.force_n.z == approx(0.8).epsilon(0.2));
      CHECK(std::abs(out.force_n.x) + std::abs(out.force_n.y) < 0.05);
      CHECK(felt_at(*arc, {0.0, 0.0, 0.030}).force_n == Vec3(0.0));
    }
  }
  CHECK(hashes.size() == 4);
  CHECK_FALSE(stimuli.arc("C9", 0));
  CHECK_FALSE(stimuli.arc("C1", 2));
  CHECK_FALSE(stimuli.object("cube", true, true, Facing::left));
  CHECK_FALSE(stimuli.rendered({}));
}

TEST_CASE("objects of the shipped protocol: shaded and unshaded, tips left and right, and the practice hexagon") {
  const Protocol protocol = coarse_identification();
  const Stimuli stimuli = stimuli_of(protocol);
  std::vector<std::string> names = protocol.identification()->objects;
  names.push_back("hexagon");
  CHECK(names.size() == 8);
  std::set<std::string> hashes;
  for (const std::string& name : names) {
    for (const bool shaded : {false, true}) {
      for (const bool tactile : {false, true}) {
        for (const Facing facing : {Facing::left, Facing::right}) {
          CAPTURE(name);
          CAPTURE(shaded);
          Stimulus asked;
          asked.kind = Stimulus::Kind::object;
          asked.object = name, asked.shaded = shaded, asked.tactile = tactile, asked.facing = facing;
          const auto object = stimuli.rendered(asked);
          REQUIRE_MESSAGE(object, (object ? "" : object.error().message()));
          hashes.insert(object->mesh_hash);
          CHECK(object->preset.force.source == (shaded ? ForceSource::smooth : ForceSource::facet));
          CHECK((object->preset.display.source == TactileSource::held) == !tactile);
          CHECK(object->scene->has_hierarchy() == shaded);
          CHECK(object->preset.force.limit_n == protocol.preset.force.limit_n);
          CHECK(felt_at(*object, {0.0, 0.0, 0.08}).force_n == Vec3(0.0));  // the start
          // Pressed from above into the middle of the object, the finger is pushed up.
          CHECK(felt_at(*object, {0.0, 0.0, 0.025}).force_n.z > 0.5);
        }
      }
    }
  }
  CHECK(hashes.size() == 2 * 8 + 2 * 2);  // cone and tetrahedron twice
  CHECK_FALSE(stimuli.object("torus", true, true, Facing::left));
  CHECK_FALSE(stimuli.arc("C1", 0));
}

TEST_CASE("the tip of a cone that faces left is at the person's left, where the finger points forward") {
  const Stimuli stimuli = stimuli_of(coarse_identification());
  for (const std::string name : {"cone", "tetrahedron"}) {
    for (const bool left : {true, false}) {
      const auto object = stimuli.object(name, false, false, left ? Facing::left : Facing::right);
      REQUIRE(object);
      CHECK(object->name == name + (left ? " facing left, unshaded" : " facing right, unshaded"));
      // In the world +x is away from the person and z up, so the left is +y. The base is wide, the tip is not.
      const Vec3 at(0.0, 0.035, 0.030);
      const bool touches = felt_at(*object, at).force_n != Vec3(0.0);
      const bool mirrored = felt_at(*object, {at.x, -at.y, at.z}).force_n != Vec3(0.0);
      CHECK(touches == !left);
      CHECK(mirrored == left);
      CHECK(glm::length(object->placement.orientation_to_scene(Quat(1, 0, 0, 0)) * Vec3(1, 0, 0) - Vec3(0, 1, 0)) <
            1e-12);
    }
  }
}

TEST_CASE("unshaded round objects have so many facets that their angle is below the one asked for") {
  for (const double limit : {6.0, 3.0, 1.0}) {
    for (const std::string name : {"cone", "cylinder", "sphere"}) {
      GenerateOptions options;
      options.segments = facet_segments(name, limit);
      const auto polygons = generate_mesh(name, options);
      REQUIRE(polygons);
      const auto mesh = ContactMesh::build(*polygons);
      REQUIRE(mesh);
      const PerceptionAudit audit = audit_perception(*mesh, facet_angles(*mesh));
      CAPTURE(name);
      CHECK(audit.largest_curve_deg < limit);
      CHECK(audit.largest_curve_deg > 0.4 * limit);  // and no more than needed
    }
  }
  // Of the shipped protocol; that their angles are below 0.2 degrees is in its file, by `audit`.
  CHECK(shipped_protocol("identification").identification()->facet_deg == 0.2);
  CHECK(facet_segments("cylinder", 0.2) == 2000);
  CHECK(facet_segments("cone", 0.2) == 2000);
  CHECK(facet_segments("sphere", 0.2) == 8);
  CHECK(facet_segments("cube", 0.2) == 0);
}

TEST_CASE("an exact arc goes through a recording's bytes as it is") {
  const auto arc = stimuli_of(shipped_protocol("discrimination")).arc("C4", 0);
  REQUIRE(arc);
  const SceneSource source = source_of_planar(*arc->scene);
  std::vector<unsigned char> bytes = scene_bytes(source);
  const auto back = scene_source_from(bytes, source.name());
  REQUIRE(back);
  CHECK(back->polygon->exact == source.polygon->exact);
  CHECK(back->polygon->vertices == source.polygon->vertices);
  const auto scene = build_scene(*back);
  REQUIRE(scene);
  CHECK(scene_hash(**scene) == arc->mesh_hash);
  bytes.pop_back();
  CHECK_FALSE(scene_source_from(bytes, source.name()));
}

TEST_CASE("the command that a recording names for an object makes that object, to the last bit") {
  const Stimuli stimuli = stimuli_of(coarse_identification());
  const auto folder = OwnFolder::make();
  const std::filesystem::path file = folder->path() / "mesh.obj";
  for (const bool shaded : {true, false})
    for (const Facing facing : {Facing::left, Facing::right})
      for (const std::string object : {"cone", "cube", "tetrahedron"}) {
        const auto stimulus = stimuli.object(object, shaded, false, facing);
        REQUIRE(stimulus);
        CAPTURE(stimulus->made);
        const auto made = made_from(stimulus->made);
        REQUIRE(made);
        REQUIRE(write_obj(*generate_mesh(made->object, made->options), file, 1.0, ""));
        const auto mesh = read_mesh(file, 1.0);
        REQUIRE(mesh);
        const auto built = ContactMesh::build(*mesh);
        REQUIRE(built);
        CHECK(scene_hash(**ContactScene::build(ContactMesh(*built))) == stimulus->mesh_hash);
      }
}

}  // namespace
}  // namespace tangent::experiment
