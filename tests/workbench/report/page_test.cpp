// The page: complete in itself, and every number of it what the recording says by SQL.
#include "workbench/report/page.h"
#include "core/lab/explain/explain_tick.h"
#include "tests/support/approx.h"
#include "tests/workbench/report/report_fixture.h"
#include "workbench/report/html.h"
#include "workbench/report/numbers.h"

#include <cmath>

using namespace tangent;
using namespace tangent::test;

namespace {

/// A report of one recording with trouble, made once.
struct Sample {
  testing::TempFolder folder;
  std::string recording = folder.file("a.sqlite"), html;
  nlohmann::json page;
  Sample() {
    record_trouble(recording);
    html = page_of(quick_report({recording}, folder.path() / "out"));
    page = parsed(folder.path() / "out" / "report.html");
  }
};
const Sample& report_sample() {
  static const Sample sample;
  return sample;
}

double asked(const std::string& sql) { return std::stod(ask(report_sample().recording, sql).at(0)); }

}  // namespace

TEST_CASE("a report is one well-formed page that loads nothing, runs nothing and whose links lead somewhere") {
  const nlohmann::json& page = report_sample().page;
  CHECK_MESSAGE(page["faults"].empty(), page["faults"].dump(1));
  CHECK(page["scripts"] == 0);
  CHECK(report_sample().html.starts_with("<!DOCTYPE html>"));
  CHECK(says(report_sample().html, "prefers-color-scheme: dark"));
  CHECK(says(report_sample().html, "@media print"));
}

TEST_CASE("every number of the overview is the recording's own, asked by SQL") {
  const std::string size = "sqrt(force_x_n*force_x_n+force_y_n*force_y_n+force_z_n*force_z_n)";
  const std::string touching = "status IN ('face', 'edge', 'vertex')";
  const std::pair<const char*, std::string> asked_of[]{
      {"r1.ticks", "SELECT count(*) FROM ticks"},
      {"r1.seconds", "SELECT max(t_s) - min(t_s) FROM ticks"},
      {"r1.touching", "SELECT count(*) FROM ticks WHERE " + touching},
      {"r1.contact_s",
       "SELECT sum(b.t_s - a.t_s) FROM ticks a JOIN ticks b ON b.tick = a.tick + 1 WHERE a." + touching},
      {"r1.deepest_m", "SELECT max(penetration_m) FROM ticks WHERE " + touching},
      {"r1.most_force_n", "SELECT max(" + size + ") FROM ticks"},
      {"r1.unconverged", "SELECT count(*) FROM ticks WHERE status = 'unconverged'"},
      {"r1.facing", "SELECT count(*) FROM ticks WHERE status = 'facing'"},
      {"r1.reseeds", "SELECT count(*) FROM ticks WHERE event = 'reseed'"},
      {"r1.switches", "SELECT count(*) FROM ticks WHERE event = 'switch'"},
      {"r1.branches", "SELECT count(*) FROM ticks WHERE event = 'branch'"},
      {"r1.worst_error_m", "SELECT max(error_m) FROM ticks WHERE status NOT IN ('unconverged', 'facing')"},
      {"r1.planes", "SELECT avg(iterations) FROM ticks"},
      {"r1.planes_most", "SELECT max(iterations) FROM ticks"},
      {"r1.planes_p99", "SELECT iterations FROM ticks ORDER BY iterations LIMIT 1 OFFSET 989"},
      {"r1.missed", "SELECT sum(missed_deadlines) FROM ticks"},
      {"r1.armed",
       "SELECT count(*) FROM tick_rows t WHERE (SELECT gate_state FROM device_rows d WHERE d.tick <= t.tick "
       "ORDER BY d.tick DESC LIMIT 1) IN (1, 2)"},
      {"r1.A.count", "SELECT count(*) FROM ticks WHERE status = 'unconverged'"},
      {"r1.A.tick", "SELECT tick FROM ticks WHERE status = 'unconverged' ORDER BY error_m DESC LIMIT 1"}};
  for (const auto& [name, sql] : asked_of) {
    CAPTURE(name);
    REQUIRE(report_sample().page["numbers"].contains(name));
    CHECK(report_sample().page["numbers"][name].get<double>() == approx(asked(sql)).epsilon(1e-12).scale(1e-6));
  }
  CHECK(asked("SELECT count(*) FROM ticks WHERE status = 'unconverged'") > 10.0);
  // It ran in simulated time: each period is 1 ms, all quantiles are.
  CHECK(report_sample().page["numbers"]["r1.period_p50_ns"].get<double>() == approx(1e6).epsilon(1e-9));
}

