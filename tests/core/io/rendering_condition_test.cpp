#include "core/io/rendering_condition.h"

#include "core/io/preset_file.h"
#include "core/lab/measure/perception_thresholds.h"
#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

using namespace tangent;
using tangent::testing::contains;

namespace {

std::string condition_refusal(std::string_view text) {
  const auto file = parse_preset(text, "p.toml");
  REQUIRE_FALSE(file);
  return file.error().message();
}

}  // namespace

TEST_CASE("every condition sets its sources, is recognised by them, and those of arcs have a threshold") {
  for (std::size_t i = 0; i < kRenderingConditions.size(); ++i) {
    const RenderingCondition& condition = kRenderingConditions[i];
    Preset preset;
    set_condition(preset, condition);
    const RenderingCondition* found = condition_of(preset);
    REQUIRE(found != nullptr);
    CHECK((found->force == condition.force && found->tactile == condition.tactile));
    CHECK((found == &condition || i >= kArcConditions));  // of several with the same sources the first
    CHECK(find_condition(condition.name) == &condition);
    CHECK(kConditionNames[i] == condition.name);
    if (i < kArcConditions) CHECK(kArcConditionNames[i] == condition.name);
    if (i < kArcConditions) CHECK(kPerceptionThresholds[i].condition == condition.name);
  }
  CHECK(condition_of(Preset{}) == nullptr);
  CHECK(find_condition("C5") == nullptr);
}

TEST_CASE("the paper's conditions by their sources") {
  const auto is = [](std::string_view name, ForceSource force, TactileSource tactile) {
    const RenderingCondition* c = find_condition(name);
    return c != nullptr && c->force == force && c->tactile == tactile;
  };
  CHECK(is("C1", ForceSource::facet, TactileSource::held));
  CHECK(is("C2", ForceSource::force_shading, TactileSource::held));
  CHECK(is("C3", ForceSource::facet, TactileSource::facet));
  CHECK(is("C4", ForceSource::facet, TactileSource::smooth));
  CHECK(is("P1", ForceSource::smooth, TactileSource::smooth));
  CHECK(is("P2", ForceSource::force_shading, TactileSource::facet));
}

TEST_CASE("the four conditions of objects: force alone or with tactile feedback, facets or smooth") {
  for (const bool shaded : {false, true}) {
    for (const bool tactile : {false, true}) {
      const RenderingCondition& c = object_condition(shaded, tactile);
      CHECK(c.name == std::string(tactile ? "tactile" : "force") + (shaded ? "-shaded" : "-unshaded"));
      CHECK(c.force == (shaded ? ForceSource::smooth : ForceSource::facet));
      CHECK(c.tactile == (!tactile ? TactileSource::held : shaded ? TactileSource::smooth : TactileSource::facet));
    }
  }
  Preset preset;
  set_condition(preset, object_condition(true, false));
  CHECK(condition_of(preset)->name == "force-shaded");  // smooth force with the tactile held had no name before
}

TEST_CASE("a preset file names its condition, and reads it back") {
  const auto file = parse_preset("condition = \"C4\"\n[finger]\nradius_m = 0.01\n", "p.toml");
  REQUIRE(file);
  CHECK(file->preset.force.source == ForceSource::facet);
  CHECK(file->preset.display.source == TactileSource::smooth);
  CHECK(contains(format_preset(*file), "condition = \"C4\""));
  const auto back = parse_preset(format_preset(*file), "p.toml");
  REQUIRE(back);
  CHECK(*back == *file);
  CHECK_FALSE(contains(format_preset({}), "condition"));
}

TEST_CASE("a condition that does not exist, or that the sources contradict, is refused with its line") {
  CHECK(contains(condition_refusal("condition = \"C7\"\n"),
                 "p.toml:1 condition: \"C7\" is not a rendering condition; allowed: C1, C2, C3, C4, P1, P2"));
  CHECK(contains(condition_refusal("condition = 3\n"), "p.toml:1 condition: is a whole number"));
  CHECK(
      contains(condition_refusal("condition = \"C1\"\n[display]\nsource = \"smooth\"\n"), "the sources say otherwise"));
  CHECK(parse_preset("condition = \"C1\"\n[display]\nsource = \"held\"\n", "p.toml"));
}

TEST_CASE("a condition that the devices can't do says what is missing") {
  Preset preset;
  CHECK(check_devices(preset, false, false));
  set_condition(preset, *find_condition("C3"));
  const Status no_display = check_devices(preset, true, false);
  REQUIRE_FALSE(no_display);
  CHECK(contains(no_display.error().message(), "condition C3 needs a contact location display"));
  CHECK(contains(no_display.error().message(), "choose C1, C2 or force-shaded"));
  CHECK(check_devices(preset, true, true));
  set_condition(preset, *find_condition("C1"));
  CHECK(check_devices(preset, true, false));
  const Status no_force = check_devices(preset, false, false);
  REQUIRE_FALSE(no_force);
  CHECK(contains(no_force.error().message(), "condition C1 needs a force device"));
  preset = {};
  preset.display.source = TactileSource::smooth;
  CHECK_FALSE(check_devices(preset, true, false));
}
