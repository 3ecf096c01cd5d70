// workbench tune, run as a process, and the claims of the presets that ship.
#include "core/io/preset_file.h"
#include "core/lab/gains/gain_tuning.h"
#include "core/preset/schema.h"
#include "tests/support/approx.h"
#include "tests/support/paths.h"
#include "tests/support/process.h"
#include "workbench/cli/mesh_options.h"
#include "workbench/cli/mesh_text.h"
#include "workbench/session/exploration_poses.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <thread>

using namespace tangent;
using namespace tangent::testing;
using tangent::test::approx;

namespace {

/// A small mesh and 300 poses that slide over its top.
struct TuneFolder {
  TempFolder folder;
  std::string mesh = folder.file("ball.obj"), preset = folder.file("p.toml");
  TuneFolder() { REQUIRE(run_workbench({"make", "icosphere", "--out", mesh}).exit_code == 0); }

  std::string poses() const {
    std::string text = "t_s,x_m,y_m,z_m\n";
    for (int i = 0; i < 300; ++i) {
      const double a = 1e-4 / 0.059 * i;
      text += std::to_string(1e-3 * i) + "," + std::to_string(0.059 * std::sin(a)) + ",0.001," +
              std::to_string(0.059 * std::cos(a)) + "\n";
    }
    return folder.write("poses.csv", text);
  }
  ProcessResult tune(std::vector<std::string> options) const {
    options.insert(options.begin(), {"tune", mesh, "--out", preset});
    return run_workbench(options);
  }
};

/// [about.also_measured] by key; text and numbers apart.
struct Claims {
  std::map<std::string, double> numbers;
  std::map<std::string, std::string> texts;
  explicit Claims(const PresetAbout& about) {
    for (const auto& [key, value] : about.also_measured) {
      if (const double* number = std::get_if<double>(&value))
        numbers[key] = *number;
      else
        texts[key] = std::get<std::string>(value);
    }
  }
};

PresetFile read(const std::string& path) {
  Result<PresetFile> file = read_preset(path);
  REQUIRE_MESSAGE(file.has_value(), (file ? "" : file.error().message()));
  return *file;
}

/// The scene of an object, by way of the file that `workbench make` writes, as the presets' commands do.
std::shared_ptr<const ContactScene> scene_of_object(const std::string& object) {
  const TempFolder folder;
  std::vector<std::string> make{"make", object, "--out", folder.file(object + ".obj")};
  if (object != "icosphere" && object != "torus") make.insert(make.end(), {"--rounding-mm", "1.5"});
  REQUIRE(run_workbench(make).exit_code == 0);
  MeshOptions options;
  options.file = folder.file(object + ".obj");
  Result<LoadedMesh> loaded = load_mesh(options);
  REQUIRE(loaded);
  auto scene = ContactScene::build(std::move(loaded->mesh));
  REQUIRE(scene);
  return *scene;
}

RunScore score(const std::shared_ptr<const ContactScene>& scene, Preset preset, Method method) {
  preset.solver.method = method;
  Stepper stepper(scene);
  const auto explored = exploration_poses(*scene, preset.finger, ExplorationKind::around, ExplorationPace::varied);
  REQUIRE(explored);
  CHECK(explored->whole());
  return score_run(stepper, preset, explored->poses);
}

/// What a shipped preset says it measured is what comes out.
PresetFile check_claims(const std::string& name, const std::string& object) {
  CAPTURE(name);
  const PresetFile file = read(testing::source_folder() + "/presets/" + name + ".toml");
  const Claims claims(file.about);
  CHECK(file.about.name == name);
  CHECK(contains(claims.texts.at("command"), "workbench tune " + object + ".obj --out presets/" + name + ".toml"));
  const auto scene = scene_of_object(object);
  CHECK(file.about.mesh_hash == hash_text(scene->mesh().content_hash()));
  const Method own = file.preset.solver.method;
  REQUIRE(file.about.measured.has_value());
  const EvidenceNumbers& evidence = file.about.measured->numbers;  // of its own method: checked by check_test.cpp
  CHECK(evidence.unconverged_ticks == 0.0);
  CHECK(evidence.residual_worst_um * 1e-6 < file.preset.solver.tolerance_m);
  for (const Method method : {Method::paper, Method::newton, Method::robust}) {
    if (method == own) continue;
    const std::string prefix = to_string(method) + std::string("_");
    CAPTURE(prefix);
    const RunScore measured = score(scene, file.preset, method);
    MESSAGE(name << ", " << std::string(to_string(method)) << ": mean " << measured.mean_iterations());
    CHECK(static_cast<double>(measured.ticks) == evidence.ticks);
    CHECK(std::abs(measured.mean_iterations() - claims.numbers.at(prefix + "mean_iterations")) < 0.01);
    CHECK(static_cast<double>(measured.unconverged) == claims.numbers.at(prefix + "unconverged_ticks"));
    CHECK(measured.max_error_m < file.preset.solver.tolerance_m);
  }
  return file;
}

}  // namespace