TEST_CASE("the page says what was touched, with which presets, and why the worst tick failed") {
  const nlohmann::json& page = report_sample().page;
  const std::string text = page["text"];
  CHECK(page["numbers"]["r1.scene0.triangles"] == 576);
  CHECK(page["numbers"]["r1.scene0.longest_m"].get<double>() == approx(0.110).epsilon(1e-9));
  for (const char* word :
       {"torus", "sphere of 20 mm radius", "simulated force device", "the same bits", "solver.gain_curvature_m",
        "solver.method", "from 0.6 s", "unconverged", "robust", "two-pass", "compiler"})
    CHECK_MESSAGE(says(text, word), std::string(word));
  CHECK(says(text, ask(report_sample().recording, "SELECT hash FROM scenes").at(0)));
  CHECK(says(text, "No picture: this program was built without the window"));
  auto opened = Recording::open(report_sample().recording);
  REQUIRE(opened);
  auto scenes = scenes_of(*opened, nullptr);
  REQUIRE(scenes);
  const auto worst = tick_before(*opened, *scenes, page["numbers"]["r1.A.tick"].get<std::uint64_t>());
  REQUIRE(worst);
  const std::string why =
      explanation_text(explain_tick(worst->scene, worst->preset, worst->tick.input, worst->tick.kept));
  CHECK_MESSAGE(says(text, why), why);
}

TEST_CASE("every method's row solves the same ticks, and its planes are those of a replay") {
  const nlohmann::json& numbers = report_sample().page["numbers"];
  for (const Method method : bench::kMeasuredMethods) {
    const std::string name = std::string("r1.") + to_string(method);
    CAPTURE(name);
    CHECK(numbers[name + ".typical_ns"].get<double>() > 0.0);
    CHECK(numbers[name + ".ratio"].get<double>() >= 0.9);
  }
  CHECK(numbers["r1.robust.error_p99_m"].get<double>() < 1e-6);
  CHECK(numbers["r1.facet.error_p50_m"].get<double>() > 1e-6);
}

TEST_CASE("commands in the page name the recording, are the program's own, and their SQL runs") {
  int queries = 0;
  for (const std::string command : report_sample().page["commands"]) {
    CAPTURE(command);
    const bool own = command.starts_with("workbench report") || command.starts_with("workbench export ") ||
                     command.starts_with("workbench explain ") || command.starts_with("workbench replay ");
    if (!command.starts_with("sqlite3 ")) {
      CHECK(own);
      continue;
    }
    const std::size_t from = command.find('\''), to = command.rfind('\'');
    CHECK(says(command.substr(0, from), report_sample().recording));
    CHECK_FALSE(ask(report_sample().recording, command.substr(from + 1, to - from - 1)).empty());
    ++queries;
  }
  CHECK(queries >= 5);
}

TEST_CASE("hostile names are text - a mesh, a file and an event that are HTML") {
  const testing::TempFolder folder;
  const std::string recording = folder.file("<img src=x onerror=alert(1)> & 'b' \"c\".sqlite");
  record_trouble(recording);
  change(recording, "UPDATE scenes SET name='<script>alert(1)</script>'");
  change(recording,
         "INSERT INTO events VALUES(9999, 1, 0.001, '</td><script>', '\"><svg onload=alert(2)>' || char(1))");
  change(recording, "UPDATE devices SET value='<iframe src=http://example.org>' WHERE name='name'");
  const std::string html = page_of(quick_report({recording}, folder.path() / "out"));
  const nlohmann::json page = parsed(folder.path() / "out" / "report.html");
  CHECK_MESSAGE(page["faults"].empty(), page["faults"].dump(1));
  CHECK(page["scripts"] == 0);
  for (const char* never : {"<script", "<iframe", "<img src=x", "onload=alert(2)>\"", "\x01"})
    CHECK_MESSAGE(!says(html, never), std::string(never));
  CHECK(says(page["text"], "<script>alert(1)</script>"));
  CHECK(says(page["text"], "<img src=x onerror=alert(1)>"));
}

