#include "workbench/gui/model/preset_editor.h"
#include "tests/support/approx.h"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace tangent;
using namespace tangent::test;

namespace {

const PresetKey& key(const char* table, const char* name) {
  const PresetKey* found = find_preset_key(table, name);
  REQUIRE(found != nullptr);
  return *found;
}

std::filesystem::path new_folder(const char* name) {
  const auto folder = std::filesystem::temp_directory_path() / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace

TEST_CASE("values are clamped into their range, made whole where they must be, and never NaN") {
  PresetEditor editor;
  const PresetKey& gain = key("solver", "gain_overall");
  CHECK(editor.set(gain, 1e9));
  CHECK(editor.current().solver.gain_overall == gain.max);
  CHECK(editor.set(gain, -3.0));
  CHECK(editor.current().solver.gain_overall == gain.min);
  CHECK_FALSE(editor.set(gain, std::nan("")));
  CHECK_FALSE(editor.set(gain, -5.0));  // already there
  CHECK(editor.set(key("solver", "max_iterations"), 12.6));
  CHECK(editor.current().solver.max_iterations == 13);
}

TEST_CASE("what changed since loading is listed, and can be taken back key by key") {
  PresetEditor editor;
  CHECK_FALSE(editor.changed());
  editor.set(key("force", "stiffness_n_per_m"), 1234.0);
  editor.set(key("finger", "radius_m"), 0.008);
  const auto changes = editor.changes();
  REQUIRE(changes.size() == 2);
  CHECK(changes[0].key->full_name() == "finger.radius_m");
  CHECK(changes[0].now == 0.008);
  CHECK(changes[1].loaded == 800.0);
  editor.revert(key("finger", "radius_m"));
  CHECK(editor.changes().size() == 1);
  editor.revert_all();
  CHECK_FALSE(editor.changed());
}

TEST_CASE("a preset saved from the window is the one that is loaded again") {
  const auto folder = new_folder("tangent_preset_editor_test");
  PresetEditor editor;
  editor.set(key("solver", "gain_curvature_m"), 0.0123);
  REQUIRE(editor.save_as(folder, "steep", {}).has_value());
  CHECK_FALSE(editor.changed());
  CHECK(editor.name() == "steep");
  CHECK(list_presets(folder).size() == 1);
  PresetEditor other;
  REQUIRE(other.load(folder / "steep.toml").has_value());
  CHECK(other.current() == editor.current());
  CHECK(other.loaded().about.name == "steep");
}

TEST_CASE("a broken preset file changes nothing and says what is wrong where") {
  const auto folder = new_folder("tangent_preset_editor_broken");
  std::ofstream(folder / "broken.toml") << "[solver]\ngain_overall = 99\n";
  PresetEditor editor;
  editor.set(key("solver", "gain_overall"), 0.5);
  const Preset before = editor.current();
  const auto status = editor.load(folder / "broken.toml");
  REQUIRE_FALSE(status.has_value());
  CHECK(status.error().message().find("gain_overall") != std::string::npos);
  CHECK(editor.current() == before);
  CHECK(editor.name() == "built-in");
  CHECK_FALSE(editor.save_as(folder, "../up", {}).has_value());
  CHECK_FALSE(editor.save_as(folder, "", {}).has_value());
}

TEST_CASE("typed values take the unit that is shown, or another of the same kind") {
  const PresetKey& radius = key("finger", "radius_m");
  CHECK(display_unit(radius).name == "mm");
  CHECK(display_unit(key("controller", "lowest_m")).name == "mm");
  CHECK(parse_typed(radius, "20").value() == approx(0.020));
  CHECK(parse_typed(radius, " 20 mm ").value() == approx(0.020));
  CHECK(parse_typed(radius, "0.02 m").value() == approx(0.020));
  CHECK(parse_typed(radius, "+2e1").value() == approx(0.020));
  for (const char* bad : {"", "mm", "20 N", "2,5", "20 mm x", "nan", "inf", "1e999", "0x10 "}) {
    CAPTURE(bad);
    CHECK_FALSE(parse_typed(radius, bad).has_value());
  }
  CHECK(parse_typed(key("solver", "tolerance_m"), "1 um").value() == approx(1e-6));
  CHECK(display_text(key("solver", "tolerance_m"), 1e-6) == "1");
  CHECK(display_text(radius, 0.02) == "20");
  CHECK(display_range(radius) == "0 to 1000 mm");
}

TEST_CASE("every slider goes from end to end, and its places read back") {
  for (const PresetKey& k : preset_keys()) {
    if (k.kind == KeyKind::choice) continue;
    CAPTURE(k.full_name());
    double before = -1e300;
    for (double share = 0.0; share <= 1.0; share += 0.05) {
      const double value = slider_value(k, share);
      CHECK(k.allows(value));
      CHECK(value >= before);
      before = value;
      if (k.kind == KeyKind::number) CHECK(slider_share(k, value) == approx(share).epsilon(0.02).scale(0.5));
    }
    CHECK(slider_share(k, k.slider_min) == 0.0);
    CHECK(slider_share(k, k.slider_max) == 1.0);
    CHECK(slider_share(k, k.max * 10.0) == 1.0);
  }
}
