// Every value of a preset can be set on the command line, with only its row of the schema.
#include "workbench/cli/preset_options.h"

#include "core/base/text.h"
#include "tests/support/temp_folder.h"
#include "workbench/session/unit_labels.h"

#include <doctest/doctest.h>
#include <CLI/CLI.hpp>

#include <optional>

using namespace tangent;
using tangent::testing::contains;
using tangent::testing::TempFolder;

namespace {

/// The preset of a command line, or why it is refused.
Result<Preset> parsed(std::vector<std::string> arguments) {
  CLI::App app;
  PresetOptions options;
  add_preset_options(app, options);
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 takes them
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    return fail(error.what(), {}, {});
  }
  const Result<PresetFile> file = load_preset(options);
  if (!file) return tl::unexpected(file.error());
  return file->preset;
}

std::string refusal(const std::vector<std::string>& arguments) {
  const Result<Preset> preset = parsed(arguments);
  REQUIRE_FALSE(preset);
  return preset.error().message();
}

/// A value of the row that is allowed, not the default and one decimal number in every unit.
double other_value(const PresetKey& key) {
  if (key.kind != KeyKind::number) return key.default_value() == key.max ? key.min : key.max;
  return key.default_value() == key.slider_max ? key.slider_min : key.slider_max;
}

std::string number_text(double value) {
  std::string text;
  append_double(text, value);
  return text;
}

}  // namespace

TEST_CASE("every key of a preset is set by its name, and no other with it") {
  for (const PresetKey& key : preset_keys()) {
    CAPTURE(key.full_name());
    const double value = other_value(key);
    Preset expected;
    key.set(expected, value);
    const Result<Preset> preset = parsed({"--set", key.full_name() + "=" + key.value_text(value)});
    REQUIRE(preset);
    CHECK(*preset == expected);
    CHECK_FALSE(*preset == Preset{});
  }
}

TEST_CASE("every option of the schema sets its key, in its own unit, which its name ends with") {
  std::size_t options = 0;
  for (const PresetKey& key : preset_keys()) {
    if (key.option.empty()) continue;
    CAPTURE(key.full_name());
    const double value = other_value(key);
    const std::string text =
        key.kind == KeyKind::choice ? key.value_text(value) : number_text(value * key.option_per_si);
    const Result<Preset> preset = parsed({"--" + std::string(key.option), text});
    REQUIRE(preset);
    CHECK(key.get(*preset) == value);
    ++options;
    if (key.kind == KeyKind::choice) continue;
    // "um" for a millionth of a metre, "n-per-m" for N/m.
    std::string unit(unit_of_size(key.unit, 1.0 / key.option_per_si).plain);
    if (const std::size_t per = unit.find('/'); per != std::string::npos)
      unit.replace(0, per + 1, (per == 1 && unit[0] == '1' ? "" : unit.substr(0, per) + "-") + "per-");
    for (char& c : unit) c = c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    CHECK(key.option.ends_with(unit.empty() ? "" : "-" + unit));
    CHECK(contains(refusal({"--" + std::string(key.option), "-1e9"}), "is out of range; allowed: "));
  }
  CHECK(options > 0);
}

TEST_CASE("a radius makes a sphere of a point, and none a point of a sphere") {
  CHECK(parsed({"--finger-radius-mm", "0"})->finger.shape == FingerShape::point);
  CHECK(parsed({"--finger-radius-mm", "8"})->finger.shape == FingerShape::sphere);
  const TempFolder folder;
  const std::string capsule = folder.write("capsule.toml", "[finger]\nshape = \"capsule\"\n");
  CHECK(parsed({"--preset", capsule, "--finger-radius-mm", "8"})->finger.shape == FingerShape::capsule);
  const std::string ellipsoid = folder.write("ellipsoid.toml", "[finger]\nshape = \"ellipsoid\"\n");
  CHECK(parsed({"--preset", ellipsoid, "--finger-radius-mm", "8"})->finger.shape == FingerShape::sphere);
  // The key alone is no more than the key.
  CHECK(parsed({"--set", "finger.radius_m=0"})->finger.shape == FingerShape::sphere);
}

TEST_CASE("keys are set after files and options, in their order, several at once") {
  const TempFolder folder;
  const std::string file = folder.write("p.toml", "format = 1\n[force]\nlimit_n = 3\nstiffness_n_per_m = 100\n");
  const Result<Preset> preset = parsed({"--set", "force.limit_n=5", "--preset", file, "--set",
                                        "solver.tolerance_m=1e-7", "--tolerance-um", "2", "--set", "force.limit_n=6"});
  REQUIRE(preset);
  CHECK(preset->force.limit_n == 6.0);
  CHECK(preset->force.stiffness_n_per_m == 100.0);
  CHECK(preset->solver.tolerance_m == 1e-7);
}

TEST_CASE("what is no key or no value of it is refused with what is allowed") {
  for (const char* text :
       {"solver.gain=1", "gain_overall=1", "solver.gain_overall", "=1", "solver=1", "about.name=x"}) {
    CAPTURE(text);
    CHECK(contains(refusal({"--set", text}), "names no key of a preset; write TABLE.KEY=VALUE"));
  }
  CHECK(contains(refusal({"--set", "solver.gain_overall=10.5"}), "is out of range; allowed: 0 to 10"));
  for (const char* text : {"solver.gain_overall=nan", "solver.gain_overall=", "solver.gain_overall=1um"})
    CHECK(contains(refusal({"--set", text}), std::string(text) + "' gives no finite number; allowed: 0 to 10"));
  CHECK(contains(refusal({"--set", "solver.max_iterations=2.5"}), "allowed: a whole number from 1 to 10000"));
  CHECK(contains(refusal({"--set", "solver.method=magic"}), "gives an unknown word; allowed: paper, newton, robust"));
  CHECK(contains(refusal({"--set", "solver.method=2"}), "allowed: paper, newton, robust"));
}