TEST_CASE("several recordings stand side by side, with the keys in which their presets differ") {
  const testing::TempFolder folder;
  const std::string a = folder.file("a.sqlite"), b = folder.file("b.sqlite");
  record_trouble(a);
  RecordedSession recorded(b);
  recorded.run(300);
  recorded.finish();
  page_of(quick_report({a, b}, folder.path() / "out"));
  const nlohmann::json page = parsed(folder.path() / "out" / "report.html");
  CHECK_MESSAGE(page["faults"].empty(), page["faults"].dump(1));
  CHECK(page["numbers"]["r1.ticks"] == 1000);
  CHECK(page["numbers"]["r2.ticks"] == 300);
  CHECK(says(page["text"], "r2, preset 0, from 0 s, 300 ticks"));
  CHECK(says(page["text"], "Keys in which the presets differ"));
  CHECK(says(page["text"], "Nothing: every tick converged"));
}

TEST_CASE("a recording without its mesh is reported without what needs it, and with it where the mesh is given") {
  const testing::TempFolder folder;
  const std::string recording = folder.file("a.sqlite");
  record_trouble(recording, torus_source(), false);
  ReportOptions options = quick_report({recording}, folder.path() / "out");
  page_of(options);
  nlohmann::json page = parsed(folder.path() / "out" / "report.html");
  CHECK_MESSAGE(page["faults"].empty(), page["faults"].dump(1));
  CHECK(page["numbers"]["r1.ticks"] == 1000);
  CHECK(says(page["text"], "Not measured: "));
  CHECK(says(page["text"], "--mesh"));
  options.gather.source = torus_source();
  options.gather.scene = built(torus_source());
  page_of(options);
  page = parsed(folder.path() / "out" / "report.html");
  CHECK(page["numbers"]["r1.scene0.triangles"] == 576);
  CHECK(says(page["text"], "the same bits"));
  options.gather.source = {std::make_shared<const PolygonMesh>(make_torus(0.040, 0.015, 24, 14)), {}, nullptr};
  options.gather.scene = built(options.gather.source);
  CHECK(says(report_failure(options), "was recorded with"));
}

TEST_CASE("pictures are within the page, one for each theme, and a failure to draw is a sentence") {
  const testing::TempFolder folder;
  ReportOptions options = quick_report({report_sample().recording}, folder.path() / "out");
  std::vector<std::uint64_t> drawn;
  options.gather.draw = [&drawn](const TickToDraw& tick) -> Result<std::string> {
    drawn.push_back(tick.tick.tick);
    if (drawn.size() > 2) return fail("no light", "here");
    return std::string("\x89PNG") + (tick.dark ? "d" : "l");
  };
  const std::string html = page_of(options);
  const nlohmann::json page = parsed(folder.path() / "out" / "report.html");
  CHECK_MESSAGE(page["faults"].empty(), page["faults"].dump(1));
  CHECK(page["pictures"] == 1);
  CHECK(says(html, "src=\"data:image/png;base64,iVBOR2w=\""));
  CHECK(says(html, "srcset=\"data:image/png;base64,iVBOR2Q=\""));
  CHECK(drawn.front() == page["numbers"]["r1.A.tick"].get<std::uint64_t>());
  if (drawn.size() > 2) CHECK(says(page["text"], "No picture: here: no light."));
}

TEST_CASE("text for a page - entities, bytes that are no UTF-8, control characters") {
  CHECK(escaped("a<b>&\"'c") == "a&lt;b&gt;&amp;&quot;&#39;c");
  CHECK(escaped("\xC2\xB5m \xE2\x82\xAC \xF0\x9F\x98\x80") == "\xC2\xB5m \xE2\x82\xAC \xF0\x9F\x98\x80");
  for (const char* bad :
       {"\x80", "\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xF8", "\xC2", "\x01", "\x7f"}) {
    CAPTURE(bad);
    const std::string text = escaped(bad);
    CHECK(text.starts_with("\xEF\xBF\xBD"));
    CHECK(text.size() % 3 == 0);
  }
  CHECK(number_cell("n", std::nan(""), "none").html == "<td class=\"number\">none</td>");
}

TEST_CASE("numbers as the page shows them") {
  CHECK(count_text(1234567) == "1,234,567");
  CHECK(count_text(999) == "999");
  CHECK(metres_text(1.234e-3) == "1.234 mm");
  CHECK(metres_text(-2e-6) == "-2 \xC2\xB5m");
  CHECK(metres_text(0.0) == "0");
  CHECK(metres_text(-INFINITY) == "none");
  CHECK(time_text(123.4) == "123.4 ns");
  CHECK(time_text(1.5e6) == "1.5 ms");
  CHECK(seconds_text(3725.0) == "1 h 02 min");
  CHECK(seconds_text(59.99) == "59.99 s");
  CHECK(share_text(1, 8) == "12.5 %");
  CHECK(share_text(0, 0) == "none");
}
