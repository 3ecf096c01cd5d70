#include "workbench/sweep/plan.h"

#include "tests/support/approx.h"
#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

namespace tangent::sweep {

using test::approx;
namespace {

constexpr const char* kWhole = R"([plan]
meshes = ["a.obj", "/b.obj"]
unit = "cm"
fit_mm = 80
normals = "computed"
crease_deg = 30
turn_over = true
poses = ["walk.csv", "around"]
methods = ["paper", "robust"]
ticks = 500

[ranges]
"solver.gain_curvature_m" = [0.01, 0.02, 0.04]
"solver.tolerance_m" = { from = 1e-8, to = 1e-5, count = 4, scale = "log" }
"force.blend" = ["off", "events"]

[[fingers]]
radius_m = 0.005
[[fingers]]
shape = "point"
)";

std::string error_of(const std::string& text) {
  const Result<Plan> plan = parse_plan(text, "/somewhere/p.toml");
  return plan ? "" : plan.error().message();
}

std::string with(const std::string& lines) { return "[plan]\nmeshes = [\"a.obj\"]\nposes = [\"around\"]\n" + lines; }

TEST_CASE("a plan holds what its file says, with paths from the file's folder") {
  const Result<Plan> plan = parse_plan(kWhole, "/somewhere/p.toml");
  REQUIRE_MESSAGE(plan, plan.error().message());
  CHECK(plan->meshes == std::vector<std::filesystem::path>{"/somewhere/a.obj", "/b.obj"});
  CHECK(plan->poses == std::vector<std::string>{"/somewhere/walk.csv", "around"});
  CHECK(plan->metres_per_unit == 1e-2);
  CHECK(*plan->reading.fit_m == approx(0.08));
  CHECK(plan->reading.normals == NormalSource::computed);
  CHECK(plan->reading.turn_over);
  CHECK(plan->methods == std::vector<Method>{Method::paper, Method::robust});
  CHECK(plan->ticks == 500);
  REQUIRE(plan->fingers.size() == 2);
  CHECK(plan->fingers[0].radius_m == 0.005);
  CHECK(plan->fingers[1].shape == FingerShape::point);
  REQUIRE(plan->ranges.size() == 3);
  for (const Range& range : plan->ranges) {
    if (range.key->full_name() != "solver.tolerance_m") continue;
    const std::vector<double> values = range.grid();
    REQUIRE(values.size() == 4);
    CHECK(values.front() == 1e-8);
    CHECK(values[1] == approx(1e-7));
    CHECK(values.back() == 1e-5);
  }
}

TEST_CASE("a plan reads back from what it is written as") {
  const Result<Plan> plan = parse_plan(kWhole, "/somewhere/p.toml");
  REQUIRE(plan);
  const std::string text = format_plan(*plan);
  const Result<Plan> again = parse_plan(text, "/elsewhere/q.toml");
  REQUIRE_MESSAGE(again, again.error().message());
  CHECK(format_plan(*again) == text);
  CHECK(again->meshes == plan->meshes);
  CHECK(again->fingers == plan->fingers);
}

TEST_CASE("a motion that is made may name its depth") {
  CHECK(made_motion("around")->kind == 0);
  CHECK(!made_motion("around")->press_m);
  CHECK(made_motion("strokes:0.5mm")->kind == 1);
  CHECK(*made_motion("strokes:0.5mm")->press_m == approx(5e-4));
  for (const char* file :
       {"walk.csv", "around.csv", "around:", "around:2", "around:0mm", "around:-1mm", "around:99mm", "around:xmm", ""})
    CHECK_MESSAGE(!is_made(file), file);
}

TEST_CASE("a plan that can't be run is refused by key and line") {
  struct Wrong {
    const char *lines, *said;
  };
  for (const Wrong& wrong : std::initializer_list<Wrong>{
           {"surprise = 1\n", "p.toml:4 surprise: unknown key"},
           {"methods = [\"newtn\"]\n", "p.toml:4 methods"},
           {"ticks = 0\n", "p.toml:4 ticks"},
           {"fit_mm = -1\n", "p.toml:4 fit_mm"},
           {"unit = \"mile\"\n", "p.toml:4 unit"},
           {"methods = []\n", "p.toml:4 methods: is empty"},
           {"methods = 3\n", "p.toml:4 methods: is not a list of names"},
           {"sampling = \"sobol\"\n", "needs samples"},
           {"samples = 5\n", "samples contradicts"},
           {"sampling = \"sobol\"\nsamples = 5\n", "nothing to sample"},
           {"[ranges]\n\"solver.gain\" = [1]\n", "p.toml:5 solver.gain: unknown key"},
           {"[ranges]\n\"solver.gain_overall\" = []\n", "is empty"},
           {"[ranges]\n\"solver.gain_overall\" = [11]\n", "p.toml:5 solver.gain_overall"},
           {"[ranges]\n\"solver.gain_overall\" = { from = 1, to = 2 }\n", "count of at least 2"},
           {"[ranges]\n\"solver.gain_overall\" = { from = 2, to = 1, count = 3 }\n", "is empty: from is not below to"},
           {"[ranges]\n\"solver.gain_overall\" = { from = 0, to = 1, count = 3, scale = \"log\" }\n", "logarithmic"},
           {"[ranges]\n\"solver.gain_overall\" = { to = 1, count = 3 }\n", "lacks an end"},
           {"[ranges]\n\"solver.max_iterations\" = [2.5]\n", "p.toml:5 solver.max_iterations"},
           {"[ranges]\n\"solver.method\" = [\"paper\"]\n", "set by methods"},
           {"[[fingers]]\nradius = 1\n", "unknown key"},
           {"[[fingers]]\nradius_m = -1\n", "p.toml:5"},
           {"[[fingers]]\n[[fingers]]\n[ranges]\n\"finger.radius_m\" = [0.01]\n", "contradicts several fingers"},
       }) {
    const std::string said = error_of(with(wrong.lines));
    CHECK_MESSAGE(said.find(wrong.said) != std::string::npos, wrong.lines, " gave: ", said);
  }
  CHECK(error_of("[plan]\nposes = [\"around\"]\n").find("no mesh") != std::string::npos);
  CHECK(error_of("[plan]\nmeshes = [\"a\"]\n").find("no motion") != std::string::npos);
  CHECK(error_of("[plan\n").find("p.toml:1") != std::string::npos);
  CHECK(error_of(with("preset = \"none.toml\"\n")).find("/somewhere/none.toml") != std::string::npos);
}

}  // namespace
}  // namespace tangent::sweep
