// What a person types after Ctrl-P, and what comes first.
#include "tests/workbench/gui/headless_app.h"

#include "workbench/gui/panels/command_match.h"

using namespace tangent;
using tangent::test::HeadlessApp;

namespace {

struct TypedInto {
  HeadlessApp ui;
  MenuBar menu;
  std::vector<PaletteRow> rows = palette_rows(window_commands(ui.model(), menu));

  std::vector<std::string> lines(std::string_view typed) const {
    std::vector<std::string> out;
    for (const PaletteRow& row : matching_rows(rows, typed)) out.push_back(row.line);
    return out;
  }
  std::string first(std::string_view typed) const {
    const auto found = lines(typed);
    return found.empty() ? "" : found.front();
  }
};

}  // namespace

TEST_CASE("words find the command that a person means by them, first of all") {
  const TypedInto box;
  struct Meant {
    const char *typed, *line;
  };
  for (const Meant& meant : {Meant{"save", "save preset"},
                             {"window light", "theme light"},
                             {"window: light", "theme light"},
                             {"light", "theme light"},
                             {"map cur", "map curvature"},
                             {"monitor", "device monitor"},
                             {"force device ideal", "force device ideal"},
                             {"time pause", "pause"},
                             {"play", "pause"},
                             {"undo", "undo"},
                             {"method newton", "method newton"},
                             {"newton", "method newton"},
                             {"curvature gain 12", "curvature gain 12"},
                             {"G_k 12 mm", "curvature gain 12 mm"},
                             {"stiffness 800", "force stiffness 800"},
                             {"worst place", "worst place"},
                             {"export csv", "export ticks"},
                             {"stop force", "stop"},
                             {"bigger text", "larger text"},
                             {"text size 150", "text size 150"},
                             {"panel map", "panel Map"},
                             {"show edges off", "show edges off"},
                             {"quit", "quit"},
                             {"exit", "quit"},
                             {"undoo", "undo"},
                             {"histogram", "plots Histogram"},
                             {"open /tmp/bunny.obj", "open /tmp/bunny.obj"}}) {
    CAPTURE(std::string(meant.typed));
    CHECK(box.first(meant.typed) == meant.line);
  }
}

TEST_CASE("nothing is offered that the words do not say: save does not make a groove, nor export lead the hand") {
  const TypedInto box;
  for (const std::string& line : box.lines("save")) {
    CAPTURE(line);
    CHECK_FALSE(line.starts_with("mesh "));
    CHECK((line.find("save") != std::string::npos || line.find("export") != std::string::npos ||
           line.find("preset") != std::string::npos || line == "screenshot" || line == "picture"));
  }
  for (const std::string& line : box.lines("export")) CHECK(line.find("hand") == std::string::npos);
  CHECK_FALSE(box.lines("export").empty());
  CHECK(box.lines("xyzzy").empty());
  CHECK(box.lines("save xyzzy").empty());
  CHECK(box.lines("").size() == box.rows.size());
}

TEST_CASE("a value is offered only to what takes one, and goes into the line as typed") {
  const TypedInto box;
  CHECK(box.lines("undo 3").empty());
  for (const PaletteRow& row : matching_rows(box.rows, "curvature gain")) {
    if (row.line != "curvature gain") continue;
    CHECK_FALSE(row.complete);
    CHECK(row.value.find("20 mm") == 0);  // as it is, before what it may be
  }
  CHECK(box.first("curvature gain") == "curvature gain");
  CHECK(matching_rows(box.rows, "curvature gain 12").front().complete);
}

TEST_CASE("a whole word counts more than the beginning of one, and that more than a slip") {
  CHECK(match_score("Map: none", "", "map") > match_score("Maps: none", "", "map"));
  CHECK(match_score("Maps: none", "", "map") > match_score("Nope", "map", "ma"));
  CHECK(match_score("Preset: undo", "", "undo") > match_score("Preset: undo", "", "udno"));
  CHECK(match_score("Preset: undo", "", "udno") > 0.0);
  CHECK(match_score("Preset: undo", "back", "back") > 0.0);
  CHECK(match_score("Preset: undo", "", "preset xyz") == 0.0);
}
