#include "core/preset/schema.h"

#include "core/lab/measure/perception_thresholds.h"
#include "core/tick/step.h"

#include <doctest/doctest.h>

#include <limits>
#include <set>
#include <string>

using namespace tangent;

TEST_CASE("a new field of Preset needs a row in the schema") {
  // The size changes with the fields: whoever adds one is led here, and to preset_schema.cpp.
  CHECK(sizeof(Preset) == 256);
}

TEST_CASE("defaults lie in their range and sliders inside it") {
  for (const PresetKey& key : preset_keys()) {
    CAPTURE(key.full_name());
    CHECK(key.allows(key.default_value()));
    CHECK(key.min < key.max);
    CHECK(key.slider_min >= key.min);
    CHECK(key.slider_max <= key.max);
    CHECK(key.slider_min < key.slider_max);
    CHECK((!key.logarithmic || key.slider_min > 0.0));
    CHECK_FALSE(key.doc.empty());
    CHECK_FALSE(key.label.empty());
    CHECK((key.kind == KeyKind::choice) == key.unit.empty());
  }
  CHECK(check_preset(Preset{}));
}

TEST_CASE("names and options are unique and every key is found by its name") {
  std::set<std::string> names, options;
  for (const PresetKey& key : preset_keys()) {
    CHECK(names.insert(key.full_name()).second);
    if (!key.option.empty()) CHECK(options.insert(std::string(key.option)).second);
    CHECK(find_preset_key(key.table, key.key) == &key);
  }
  CHECK(find_preset_key("solver", "gain") == nullptr);
  CHECK(find_preset_key("force", "gain_overall") == nullptr);
}

TEST_CASE("setting a key changes that key and no other") {
  for (const PresetKey& changed : preset_keys()) {
    Preset preset;
    const double value = changed.default_value() == changed.max ? changed.min : changed.max;
    changed.set(preset, value);
    for (const PresetKey& key : preset_keys()) {
      CAPTURE(changed.full_name());
      CAPTURE(key.full_name());
      CHECK(key.get(preset) == (&key == &changed ? value : key.default_value()));
    }
  }
}

TEST_CASE("nothing outside the range is allowed") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const PresetKey& key : preset_keys()) {
    CAPTURE(key.full_name());
    CHECK(key.allows(key.min));
    CHECK(key.allows(key.max));
    CHECK_FALSE(key.allows(std::nextafter(key.min, -kInfinity)));
    CHECK_FALSE(key.allows(std::nextafter(key.max, kInfinity)));
    CHECK_FALSE(key.allows(std::numeric_limits<double>::quiet_NaN()));
    CHECK_FALSE(key.allows(kInfinity));
    if (key.kind != KeyKind::number) CHECK_FALSE(key.allows(key.min + 0.5));
  }
}

TEST_CASE("a preset out of range is refused by name") {
  Preset preset;
  preset.solver.tolerance_m = -1.0;
  const Status status = check_preset(preset);
  REQUIRE_FALSE(status);
  CHECK(status.error().message() == "solver.tolerance_m: -1 is out of range; allowed: 1e-12 to 0.001 m");
}

TEST_CASE("choices are called as the solver calls them") {
  const PresetKey& method = *find_preset_key("solver", "method");
  for (std::size_t i = 0; i < method.choices.size(); ++i) {
    CHECK(method.choices[i] == to_string(static_cast<Method>(i)));
    CHECK(method.choice_index(method.choices[i]) == static_cast<int>(i));
  }
  CHECK(method.choice_index("magic") == -1);
  CHECK(method.allowed() == "paper, newton, robust, facet, force-shading or two-pass");
}

TEST_CASE("a perception threshold lies in its interval") {
  for (const PerceptionThreshold& threshold : kPerceptionThresholds) {
    if (!threshold.interval_deg) continue;
    CHECK(threshold.interval_deg->first < threshold.mean_deg);
    CHECK(threshold.mean_deg < threshold.interval_deg->second);
  }
}