TEST_CASE("a motion that touches nothing is refused, since nothing can be tuned on it") {
  const TuneFolder folder;
  const std::string poses = folder.folder.write("mm.csv", "t_s,x_m,y_m,z_m\n0,59,0,0\n0.001,59,0,1\n");
  for (const bool front : {false, true}) {
    std::vector<std::string> options{"--poses", poses};
    if (front) options.insert(options.end(), {"--objective", "mean_iterations"});
    const ProcessResult done = folder.tune(options);
    CHECK(done.exit_code == 1);
    CHECK(contains(done.err, "mm.csv: the finger touched nothing in 2 of 2 ticks; the nearest it came was 58.9"));
    CHECK(contains(done.err, "no gains can be told apart on such a motion"));
    CHECK_FALSE(std::filesystem::exists(folder.preset));
  }
}

TEST_CASE("a tuning writes a preset that says what it measured and with which command") {
  const TuneFolder t;
  const std::string poses = t.poses();
  const ProcessResult result = t.tune({"--poses", poses, "--tolerance-um", "0.5", "--stiffness-n-per-m", "300"});
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  CHECK(contains(result.out, "untuned   1.00   0.00000"));
  CHECK(contains(result.out, "p.toml written"));
  const PresetFile file = read(t.preset);
  const Claims claims(file.about);
  CHECK(file.preset.solver.method == Method::paper);
  CHECK(file.preset.solver.tolerance_m == 0.5e-6);
  CHECK(file.preset.force.stiffness_n_per_m == 300.0);
  CHECK(file.about.name == "p");
  CHECK(file.about.mesh_name == "ball.obj");
  CHECK(file.about.mesh_hash.size() == 16);
  CHECK(file.about.device == "none");
  CHECK(file.about.date.size() == 10);
  REQUIRE(file.about.measured.has_value());
  const PresetEvidence& evidence = *file.about.measured;
  CHECK(evidence.command == "workbench tune " + t.mesh + " --poses " + poses + " --out " + t.preset +
                                " --tolerance-um 0.5 --stiffness-n-per-m 300");
  CHECK(evidence.mesh.source == "make icosphere");
  CHECK(evidence.mesh.hash == file.about.mesh_hash);
  CHECK(evidence.motion.kind == MotionKind::poses);
  CHECK(evidence.motion.file == "poses.csv");
  CHECK(evidence.numbers.ticks == 300.0);
  CHECK(evidence.numbers.unconverged_ticks == 0.0);
  CHECK(evidence.numbers.residual_worst_um < 0.5);
  CHECK(evidence.numbers.median_solve_ns > 0.0);
  CHECK(run_workbench({"check", t.preset}).exit_code == 0);
  CHECK(evidence.numbers.mean_planes < claims.numbers.at("untuned_mean_iterations"));
  CHECK(claims.numbers.contains("robust_mean_iterations"));
  CHECK(claims.numbers.at("gentle_ground_share") == 1.0);
}

