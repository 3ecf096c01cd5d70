// Evidence of presets: what is found when something changed, and no alarm where nothing did.
#include "tests/workbench/evidence/evidence_fixture.h"
#include "workbench/evidence/made_mesh.h"

#include <functional>
#include <vector>

using namespace tangent;
using namespace tangent::testing;

namespace {

/// Something that goes wrong with a preset or with what it names.
struct EvidenceFault {
  const char* name;
  std::function<void(EvidenceFolder&)> make;
};

/// Changes the preset's file, but not its evidence's numbers.
EvidenceFault in_preset(const char* name, std::function<void(PresetFile&)> change) {
  return {name, [change = std::move(change)](EvidenceFolder& f) {
            PresetFile file = f.read();
            change(file);
            f.write(file);
          }};
}

EvidenceFault in_evidence_of(const char* name, std::function<void(PresetEvidence&)> change) {
  return in_preset(name, [change = std::move(change)](PresetFile& file) { change(*file.about.measured); });
}

/// Replaces text of the pose file once, from its middle on.
EvidenceFault in_poses(const char* name, const std::string& from, const std::string& to) {
  return {name, [from, to](EvidenceFolder& f) {
            std::string text = read_text(f.folder.file("poses.csv"));
            const std::size_t at = text.find(from, text.size() / 2);
            REQUIRE(at != std::string::npos);
            f.folder.write("poses.csv", text.replace(at, from.size(), to));
          }};
}

/// The numbers of the same preset with another value in it.
void take_stale_numbers(EvidenceFolder& f) {
  const PresetFile file = f.read();
  PresetFile other = file;
  other.preset.solver.gain_curvature_m *= 1.3;
  f.attach(other, *file.about.measured);
  PresetFile stale = f.read();
  stale.preset = file.preset;
  stale.about.measured->values = file.about.measured->values;
  f.write(stale);
}

void move_a_vertex(EvidenceFolder& f) {
  Result<PolygonMesh> mesh = read_mesh(f.folder.file("ball.obj"), 1e-3);
  REQUIRE(mesh);
  mesh->positions[5].z += 1e-9;
  REQUIRE(write_obj(*mesh, f.folder.file("ball.obj"), 1e-3));
}

void edit_the_time(EvidenceFolder& f) {
  std::string text = read_text(f.preset);
  const std::size_t at = text.find("median_solve_ns = ") + 18;
  REQUIRE(at < text.size());
  f.folder.write("p.toml", text.replace(at, text.find('\n', at) - at, "1.0"));
}

std::vector<EvidenceFault> faults() {
  return {
      in_preset("G_k edited", [](PresetFile& p) { p.preset.solver.gain_curvature_m += 0.0001; }),
      in_preset("G_o edited", [](PresetFile& p) { p.preset.solver.gain_overall += 0.01; }),
      in_preset("tolerance edited", [](PresetFile& p) { p.preset.solver.tolerance_m = 1.1e-6; }),
      in_preset("other method", [](PresetFile& p) { p.preset.solver.method = Method::newton; }),
      in_preset("other finger radius", [](PresetFile& p) { p.preset.finger.radius_m += 1e-5; }),
      in_preset("other finger shape", [](PresetFile& p) { p.preset.finger.shape = FingerShape::capsule; }),
      in_preset("stiffness edited", [](PresetFile& p) { p.preset.force.stiffness_n_per_m += 1.0; }),
      in_preset("display edited", [](PresetFile& p) { p.preset.display.travel_m *= 0.9; }),
      in_preset("a gain edited in both places",
                [](PresetFile& p) {
                  p.about.measured->values.solver.gain_curvature_m = p.preset.solver.gain_curvature_m *= 1.2;
                }),
      {"other mesh", [](EvidenceFolder& f) { f.write_ball(f.folder.file("ball.obj")); }},
      {"a vertex moved by a nanometre", move_a_vertex},
      in_evidence_of("mesh read in other units", [](PresetEvidence& e) { e.mesh.metres_per_unit = 1.01e-3; }),
      in_poses("a digit of a pose", "0.0", "0.1"),
      {"another pose file", [](EvidenceFolder& f) { f.write_poses("poses.csv", 150); }},
      {"a pose file that is gone", [](EvidenceFolder& f) { std::filesystem::remove(f.folder.file("poses.csv")); }},
      {"numbers of another gain", take_stale_numbers},
      in_evidence_of("a count edited", [](PresetEvidence& e) { e.numbers.unconverged_ticks += 1.0; }),
      in_evidence_of("an error of another version",
                     [](PresetEvidence& e) {
                       e.program_version = "0.0.9";
                       e.build = "g++ 9.4.0";
                       e.numbers.error_worst_um *= 1.001;
                     }),
      in_evidence_of("a made motion of another version",
                     [](PresetEvidence& e) {
                       e.motion.kind = MotionKind::around;
                       e.motion.file.clear();
                       e.motion.version = 99.0;
                     }),
      {"the time of a tick edited", edit_the_time},
  };
}

}  // namespace

