#include "workbench/gui/model/preset_slots.h"

#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

using namespace tangent;

namespace {

const PresetKey& gain() { return *find_preset_key("solver", "gain_overall"); }
const PresetKey& radius() { return *find_preset_key("finger", "radius_m"); }

bool set(PresetSlots& slots, const PresetKey& key, double value, std::string_view gesture = {}) {
  return slots.apply(
      key.full_name(), [&](PresetEditor& editor) { return editor.set(key, value); }, gesture);
}

double gain_of(const PresetSlots& slots) { return slots.active().current().solver.gain_overall; }

}  // namespace

TEST_CASE("every change can be undone and done again, in order - a new one forgets what was undone") {
  PresetSlots slots;
  CHECK_FALSE(slots.can_undo());
  set(slots, gain(), 0.5);
  set(slots, radius(), 0.008);
  set(slots, gain(), 0.7);
  CHECK(slots.undo());
  CHECK(gain_of(slots) == 0.5);
  CHECK(slots.redo_name() == "solver.gain_overall");
  CHECK(slots.undo());
  CHECK(slots.active().current().finger.radius_m == 0.020);
  CHECK(slots.undo());
  CHECK(slots.active().current() == Preset{});
  CHECK_FALSE(slots.undo());
  slots.redo();
  slots.redo();
  slots.redo();
  CHECK_FALSE(slots.can_redo());
  CHECK(gain_of(slots) == 0.7);
  slots.undo();
  set(slots, gain(), 2.0);
  CHECK_FALSE(slots.can_redo());
  slots.undo();
  CHECK(gain_of(slots) == 0.5);
}

TEST_CASE("what changes nothing is no step") {
  PresetSlots slots;
  CHECK_FALSE(set(slots, gain(), 1.0));
  CHECK_FALSE(slots.can_undo());
}

TEST_CASE("a drag is one step, two drags are two, and another key in between ends it") {
  PresetSlots slots;
  for (const double v : {0.9, 0.8, 0.7}) set(slots, gain(), v, "gain");
  slots.end_gesture();
  for (const double v : {0.6, 0.5}) set(slots, gain(), v, "gain");
  set(slots, radius(), 0.01, "radius");
  slots.end_gesture();
  CHECK(slots.undo());
  CHECK(slots.active().current().finger.radius_m == 0.020);
  CHECK(slots.undo());
  CHECK(gain_of(slots) == 0.7);
  CHECK(slots.undo());
  CHECK(gain_of(slots) == 1.0);
  CHECK_FALSE(slots.undo());
}

TEST_CASE("A and B are two presets - switching is a step too") {
  PresetSlots slots;
  set(slots, gain(), 0.5);
  CHECK(slots.toggle());
  CHECK(slots.active_slot() == 1);
  CHECK(gain_of(slots) == 1.0);
  set(slots, gain(), 3.0);
  CHECK(slots.toggle());
  CHECK(gain_of(slots) == 0.5);
  slots.undo();
  CHECK(gain_of(slots) == 3.0);
  CHECK(slots.active_slot() == 1);
  slots.redo();
  slots.copy_to_other();
  CHECK_FALSE(slots.toggle());  // the same values: nothing to send
  CHECK(gain_of(slots) == 0.5);
}

TEST_CASE("steps are bounded") {
  PresetSlots slots;
  for (int i = 0; i < 600; ++i) set(slots, gain(), 0.001 * (i + 1));
  std::size_t steps = 0;
  while (slots.undo()) ++steps;
  CHECK(steps == PresetSlots::kMostSteps - 1);
}

TEST_CASE("undoing what was done before a save brings the values back and not the old file") {
  const testing::TempFolder folder;
  PresetSlots slots;
  set(slots, gain(), 0.5);
  set(slots, gain(), 0.6);
  REQUIRE(slots.save_as(folder.path(), "mine", {}));
  CHECK_FALSE(slots.active().changed());
  slots.undo();
  CHECK(gain_of(slots) == 0.5);
  CHECK(slots.active().name() == "mine");
  CHECK(slots.active().changed());
  CHECK_FALSE(slots.save_as(folder.path(), "a/b", {}));
  CHECK(slots.active().name() == "mine");
}

TEST_CASE("differences name the keys in which two presets differ, with both values") {
  Preset a, b;
  b.solver.gain_overall = 0.3;
  b.solver.method = Method::paper;
  const auto found = differences(a, b);
  REQUIRE(found.size() == 2);
  CHECK(found[0].key->full_name() == "solver.method");
  CHECK(found[1].loaded == 1.0);
  CHECK(found[1].now == 0.3);
  CHECK(differences(a, a).empty());
}