TEST_CASE("the method is the preset's - the gains are those of the paper's iteration all the same") {
  const TuneFolder t;
  const std::string poses = t.poses();
  REQUIRE(t.tune({"--poses", poses}).exit_code == 0);
  const PresetFile paper = read(t.preset);
  REQUIRE(t.tune({"--poses", poses, "--method", "robust"}).exit_code == 0);
  PresetFile robust = read(t.preset);
  CHECK(robust.preset.solver.method == Method::robust);
  CHECK(Claims(robust.about).numbers.contains("paper_mean_iterations"));
  robust.preset.solver.method = Method::paper;
  CHECK(robust.preset == paper.preset);
}

TEST_CASE("tuning what has no gains, or over its own input, is wrong usage") {
  const TuneFolder t;
  const auto refused = [&t](std::vector<std::string> options, const std::string& message) {
    const ProcessResult result = t.tune(std::move(options));
    CAPTURE(result.err);
    CHECK(result.exit_code == 2);
    CHECK(contains(result.err, message));
  };
  refused({"--method", "facet"}, "facet has no gains; allowed: paper, newton or robust");
  for (const PresetKey& key : preset_keys()) {
    if (!key.tuned) continue;
    refused({"--" + std::string(key.option), "0.02"}, "--" + std::string(key.option) + ": is what tune finds");
    refused({"--set", key.full_name() + "=0.02"}, "--set " + key.full_name() + ": is what tune finds");
  }
  refused({"--set", "solver.method=two-pass"}, "two-pass has no gains; allowed: paper, newton or robust");
  refused({"--tolerance-um", "nan"}, "not a finite number");
  refused({"--poses", t.preset}, "names the same file as --poses");
  CHECK(run_workbench({"tune", t.mesh, "--out", t.mesh}).exit_code == 2);
  CHECK(run_workbench({"tune", t.mesh}).exit_code == 2);
  CHECK(t.folder.entry_count() == 1);
}

TEST_CASE("a preset that can't be written, poses and meshes that can't be read leave with 1 and nothing behind") {
  const TuneFolder t;
  const ProcessResult folder = run_workbench({"tune", t.mesh, "--out", t.folder.file("no/p.toml")});
  CHECK(folder.exit_code == 1);
  CHECK(contains(folder.err, "no/p.toml"));
  const ProcessResult poses = t.tune({"--poses", t.folder.file("none.csv")});
  CHECK(poses.exit_code == 1);
  CHECK(contains(poses.err, "none.csv"));
  const ProcessResult mesh = run_workbench({"tune", t.folder.file("none.obj"), "--out", t.preset});
  CHECK(mesh.exit_code == 1);
  CHECK(contains(mesh.err, "none.obj"));
  CHECK(t.folder.entry_count() == 1);
}

