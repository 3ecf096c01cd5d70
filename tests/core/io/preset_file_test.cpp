#include "core/io/preset_file.h"

#include "core/preset/schema.h"
#include "tests/support/paths.h"
#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

using namespace tangent;
using tangent::testing::contains;
using tangent::testing::TempFolder;

namespace {

/// Message for a text that must be refused.
std::string preset_refusal(std::string_view text) {
  const Result<PresetFile> file = parse_preset(text, "p.toml");
  REQUIRE_FALSE(file);
  return file.error().message();
}

/// A preset with every value somewhere in its range, with as many digits as doubles have.
Preset random_preset(std::mt19937_64& random) {
  Preset preset;
  for (const PresetKey& key : preset_keys()) {
    std::uniform_real_distribution<double> between(0.0, 1.0);
    double value = key.min + between(random) * (key.max - key.min);
    if (key.kind != KeyKind::number) value = std::round(value);
    key.set(preset, std::clamp(value, key.min, key.max));
  }
  return preset;
}

}  // namespace

TEST_CASE("an empty preset is the default") {
  const Result<PresetFile> file = parse_preset("", "p.toml");
  REQUIRE(file);
  CHECK(*file == PresetFile{});
}

TEST_CASE("what is written reads back as the same doubles") {
  std::mt19937_64 random(7);
  for (int i = 0; i < 200; ++i) {
    const PresetFile file{{}, random_preset(random)};
    const Result<PresetFile> back = parse_preset(format_preset(file), "p.toml");
    REQUIRE(back);
    CHECK(*back == file);
  }
}

TEST_CASE("every key is written under its table, and by itself reads back as set") {
  for (const PresetKey& key : preset_keys()) {
    CAPTURE(key.full_name());
    PresetFile file;
    key.set(file.preset, key.default_value() == key.max ? key.min : key.max);
    CHECK_FALSE(file == PresetFile{});
    const std::string text = format_preset(file);
    const Result<PresetFile> back = parse_preset(text, "p.toml");
    REQUIRE(back);
    CHECK(*back == file);
    const std::size_t table = text.find("\n[" + std::string(key.table) + "]\n");
    REQUIRE(table != std::string::npos);
    const std::size_t line = text.find("\n" + std::string(key.key) + " = ", table);
    CHECK(line < text.find("\n[", table + 1));
  }
}

TEST_CASE("the format is the first key, and a file without one is read as it always was") {
  const std::string text = format_preset(PresetFile{});
  const std::size_t key = text.find("\nformat = 3\n");
  REQUIRE(key != std::string::npos);
  CHECK(text.find('=') == key + 8);
  CHECK(text.find('[') > key);
  CHECK(parse_preset("format = 0\n[force]\nlimit_n = 3\n", "p.toml")->preset.force.limit_n == 3.0);
  CHECK(parse_preset("[force]\nlimit_n = 3\n", "p.toml")->preset.force.limit_n == 3.0);
  CHECK(parse_preset("format = 1\n[force]\nlimit_n = 3\n", "p.toml")->preset.force.limit_n == 3.0);
}

TEST_CASE("a preset of a newer format is refused, and says what to do") {
  CHECK(preset_refusal("# note\nformat = 7\n[solver]\nnew_key = 1\n") ==
        "p.toml:2 format: this file has format 7, this program reads up to 3; use the program that wrote it or a newer "
        "one, or write the preset file again with this one");
  for (const char* wrong : {"format = -1\n", "format = 1.0\n", "format = \"1\"\n", "[format]\nx = 1\n"}) {
    CAPTURE(wrong);
    CHECK(contains(preset_refusal(wrong),
                   "p.toml:1 format: is not a format of a preset file; allowed: a whole number from 0 to 3"));
  }
}

