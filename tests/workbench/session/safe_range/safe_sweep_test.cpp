// Safe ranges: lines of verdicts, what is kept of them, and threads.
#include "workbench/session/safe_range/safe_sweep.h"
#include "tests/workbench/session/session_fixture.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

using namespace tangent;
using namespace tangent::test;

namespace {

const PresetKey& key_of(const char* name) {
  const PresetKey* key = find_preset_key(name);
  REQUIRE(key != nullptr);
  return *key;
}

/// Stable below `limit` N/m, shakes from twice that on.
JudgePreset below(double limit, int* asked = nullptr) {
  return [=](const Preset& preset) -> std::optional<Verdict> {
    if (asked != nullptr) ++*asked;
    const double k = preset.force.stiffness_n_per_m;
    return Verdict{.safety = k < limit ? Safety::stable : k >= 2.0 * limit ? Safety::shakes : Safety::unknown};
  };
}

/// A device without friction and steps: a loop that shakes is not held by them.
TrialGround bare(const std::shared_ptr<const ContactScene>& scene) {
  TrialGround ground{scene, {}};
  ground.device.friction_n = ground.device.step_m = 0.0;
  return ground;
}

std::filesystem::path fresh(const char* name) {
  const auto path = std::filesystem::temp_directory_path() / "tangent_safe_range" / name;
  std::filesystem::remove(path);
  return path;
}

}  // namespace

TEST_CASE("a line finds where a value begins to shake, and says nothing of what lies between") {
  const PresetKey& stiffness = key_of("force.stiffness_n_per_m");
  int asked = 0;
  const SafeRange range = sweep_line({}, stiffness, below(1300.0, &asked));
  CHECK(asked == static_cast<int>(range.samples().size()));
  CHECK(range.at(800.0) == Safety::stable);
  CHECK(range.at(1300.0) == Safety::unknown);
  CHECK(range.at(stiffness.slider_max * 1.01) == Safety::unknown);
  double stable_to = 0.0, shakes_from = 1e9;
  for (const RangePiece& piece : range.pieces()) {
    if (piece.safety == Safety::stable) stable_to = std::max(stable_to, piece.to);
    if (piece.safety == Safety::shakes) shakes_from = std::min(shakes_from, piece.from);
    CHECK(piece.to > piece.from);
    const double middle = 0.5 * (piece.from + piece.to);
    CHECK(range.at(middle) == piece.safety);
  }
  MESSAGE("stable to " << stable_to << ", shakes from " << shakes_from << " N/m, " << asked << " presets");
  CHECK(stable_to < 1300.0);
  CHECK(stable_to > 1000.0);
  CHECK(shakes_from >= 2600.0);
  CHECK(range_words(range, [](double v) { return std::to_string(static_cast<int>(v)); }).starts_with("stable from"));
}

TEST_CASE("choices are judged each by itself, whole numbers stay whole, and a cancelled line is none") {
  const SafeRange methods = sweep_line({}, key_of("solver.method"), [](const Preset& preset) -> std::optional<Verdict> {
    return Verdict{.safety = preset.solver.method == Method::paper ? Safety::shakes : Safety::stable};
  });
  CHECK(methods.samples().size() == kMethodNames.size());
  CHECK(methods.at(0.0) == Safety::shakes);
  CHECK(methods.at(2.0) == Safety::stable);
  CHECK(methods.pieces().front() == RangePiece{-0.5, 0.5, Safety::shakes});
  const PresetKey& iterations = key_of("solver.max_iterations");
  const SafeRange whole = sweep_line({}, iterations, [](const Preset& preset) -> std::optional<Verdict> {
    CHECK(preset.solver.max_iterations >= 1);
    return Verdict{.safety = preset.solver.max_iterations < 7 ? Safety::unknown : Safety::stable};
  });
  for (const SafeRange::Sample& sample : whole.samples()) CHECK(sample.value == std::round(sample.value));
  int left = 3;
  CHECK(sweep_line({}, iterations,
                   [&](const Preset&) -> std::optional<Verdict> {
                     return left-- > 0 ? std::optional(Verdict{}) : std::nullopt;
                   })
            .samples()
            .empty());
}