TEST_CASE("Ctrl-C keeps the best gains so far, and what was tried, and leaves with 1") {
  const TempFolder folder;
  const std::string mesh = folder.file("cube.obj"), preset = folder.file("p.toml");
  REQUIRE(run_workbench({"make", "cube", "--rounding-mm", "1.5", "--out", mesh}).exit_code == 0);
  const auto tried = [&] {  // lines of what is kept: whose it is, and one for each run that is complete
    const std::string kept = std::filesystem::exists(preset + ".tuning") ? read_text(preset + ".tuning") : "";
    return std::count(kept.begin(), kept.end(), '\n') - 1;
  };
  // Interrupted when something was tried; one that came to its end before Ctrl-C reached it is begun anew.
  bool interrupted = false;
  for (int i = 0; i < 100 && !interrupted; ++i) {
    std::filesystem::remove(preset);
    const auto before = std::max<std::ptrdiff_t>(tried(), 0);
    const Process process({"tune", mesh, "--out", preset});
    while (tried() <= before && !process.ended()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    process.interrupt();
    const ProcessResult result = process.wait();
    CAPTURE(result.err);
    if (result.exit_code == 0) continue;
    REQUIRE(result.exit_code == 1);
    if (contains(result.err, "nothing is written")) continue;  // what was tried is kept: the next one gets further
    interrupted = true;
    CHECK(contains(result.err, "interrupted; " + preset + " holds the best of the "));
    CHECK(contains(result.err, "the same command goes on from there"));
    CHECK(contains(read(preset).about.note, "interrupted"));
    CHECK(std::filesystem::exists(preset + ".tuning"));
  }
  CHECK(std::filesystem::exists(preset));
}

TEST_CASE("exploration poses are the same every time, 1 ms apart, and press, at the speed and depth of their pace") {
  const auto scene = scene_of_object("cube");
  const Finger finger;
  for (const ExplorationKind kind : {ExplorationKind::around, ExplorationKind::strokes}) {
    for (const ExplorationPace pace : {ExplorationPace::steady, ExplorationPace::varied}) {
      const auto a = exploration_poses(*scene, finger, kind, pace), b = exploration_poses(*scene, finger, kind, pace);
      REQUIRE(a);
      REQUIRE(a->poses.size() == b->poses.size());
      CHECK(a->whole());
      CHECK(a->press_m == kExplorationPress);
      double slowest = 1.0, fastest = 0.0;
      constexpr std::size_t kStretch = 20;  // ticks: corners of the path are rounded within less
      for (std::size_t i = kStretch; i < a->poses.size(); ++i) {
        CHECK(a->poses[i].finger.position == b->poses[i].finger.position);
        CHECK(a->poses[i].t_s - a->poses[i - 1].t_s == approx(1e-3));
        double length = 0.0;
        for (std::size_t j = i - kStretch + 1; j <= i; ++j)
          length += glm::length(a->poses[j].finger.position - a->poses[j - 1].finger.position);
        slowest = std::min(slowest, length / (1e-3 * kStretch));
        fastest = std::max(fastest, length / (1e-3 * kStretch));
      }
      MESSAGE(std::string(kExplorationNames[static_cast<std::size_t>(kind)])
              << ": " << slowest << " to " << fastest << " m/s");
      const bool varied = pace == ExplorationPace::varied;
      CHECK(slowest == approx(varied ? 0.05 : 0.1).epsilon(0.2));
      CHECK(fastest == approx(varied ? 0.15 : 0.1).epsilon(0.2));
    }
  }
}

TEST_CASE("the varied pace goes over all depths from 0.4 to 1.6 mm, at every speed") {
  const auto scene = scene_of_object("sphere");
  const Finger finger;
  const auto explored = exploration_poses(*scene, finger, ExplorationKind::strokes, ExplorationPace::varied);
  REQUIRE(explored);
  std::map<std::pair<int, int>, int> met;  // deep or shallow, fast or slow
  double deepest = 0.0, shallowest = 1.0;
  for (std::size_t i = 1; i < explored->poses.size(); ++i) {
    const Vec3 at = explored->poses[i].finger.position, from = explored->poses[i - 1].finger.position;
    const double depth = finger.radius_m - scene->nearest().nearest(at - scene->mesh().origin(), 1.0).distance_m;
    deepest = std::max(deepest, depth);
    shallowest = std::min(shallowest, depth);
    ++met[{depth > 1e-3, glm::length(at - from) > 1e-4}];
  }
  CHECK(deepest == approx(1.6e-3).epsilon(0.03));
  CHECK(shallowest == approx(0.4e-3).epsilon(0.05));
  for (const int deep : {0, 1})
    for (const int fast : {0, 1}) CHECK(met[{deep, fast}] > static_cast<int>(explored->poses.size()) / 10);
}

TEST_CASE("a varied depth tells the gain of the distance from the overall one, a constant depth hardly does") {
  const auto scene = scene_of_object("cube");
  const auto mean = [&](ExplorationPace pace, const Gains& gains) {
    Preset preset;
    preset.solver = with_gains(preset.solver, gains);
    preset.solver.method = Method::paper;
    Stepper stepper(scene);
    const auto explored = exploration_poses(*scene, preset.finger, ExplorationKind::strokes, pace);
    REQUIRE(explored);
    return score_run(stepper, preset, explored->poses).mean_iterations();
  };
  // Eq. 1 divides G_o by 1 + G_d d: at d = 1 mm these two are the same.
  const Gains without{1.0, 0.019, 0.0}, with{1.1, 0.019, 100.0};
  const double constant = std::abs(mean(ExplorationPace::steady, without) - mean(ExplorationPace::steady, with)),
               varied = std::abs(mean(ExplorationPace::varied, without) - mean(ExplorationPace::varied, with));
  MESSAGE("the same factor at 1 mm by G_o alone or with G_d: " << constant << " planes apart at constant depth, "
                                                               << varied << " at varied");
  CHECK(varied > 2.0 * constant);
}

TEST_CASE("tune explores in strokes where asked, and says so in the preset") {
  const TuneFolder t;
  const ProcessResult result = t.tune({"--path", "strokes"});
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const PresetFile file = read(t.preset);
  const Claims claims(file.about);
  REQUIRE(file.about.measured.has_value());
  CHECK(contains(file.about.measured->command, " --path strokes"));
  CHECK(file.about.measured->motion.kind == MotionKind::strokes);
  CHECK(run_workbench({"check", t.preset}).exit_code == 0);
  CHECK(contains(claims.texts.at("poses"), "strokes, 0.05 to 0.15 m/s, 0.4 to 1.6 mm deep"));
  CHECK(file.about.measured->numbers.unconverged_ticks == 0.0);
  const TempFolder folder;
  const std::string torus = folder.file("torus.obj");
  REQUIRE(run_workbench({"make", "torus", "--out", torus}).exit_code == 0);
  const ProcessResult hole =
      run_workbench({"tune", torus, "--path", "strokes", "--finger-radius-mm", "2", "--out", folder.file("p.toml")});
  CHECK(hole.exit_code == 1);
  CHECK(contains(hole.err, "explore it around instead of in strokes"));
  CHECK(folder.entry_count() == 1);
  CHECK(t.tune({"--path", "zigzag"}).exit_code == 2);
}

TEST_CASE("presets of the paper's objects measure what they say") {
  for (const char* object : {"cone", "cylinder", "cube", "sphere", "tetrahedron", "octagon", "triangle", "hexagon"}) {
    const PresetFile file = check_claims(object, object);
    CHECK(file.preset.solver.method == Method::paper);
    CHECK(file.preset.finger == Finger{});
  }
}

TEST_CASE("the default preset is robust, carries tuned gains and measures what it says") {
  const PresetFile file = check_claims("default", "torus");
  CHECK(file.preset.solver.method == Method::robust);
}

TEST_CASE(
    "320 triangles of a sphere take at most 1.5 iterations a tick with the gains that ship, every tick below 1 um") {
  const auto scene = scene_of_object("icosphere");
  REQUIRE(scene->mesh().triangle_count() == 320);
  for (const std::string name : {"sphere", "default"}) {
    const Preset preset = read(testing::source_folder() + "/presets/" + name + ".toml").preset;
    const RunScore run = score(scene, preset, preset.solver.method);
    MESSAGE(name << ", " << std::string(to_string(preset.solver.method)) << ": mean " << run.mean_iterations());
    CHECK(run.unconverged == 0);
    CHECK(run.max_error_m < 1e-6);
    CHECK(run.mean_iterations() <= 1.5);
  }
}