TEST_CASE("where a preset comes from reads back, whatever the text") {
  PresetFile file;
  file.about = {.name = "quotes \" and \\ and 'these'",
                .date = "2026-03-31",
                .program_version = "0.1.0",
                .mesh_name = "W\xC3\xBCrfel.obj",
                .mesh_hash = "00ff00ff00ff00ff",
                .device = "simulated",
                .note = "two\nlines\tand a tab",
                .measured = std::nullopt,
                .also_measured = {{"p99_iterations", 2.0},
                                  {"mean_iterations", 1.0 / 3.0},
                                  {"a key with blanks", 1e-300},
                                  {"command", std::string("workbench solve x.obj")}}};
  const Result<PresetFile> back = parse_preset(format_preset(file), "p.toml");
  REQUIRE(back);
  CHECK(*back == file);
}

TEST_CASE("missing keys keep their defaults and whole numbers are numbers") {
  const Result<PresetFile> file = parse_preset("[solver]\ngain_overall = 1\nmethod = \"paper\"\n", "p.toml");
  REQUIRE(file);
  Preset expected;
  expected.solver.gain_overall = 1.0;
  expected.solver.method = Method::paper;
  CHECK(file->preset == expected);
}

TEST_CASE("unknown keys and tables are named with their line and what is allowed") {
  const std::string key = preset_refusal("[solver]\ngain_overall = 1.0\ngain_curvatura_m = 0.02\n");
  CHECK(contains(key, "p.toml:3 solver.gain_curvatura_m: unknown key; allowed: "));
  CHECK(contains(key, "gain_curvature_m"));
  CHECK(contains(preset_refusal("[force]\n[haptics]\nx = 1\n"), "p.toml:2 haptics: unknown table"));
  CHECK(contains(preset_refusal("stiffness = 3\n"), "p.toml:1 stiffness: unknown table or key"));
  CHECK(contains(preset_refusal("[about]\nauthor = \"me\"\n"), "p.toml:2 about.author: unknown key"));
  CHECK(contains(preset_refusal("solver = 3\n"), "p.toml:1 solver: is a whole number; write the table [solver]"));
  CHECK(contains(preset_refusal("[solver]\nmethod.name = \"paper\"\n"), "solver.method: is a table"));
}

TEST_CASE("wrong types are named with the allowed range") {
  CHECK(preset_refusal("[force]\nstiffness_n_per_m = \"stiff\"\n") ==
        "p.toml:2 force.stiffness_n_per_m: is text; allowed: 0 to 100000 N/m");
  CHECK(preset_refusal("\n[solver]\nmax_iterations = 50.0\n") ==
        "p.toml:3 solver.max_iterations: is a number with a fraction; allowed: a whole number from 1 to 10000");
  CHECK(contains(preset_refusal("[solver]\nmethod = 2\n"), "solver.method: is a whole number; allowed: paper, newton"));
  CHECK(contains(preset_refusal("[solver]\ntolerance_m = [1e-6]\n"), "is an array"));
  CHECK(contains(preset_refusal("[solver]\ntolerance_m = true\n"), "is true or false"));
  CHECK(contains(preset_refusal("[solver]\ntolerance_m = 2026-01-01\n"), "is a date or time"));
  CHECK(contains(preset_refusal("[about]\nname = 3\n"), "p.toml:2 about.name: is a whole number; allowed: text"));
  CHECK(contains(preset_refusal("[about.measured]\nx = [1]\n"), "p.toml:2 about.also_measured.x: is an array"));
}

TEST_CASE("out-of-range values are named with the allowed range") {
  CHECK(preset_refusal("[solver]\ngain_overall = -0.5\n") ==
        "p.toml:2 solver.gain_overall: -0.5 is out of range; allowed: 0 to 10");
  CHECK(contains(preset_refusal("[solver]\ntolerance_m = -1e-6\n"), "allowed: 1e-12 to 0.001 m"));
  CHECK(contains(preset_refusal("[solver]\ntolerance_m = nan\n"), "solver.tolerance_m: nan is out of range"));
  CHECK(contains(preset_refusal("[force]\nlimit_n = inf\n"), "force.limit_n: inf is out of range"));
  CHECK(contains(preset_refusal("[solver]\nmax_iterations = 0\n"), "0 is out of range"));
  CHECK(contains(preset_refusal("[solver]\nmax_iterations = 9223372036854775807\n"), "is out of range"));
  CHECK(contains(preset_refusal("[solver]\nmethod = \"magic\"\n"), "\"magic\" is out of range; allowed: paper,"));
}