TEST_CASE("what pushes or shakes has a range, and what the loop does not read has none") {
  const auto keys = keys_with_range({}, false);
  const auto has = [&](const char* name) { return std::count(keys.begin(), keys.end(), find_preset_key(name)) == 1; };
  for (const char* name : {"force.stiffness_n_per_m", "force.damping_n_s_per_m", "force.limit_n", "force.blend",
                           "solver.method", "solver.tolerance_m", "solver.switch_hysteresis_m"}) {
    CAPTURE(name);
    CHECK(has(name));
  }
  CHECK_FALSE(has("display.travel_m"));
  CHECK_FALSE(has("finger.radius_m"));
  CHECK_FALSE(has("solver.local_centre"));
  Preset paper;
  paper.solver.method = Method::paper;
  const auto of_paper = keys_with_range(paper, false);
  CHECK(std::count(of_paper.begin(), of_paper.end(), find_preset_key("solver.gain_curvature_m")) == 1);
}

TEST_CASE("a verdict hangs on scene, device and every value in the loop, and on no value outside it") {
  const TrialDevice device;
  const std::uint64_t here = trial_key(1, device, {});
  CHECK(trial_key(2, device, {}) != here);
  for (double TrialDevice::*member : {&TrialDevice::mass_kg, &TrialDevice::friction_n, &TrialDevice::step_m,
                                      &TrialDevice::rate_hz, &TrialDevice::scale}) {
    TrialDevice other = device;
    other.*member *= 1.5;
    CHECK(trial_key(1, other, {}) != here);
  }
  for (const PresetKey& key : preset_keys()) {
    Preset other;
    const double value = key.get(other);
    key.set(other, value == key.min ? key.max : key.min);
    if (key.get(other) == value) continue;
    CAPTURE(key.full_name());
    CHECK((trial_key(1, device, other) != here) == is_in_loop(key));
    CHECK(same_loop(other, {}) != is_in_loop(key));
  }
  CHECK(trial_scene_hash(*sphere_scene()) != trial_scene_hash(*torus_scene()));
}

