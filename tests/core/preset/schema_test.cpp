#include "core/preset/schema.h"

#include "core/lab/measure/perception_thresholds.h"
#include "core/lab/objects/generate.h"
#include "core/tick/step.h"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace tangent;

namespace {

using Bytes = std::array<unsigned char, sizeof(Preset)>;

Bytes bytes_of(const Preset& preset) {
  Bytes bytes{};
  std::memcpy(bytes.data(), &preset, sizeof preset);
  return bytes;
}

/// 1 where a byte belongs to a value, 0 in the padding between them.
Bytes bytes_of_values() {
  Preset preset;
  std::memset(static_cast<void*>(&preset), 0xFF, sizeof preset);
  __builtin_clear_padding(&preset);
  Bytes bytes = bytes_of(preset);
  for (unsigned char& byte : bytes) byte = byte != 0 ? 1 : 0;
  return bytes;
}

/// Two values of a row that differ in every byte of its field.
std::pair<double, double> unlike_values(const PresetKey& row) {
  switch (row.kind) {
    case KeyKind::integer:
      return {0x01010101, 0x02020202};
    case KeyKind::choice:
      return {0.0, 1.0};
    default:
      return {std::bit_cast<double>(0x3F01010101010101u), std::bit_cast<double>(0x4002020202020202u)};
  }
}

/// A value of the row that is allowed and not the default.
double other_value(const PresetKey& row) { return row.default_value() == row.max ? row.min : row.max; }

}  // namespace

TEST_CASE("every field of Preset has one row in the schema and no two rows share one") {
  // A byte that no row writes belongs to a field that nobody can set: it needs a row in core/preset/schema.cpp.
  Bytes rows{};
  for (const PresetKey& row : preset_keys()) {
    const auto [one, other] = unlike_values(row);
    Preset preset;
    row.set(preset, one);
    const Bytes before = bytes_of(preset);
    row.set(preset, other);
    const Bytes after = bytes_of(preset);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] += before[i] != after[i];
  }
  const Bytes values = bytes_of_values();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CAPTURE(i);
    CHECK(int(rows[i]) == int(values[i]));
  }
}

TEST_CASE("rows stand table by table, in the order of the tables, and each table has some") {
  std::size_t table = 0, rows = 0;
  for (const PresetKey& row : preset_keys()) {
    CAPTURE(row.full_name());
    if (row.table != preset_tables()[table].name) {
      CHECK(rows > 0);
      rows = 0;
      REQUIRE(++table < preset_tables().size());
    }
    CHECK(row.table == preset_tables()[table].name);
    ++rows;
  }
  CHECK(table + 1 == preset_tables().size());
  std::set<std::string_view> titles;
  for (const PresetTable& t : preset_tables()) CHECK(titles.insert(t.title).second);
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
    CHECK(find_preset_key(key.full_name()) == &key);
  }
  for (const char* wrong : {"", ".", "solver", "solver.", ".method", "solver.method.x", "method"})
    CHECK(find_preset_key(wrong) == nullptr);
  CHECK(find_preset_key("solver", "gain") == nullptr);
  CHECK(find_preset_key("force", "gain_overall") == nullptr);
}

TEST_CASE("setting a key changes that key and no other") {
  for (const PresetKey& changed : preset_keys()) {
    Preset preset;
    const double value = other_value(changed);
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

TEST_CASE("the same to a method are presets that differ in nothing it reads") {
  for (const PresetKey& row : preset_keys()) {
    CAPTURE(row.full_name());
    for (std::size_t m = 0; m < kMethodNames.size(); ++m) {
      Preset one, other;
      one.solver.method = other.solver.method = static_cast<Method>(m);
      CHECK(same_for_solver(one, other));
      const bool names_method = row.get == find_preset_key("solver", "method")->get;
      row.set(other, names_method ? static_cast<double>((m + 1) % kMethodNames.size()) : other_value(row));
      CHECK(same_for_solver(one, other) == !row.read_by.has(static_cast<Method>(m)));
      CHECK(same_for_solver(other, one) == same_for_solver(one, other));
    }
  }
  // Force, display and safety are applied after the contact is found; the gains belong to one method.
  for (const PresetKey& row : preset_keys()) {
    CAPTURE(row.full_name());
    CHECK((row.read_by == kNoMethod) == (row.table != "solver" && row.table != "finger" && row.key != "contacts"));
    if (row.tuned) CHECK(row.read_by == only(Method::paper));
  }
}

TEST_CASE("a value that a method does not read leaves its contacts as they are, bit for bit") {
  const auto scene = ContactScene::build(*ContactMesh::build(make_icosphere(0.04, 2)));
  REQUIRE(scene);
  const auto contacts = [&](const Preset& preset) {
    Stepper stepper(*scene);
    TickState state;
    std::vector<double> numbers;
    for (int i = 0; i < 40; ++i) {
      const double angle = 0.01 * i;
      TickInput input{1e-3 * i, {0.059 * Vec3(std::sin(angle), 0.3 * std::sin(angle), std::cos(angle)), {}}};
      const TickOutput out = stepper.step(preset, input, state);
      numbers.insert(numbers.end(), {out.contact.x, out.contact.y, out.contact.z, out.normal.x, out.normal.y,
                                     out.normal.z, out.penetration_m, out.error_m, double(out.iterations)});
    }
    return numbers;
  };
  std::size_t compared = 0;
  for (std::size_t m = 0; m < kMethodNames.size(); ++m) {
    Preset preset;
    preset.solver.method = static_cast<Method>(m);
    const std::vector<double> expected = contacts(preset);
    for (const PresetKey& row : preset_keys()) {
      if (row.read_by.has(preset.solver.method)) continue;
      CAPTURE(m);
      CAPTURE(row.full_name());
      Preset changed = preset;
      row.set(changed, other_value(row));
      CHECK(contacts(changed) == expected);
      ++compared;
    }
    Preset gains = preset;
    gains.solver.gain_overall = 0.5;
    CHECK((contacts(gains) == expected) == (preset.solver.method != Method::paper));
  }
  CHECK(compared > 100);
}

TEST_CASE("a perception threshold lies in its interval") {
  for (const PerceptionThreshold& threshold : kPerceptionThresholds) {
    if (!threshold.interval_deg) continue;
    CHECK(threshold.interval_deg->first < threshold.mean_deg);
    CHECK(threshold.mean_deg < threshold.interval_deg->second);
  }
}