TEST_CASE("broken TOML is named with its line") {
  CHECK(contains(preset_refusal("[solver]\ngain_overall = \n"), "p.toml:2"));
  CHECK(contains(preset_refusal("[solver]\ngain_overall = 1\ngain_overall = 2\n"), "p.toml:3"));
  CHECK(contains(preset_refusal(std::string_view("\x7f\x45LF\x01\x00\xff\xfe", 8)), "p.toml:1"));
  CHECK(contains(preset_refusal("a = " + std::string(100000, '[')), "p.toml:1"));
}

TEST_CASE("a preset is saved whole or not at all") {
  const TempFolder folder;
  PresetFile file;
  file.about.name = "soft";
  REQUIRE(write_preset(file, folder.file("p.toml")));
  const Result<PresetFile> back = read_preset(folder.file("p.toml"));
  REQUIRE(back);
  CHECK(*back == file);
  file.preset.force.limit_n = -1.0;
  CHECK_FALSE(write_preset(file, folder.file("p.toml")));
  CHECK(*read_preset(folder.file("p.toml")) == *back);
  CHECK_FALSE(write_preset(PresetFile{}, folder.file("no/folder/p.toml")));
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("missing, empty and huge preset files are refused by name") {
  const TempFolder folder;
  CHECK(contains(read_preset(folder.file("none.toml")).error().message(), "none.toml: can't be opened: No such file"));
  CHECK(contains(read_preset(folder.write("empty.toml", "")).error().message(), "empty.toml: the file is empty"));
  CHECK(contains(read_preset("/dev/zero").error().message(), "/dev/zero:1: holds a zero byte"));
  std::string comments;
  while (comments.size() <= 1 << 20) comments += "# a comment of a preset that goes on and on\n";
  CHECK(contains(read_preset(folder.write("huge.toml", comments)).error().message(), "larger than 1 MiB"));
  CHECK_FALSE(read_preset(folder.path()));
}

TEST_CASE("every preset that ships can be read") {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(testing::source_folder() + "/presets")) {
    if (entry.is_directory()) continue;  // protocols of experiments
    CAPTURE(entry.path().string());
    const Result<PresetFile> file = read_preset(entry.path());
    if (!file) FAIL_CHECK(file.error().message());
    ++count;
  }
  CHECK(count > 0);
}

namespace {

PresetEvidence some_evidence() {
  PresetEvidence e;
  e.command = "workbench tune ball.obj --out \"p\".toml";
  e.program_version = "0.1.0";
  e.build = "g++ 12.2.0, id 00ff";
  e.motion = {.kind = MotionKind::recording, .file = "a b/r.sqlite", .first_tick = 3, .last_tick = 9, .digest = "0f"};
  e.mesh.source = "make octagon --rounding-mm 1.5";
  e.mesh.hash = "00ff00ff00ff00ff";
  e.mesh.metres_per_unit = 0.0254;
  e.mesh.options = {.fit_m = 0.08, .normals = NormalSource::computed, .crease_rad = 0.1 + 0.2, .turn_over = true};
  double n = 1.0 / 3.0;
  for (const EvidenceNumber& number : evidence_numbers()) e.numbers.*number.field = n += 1.0;
  e.values.solver.gain_overall = 0.1 + 0.2;
  return e;
}

std::string without_line(std::string text, const std::string& start) {
  const std::size_t at = text.find("\n" + start) + 1;
  REQUIRE(at != 0);
  return text.erase(at, text.find('\n', at) + 1 - at);
}

}  // namespace

TEST_CASE("evidence of a preset reads back to the last bit, with every value it was measured with") {
  std::mt19937_64 random(11);
  for (int i = 0; i < 50; ++i) {
    PresetFile file{{}, random_preset(random)};
    file.about.measured = some_evidence();
    file.about.also_measured = {{"newton_mean_iterations", 1.5}};
    const Preset measured = random_preset(random);
    for (const PresetKey& key : preset_keys())
      if (in_evidence(key)) key.set(file.about.measured->values, key.get(measured));
    const Result<PresetFile> back = parse_preset(format_preset(file), "p.toml");
    REQUIRE_MESSAGE(back.has_value(), back.error().message());
    CHECK(*back == file);
  }
}