TEST_CASE("verdicts come back from their file, and a damaged one is refused whole") {
  const auto path = fresh("verdicts.txt");
  VerdictStore written;
  for (std::uint64_t i = 0; i < 100; ++i)
    written.put(i * 0x9E3779B97F4A7C15u, {static_cast<Safety>(i % 3), static_cast<std::uint8_t>(i % kTouchPlaces),
                                          static_cast<std::uint8_t>(i % 4), static_cast<UndoneBecause>(i % 4)});
  REQUIRE(written.write(path));
  VerdictStore other;
  other.put(7, {Safety::shakes, 1, 1, UndoneBecause::none});
  REQUIRE(other.write(path));  // another program's stay
  VerdictStore back;
  REQUIRE(back.read(path));
  CHECK(back.size() == 101);
  for (std::uint64_t i = 0; i < 100; ++i)
    CHECK(*back.find(i * 0x9E3779B97F4A7C15u) == *written.find(i * 0x9E3779B97F4A7C15u));
  std::ifstream in(path, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  std::string changed = whole;
  for (const std::string& bad : {whole.substr(0, whole.size() - 3), std::string("something else\n"), whole + "x",
                                 (changed[whole.size() - 5] = '9', changed)}) {
    std::ofstream(path, std::ios::binary) << bad;
    VerdictStore none;
    const Status read = none.read(path);
    REQUIRE_FALSE(read);
    CHECK(read.error().message().find("swept again") != std::string::npos);
    CHECK(none.size() == 0);
  }
  VerdictStore missing;
  CHECK(missing.read(fresh("not-there.txt")));
}

TEST_CASE("a sweep gives the same ranges on one thread and on three, and a restart knows them") {
  const auto path = fresh("restart.txt");
  const TrialGround ground = bare(torus_scene());
  const std::vector<const PresetKey*> keys{&key_of("force.stiffness_n_per_m"), &key_of("force.damping_n_s_per_m"),
                                           &key_of("force.blend")};
  Preset base;
  base.force.stiffness_n_per_m = 300.0;
  std::vector<SafeRange> first;
  {
    SafeSweep sweep(path);
    sweep.start(ground, base, keys, 1);
    sweep.wait();
    CHECK(sweep.done_lines() == keys.size());
    for (const PresetKey* key : keys) first.push_back(sweep.range(*key));
    CHECK(sweep.known(base).safety == Safety::stable);
  }
  CHECK(first[0].at(300.0) == Safety::stable);
  CHECK(first[0].at(3500.0) != Safety::stable);
  SafeSweep threads;
  threads.start(ground, base, keys, 3);
  threads.wait();
  SafeSweep restarted(path);
  restarted.start(ground, base, keys, 1);
  restarted.wait();
  for (std::size_t i = 0; i < keys.size(); ++i) {
    CHECK(threads.range(*keys[i]) == first[i]);
    CHECK(restarted.range(*keys[i]) == first[i]);
  }
}

TEST_CASE("verdicts in the file are those of one build of the program, another one judges anew") {
  const auto path = fresh("builds.txt");
  const auto verdicts_after = [&](const char* build) {
    SafeSweep sweep(path, build);
    sweep.start(bare(torus_scene()), {}, {&key_of("force.blend")});
    sweep.wait();
    VerdictStore kept;
    REQUIRE(kept.read(path));
    return kept.size();
  };
  const std::size_t of_one = verdicts_after("one");
  CHECK(of_one > 0);
  CHECK(verdicts_after("one") == of_one);
  CHECK(verdicts_after("two") == 2 * of_one);
}

TEST_CASE("a scene whose parts and hierarchy are not built yet is judged as one that is whole") {
  const auto mesh = [] { return *ContactMesh::build(make_icosphere(0.040, 3), {}); };
  const auto whole = *ContactScene::build(mesh());
  const auto late =
      *ContactScene::build(mesh(), {.hierarchy = false, .ribbon = false, .far_parts = false, .whole_up_to = 100});
  REQUIRE(late->unbuilt_parts() > 0);
  PresetTrials of_whole(bare(whole)), of_late(bare(late));
  for (const Method method : {Method::facet, Method::robust}) {  // facets read no hierarchy
    Preset preset;
    preset.solver.method = method;
    preset.force.stiffness_n_per_m = 200.0;
    CAPTURE(to_string(method));
    CHECK(of_late.judge(preset) == of_whole.judge(preset));
    CHECK(of_late.judge(preset)->safety != Safety::unknown);
  }
}

TEST_CASE("another value than a line's own makes its line unknown, its own does not, another mesh all of them") {
  const PresetKey &stiffness = key_of("force.stiffness_n_per_m"), &blend = key_of("force.blend");
  SafeSweep sweep;
  Preset base;
  base.force.stiffness_n_per_m = 300.0;
  sweep.start(bare(torus_scene()), base, {&blend}, 1);
  sweep.wait();
  Preset off = base, stiffer = base;
  off.force.blend = ForceBlend::off;
  stiffer.force.stiffness_n_per_m = 301.0;
  CHECK(sweep.known(off).safety == Safety::stable);
  CHECK(sweep.known(stiffer).safety == Safety::unknown);
  sweep.ask(stiffer);
  sweep.wait();
  CHECK(sweep.known(stiffer).safety == Safety::stable);
  sweep.start(bare(torus_scene()), stiffer, {&stiffness}, 1);
  sweep.cancel();
  CHECK(sweep.range(blend).samples().empty());
  CHECK_FALSE(sweep.running());
  sweep.start(bare(sphere_scene()), base, {&blend}, 1);
  sweep.cancel();
  CHECK(sweep.known(stiffer).safety == Safety::unknown);
}

TEST_CASE("measure all lines of the built-in scene" * doctest::skip()) {
  for (const bool frictionless : {false, true}) {
    const auto began = std::chrono::steady_clock::now();
    SafeSweep sweep;
    const TrialGround ground = frictionless ? bare(torus_scene()) : TrialGround{torus_scene(), {}};
    sweep.start(ground, {});
    sweep.wait();
    const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    std::size_t presets = 0;
    for (const PresetKey* key : keys_with_range({}, false)) {
      const SafeRange range = sweep.range(*key);
      presets += range.samples().size();
      MESSAGE(key->full_name() << ": " << range_words(range, [key](double v) { return key->value_text(v); }));
    }
    MESSAGE((frictionless ? "ideal" : "simulated")
            << ": " << sweep.lines() << " values, " << presets << " presets, " << s << " s");
  }
}