TEST_CASE("all 20 kinds of faults in presets and what they name are found") {
  constexpr unsigned kSeeds = 5;
  std::size_t found_kinds = 0;
  const std::vector<EvidenceFault> kinds = faults();
  for (const EvidenceFault& fault : kinds) {
    CAPTURE(fault.name);
    unsigned found = 0;
    for (unsigned seed = 0; seed < kSeeds; ++seed) {
      EvidenceFolder f(seed);
      REQUIRE(f.check().outcome == CheckOutcome::holds);
      fault.make(f);
      if (f.check().outcome != CheckOutcome::holds) ++found;
    }
    CHECK(found == kSeeds);
    if (found == kSeeds) ++found_kinds;
  }
  MESSAGE(found_kinds << " of " << kinds.size() << " kinds of faults found, each in " << kSeeds << " presets");
  CHECK(kinds.size() == 20);
  CHECK(found_kinds == 20);
}

TEST_CASE("a hundred presets that are as they were raise no alarm, wherever they lie and whichever build looks") {
  constexpr unsigned kPresets = 100;
  unsigned alarms = 0;
  for (unsigned seed = 0; seed < kPresets; ++seed) {
    CAPTURE(seed);
    EvidenceFolder f(1000 + seed, static_cast<Method>(seed % kMethodNames.size()));
    PresetFile file = f.read();
    if (seed % 2 == 1) file.about.measured->build = "another build";
    if (seed % 3 == 1) file.about.note = "read, changed in its note and written again";
    f.write(file);
    const TempFolder elsewhere;
    const std::filesystem::path moved = elsewhere.path() / "moved";
    std::filesystem::copy(f.folder.path(), moved);
    const PresetCheck check = EvidenceFolder::check_of(moved / "p.toml");
    if (check.outcome == CheckOutcome::holds) continue;
    ++alarms;
    FAIL_CHECK(check_text(check));
  }
  MESSAGE(alarms << " false alarms in " << kPresets << " presets");
}

TEST_CASE("a change is told by what and how much") {
  EvidenceFolder f(3);
  PresetFile file = f.read();
  const double measured = file.preset.solver.gain_curvature_m;
  file.preset.solver.gain_curvature_m = 0.05;
  f.write(file);
  const PresetCheck check = f.check();
  CHECK(check.outcome == CheckOutcome::changed);
  REQUIRE_FALSE(check.differences.empty());
  const PresetKey& key = *find_preset_key("solver", "gain_curvature_m");
  CHECK(check.differences[0].what == "solver.gain_curvature_m");
  CHECK(check.differences[0].measured == key.value_text(measured));
  CHECK(check.differences[0].now == "0.05");
  CHECK(contains(check_text(check), "mean_planes: "));
  CHECK(check.now.mean_planes > 0.0);
  CHECK(check.same_build);
}

TEST_CASE("errors of another build may differ by rounding, those of the same build not by a bit") {
  EvidenceFolder f(4);
  PresetFile file = f.read();
  EvidenceNumbers& numbers = file.about.measured->numbers;
  REQUIRE(numbers.error_worst_um > 0.01);
  numbers.force_mean_n = std::nextafter(numbers.force_mean_n, 10.0);
  f.write(file);
  CHECK(f.check().outcome == CheckOutcome::changed);
  file.about.measured->build = "another build";
  f.write(file);
  CHECK(f.check().outcome == CheckOutcome::holds);
  numbers.force_mean_n *= 1.0 + 3.0 * kRoundingShare;
  numbers.force_mean_n += 3.0 * kRoundingFloor;
  f.write(file);
  CHECK(f.check().outcome == CheckOutcome::changed);
}