TEST_CASE("the digest of evidence fits what was written, and no number, text or value that was edited since") {
  PresetFile file;
  file.about.measured = some_evidence();
  const std::string text = format_preset(file);
  const auto edited = [](const std::string& changed) {
    const Result<PresetFile> read = parse_preset(changed, "p.toml");
    REQUIRE_MESSAGE(read.has_value(), read.error().message());
    return !read->about.measured->edited_digest.empty();
  };
  CHECK_FALSE(edited(text));
  const auto with = [&text](const std::string& key, const std::string& value) {
    std::string changed = text;
    const std::size_t at = changed.find("\n" + key + " = ") + 1 + key.size() + 3;
    REQUIRE(at > key.size() + 4);
    return changed.replace(at, changed.find('\n', at) - at, value);
  };
  for (const EvidenceNumber& number : evidence_numbers()) CHECK(edited(with(std::string(number.key), "0.5")));
  CHECK(edited(with("program_version", "\"0.2.0\"")));
  CHECK(edited(with("mesh_turn_over", "false")));
  CHECK(edited(with("solver.gain_overall", "0.25")));
  CHECK_FALSE(edited(with("ticks", "1.33333333333333333333")));  // the same number
  CHECK_FALSE(edited(with("mesh", "\"elsewhere.obj\"")));        // its contents have a digest of their own
  CHECK(contains(preset_refusal(without_line(text, "digest")), "the key digest is missing"));
  std::string older = without_line(text, "digest");
  CHECK_FALSE(edited(older.replace(older.find("format = 3"), 10, "format = 2")));
}

TEST_CASE("evidence with a key too many, one too few or a value that can't be is refused with its line") {
  PresetFile file;
  file.about.measured = some_evidence();
  const std::string text = format_preset(file);
  CHECK(contains(preset_refusal(without_line(text, "mean_planes")), "about.measured: the key mean_planes is missing"));
  CHECK(contains(preset_refusal(without_line(text, "mesh_hash")), "the key mesh_hash is missing"));
  const auto with = [&](const std::string& line) {
    std::string changed = text;
    const std::size_t at = changed.find("\nmesh_hash");
    return preset_refusal(changed.insert(at + 1, line + "\n"));
  };
  CHECK(contains(with("mesh_colour = \"red\""), "about.measured.mesh_colour: unknown key; allowed: motion"));
  CHECK(contains(with("motion_version = -1"), "about.measured.motion_version: is no number from 0"));
  CHECK(contains(with("motion_version = nan"), "about.measured.motion_version: is no number from 0"));
  CHECK(contains(with("motion_version = \"1\""), "about.measured.motion_version: is text; allowed: a number from 0"));
  CHECK(contains(preset_refusal("format = 2\n[about.measured]\nmotion = \"dance\"\n"),
                 "p.toml:3 about.measured.motion: \"dance\" is unknown; allowed: around, strokes, poses"));
  CHECK(contains(preset_refusal("format = 2\n[about.measured.values]\nsolver.gain = 1\n"),
                 "p.toml:3 about.measured.values solver.gain: unknown key"));
  CHECK(contains(preset_refusal("format = 2\n[about.measured.values]\nsolver = 1\n"), "solver: unknown key"));
  CHECK(contains(preset_refusal("format = 2\n[about]\nmeasured = 1\n"), "write the table [about.measured]"));
}

TEST_CASE("what presets of format 1 measured is kept, and is no evidence") {
  const Result<PresetFile> old =
      parse_preset("format = 1\n[about.measured]\nticks = 3.0\ncommand = \"tune\"\n", "old.toml");
  REQUIRE(old);
  CHECK_FALSE(old->about.measured.has_value());
  REQUIRE(old->about.also_measured.size() == 2);
  CHECK(old->about.also_measured[0].first == "ticks");
  CHECK(std::get<std::string>(old->about.also_measured[1].second) == "tune");
  CHECK(contains(preset_refusal("format = 1\n[about.also_measured]\nx = 1\n[about.measured]\ny = 1\n"), "unknown key"));
}