TEST_CASE("what can't be checked says why") {
  EvidenceFolder f(5);
  PresetFile file = f.read();
  std::filesystem::remove(f.folder.file("ball.obj"));
  CHECK(contains(f.check().why, "ball.obj: is not there"));
  file.about.measured->mesh.source = "make teapot";
  f.write(file);
  CHECK(f.check().outcome == CheckOutcome::impossible);
  CHECK(contains(f.check().why, "teapot"));
  file.about.measured->mesh.source = "/dev/zero";
  f.write(file);
  CHECK(contains(f.check().why, "/dev/zero: is no file that can be read again"));
  file.about.measured.reset();
  f.write(file);
  CHECK(contains(f.check().why, "names nothing that could be measured again"));
  CHECK(contains(EvidenceFolder::check_of(f.folder.file("none.toml")).why, "none.toml: can't be opened"));
}

TEST_CASE("an edited number of the evidence is told even where nobody can measure it again") {
  EvidenceFolder f(7);
  const std::string sealed = read_text(f.preset);
  REQUIRE(contains(sealed, "\ndigest = \""));
  edit_the_time(f);
  const PresetCheck check = f.check();
  CHECK(check.outcome == CheckOutcome::changed);
  REQUIRE(check.differences.size() == 1);
  CHECK(check.differences[0].what == "about.measured.digest");
  f.write(f.read());  // a program that reads it and writes it again does not make it true
  CHECK(f.check().outcome == CheckOutcome::changed);

  std::string bare = sealed;
  const std::size_t at = bare.find("\ndigest = ");
  f.folder.write("p.toml", bare.erase(at, bare.find('\n', at + 1) - at));
  CHECK(contains(f.check().why, "the key digest is missing"));
  std::string older = bare.replace(bare.find("format = 3"), 10, "format = 2");  // which had no digest
  f.folder.write("p.toml", older);
  CHECK(f.check().outcome == CheckOutcome::holds);
  f.write(f.read());
  CHECK(read_text(f.preset) == sealed);

  std::string moved = sealed;
  REQUIRE(std::filesystem::create_directory(f.folder.path() / "there"));
  std::filesystem::rename(f.folder.file("poses.csv"), f.folder.path() / "there" / "poses.csv");
  f.folder.write("p.toml", moved.replace(moved.find("\"poses.csv\""), 11, "\"there/poses.csv\""));
  CHECK(f.check().outcome == CheckOutcome::holds);
}

TEST_CASE("a check stops at once where it is told to") {
  const EvidenceFolder f(6);
  int asked = 0;
  CHECK_FALSE(check_preset_file(f.preset, {.folder = {}, .timed = false, .keep_going = [&] { return ++asked < 2; }}));
  CHECK(asked == 2);
}

TEST_CASE("a mesh whose file says how make made it is named by that, if that makes it") {
  const TempFolder folder;
  const MadeMesh octagon{"octagon", {.segments = 3, .rounding_m = 1.5e-3, .facing = Facing::left}};
  CHECK(made_text(octagon) == "make octagon --segments 3 --rounding-mm 1.5 --facing left");
  const Result<PolygonMesh> mesh = generate_mesh(octagon.object, octagon.options);
  REQUIRE(mesh);
  REQUIRE(write_obj(*mesh, folder.file("o.obj"), 1e-3, "workbench " + made_text(octagon)));
  folder.write("poses.csv", "t_s,x_m,y_m,z_m\n0,0,0,0.05\n0.001,0,0,0.05\n");
  PresetEvidence asked;
  asked.mesh.source = "o.obj";
  asked.motion.kind = MotionKind::poses;
  asked.motion.file = "poses.csv";
  CHECK((*measure_evidence(asked, {.folder = folder.path()}))->mesh.source == made_text(octagon));
  std::string text = read_text(folder.file("o.obj"));
  folder.write("o.obj", text.replace(text.find("\nv ") + 3, 1, "9"));
  CHECK((*measure_evidence(asked, {.folder = folder.path()}))->mesh.source == "o.obj");
  for (const char* other : {"make", "make torus --segments", "make torus --segments x", "make torus --rounding-mm -1",
                            "make cone --facing up", "makes torus", "make torus --out x.obj"}) {
    CAPTURE(other);
    CHECK_FALSE(made_from(other).has_value());
  }
}
