// The page of an analysis as people see it: in Chromium, where it is installed, and its figures' colours in both
// themes.
#include "tests/support/process.h"
#include "workbench/analysis/write_analysis.h"
#include "workbench/experiment/run_simulated.h"
#include "workbench/report/page.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <regex>
#include <set>
#include <sstream>

namespace tangent::analysis {
namespace {

namespace fs = std::filesystem;
using namespace experiment;

constexpr const char* kBrowser = "/usr/bin/chromium";

/// Two simulated participants of both protocols, analysed. In `folder`/out.
std::string page_of_both(const testing::TempFolder& folder) {
  for (const std::string kind : {"discrimination", "identification"}) {
    std::ostringstream text;
    text << std::ifstream(fs::path(testing::source_folder()) / "presets/experiments" / (kind + ".toml")).rdbuf();
    const Protocol protocol = *parse_protocol(text.str(), kind);
    for (const std::string name : {"P1", "P2"}) {
      Enrolment who{{name, "known", false}, 0, protocol_digest(protocol)};
      who.seed = default_seed(name, who.protocol_digest);
      REQUIRE(run_simulated(folder.path() / "data", protocol, text.str(), who, {}));
    }
  }
  AnalysisOptions options;
  options.folder = folder.path() / "out";
  options.command = "workbench analyse data";
  options.repeats = 20;
  const auto page = write_analysis(*load_answers(std::vector<fs::path>{folder.path() / "data"}, {}), options);
  REQUIRE_MESSAGE(page, (page ? "" : page.error().message()));
  return testing::read_text(page->string());
}

struct Colour {
  double r = 0.0, g = 0.0, b = 0.0;  ///< 0 to 1
};

double luminance(const Colour& c) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  return 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
}

/// WCAG 2.
double contrast(const Colour& a, const Colour& b) {
  const double la = luminance(a), lb = luminance(b);
  return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

/// As gnuplot writes them: rgb( 34,  34,  34) or #FFFFFF.
std::optional<Colour> colour_of(const std::string& text) {
  unsigned r = 0, g = 0, b = 0;
  if (std::sscanf(text.c_str(), "rgb(%u,%u,%u)", &r, &g, &b) != 3 &&
      std::sscanf(text.c_str(), "#%2x%2x%2x", &r, &g, &b) != 3)
    return std::nullopt;
  return Colour{r / 255.0, g / 255.0, b / 255.0};
}

testing::ProcessResult browse(const testing::TempFolder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(),
                   {"--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run",
                    "--disable-background-networking", "--disable-component-update", "--disable-sync",
                    "--user-data-dir=" + folder.file("browser")});
  arguments.push_back("file://" + folder.file("out/analysis.html"));
  return testing::Process(std::move(arguments), kBrowser).wait();
}

}  // namespace

TEST_CASE(
    "every line, point and word of a figure is seen on the page's dark ground, or has a colour of its own there") {
  const testing::TempFolder folder;
  const std::string html = page_of_both(folder), style = page_style();
  const Colour dark{0x15 / 255.0, 0x19 / 255.0, 0x1e / 255.0}, light{1.0, 1.0, 1.0};
  REQUIRE(style.find("--ground: #15191e") != std::string::npos);
  const std::regex used("(stroke|fill|color) ?= ?['\"]((?:rgb\\([^)]*\\))|(?:#[0-9A-Fa-f]{6}))['\"]");
  std::set<std::string> rules;
  for (std::sregex_iterator at(html.begin(), html.end(), used), end; at != end; ++at)
    rules.insert((*at)[1].str() + "=\"" + (*at)[2].str() + "\"");
  CHECK(rules.size() > 6);
  CHECK(html.find("color='white'") != std::string::npos);  // around points, by name
  CHECK(style.find("[color=\"white\"]") != std::string::npos);
  for (const std::string& rule : rules) {
    const auto colour = colour_of(rule.substr(rule.find('"') + 1));
    CAPTURE(rule);
    REQUIRE(colour);
    if (style.find("[" + rule + "]") != std::string::npos) continue;  // follows the theme
    if (rule.starts_with("stroke=\"rgb(227")) continue;
    CHECK(contrast(*colour, dark) >= 3.0);   // WCAG 1.4.11, of what is no text
    CHECK(contrast(*colour, light) >= 2.0);  // orange is a paper's colour for people who see no red
  }
}

TEST_CASE("a browser shows the page of an analysis whole in both themes, narrow and wide, and prints it") {
  if (!fs::exists(kBrowser)) {
    MESSAGE("skipped: Chromium is not installed");
    return;
  }
  const testing::TempFolder folder;
  page_of_both(folder);
  // What its parser made of it: nothing was moved out of its table, and every figure is one.
  const testing::ProcessResult dom = browse(folder, {"--dump-dom"});
  CHECK(dom.exit_code == 0);
  const auto count = [&dom](const std::string& part) {
    int found = 0;
    for (std::size_t at = dom.out.find(part); at != std::string::npos; at = dom.out.find(part, at + 1)) ++found;
    return found;
  };
  CHECK(count("<svg") == 6);
  CHECK(count("<figcaption>") == 6);
  CHECK(count("<table") == 14);
  CHECK(count("</table>") == 14);
  const auto picture = [&](const char* theme, const char* size) {
    const std::string file = folder.file(std::string("shown") + theme + size + ".png");
    CHECK(browse(folder, {std::string("--blink-settings=preferredColorScheme=") + theme,
                          std::string("--window-size=") + size, "--screenshot=" + file})
              .exit_code == 0);
    const std::string png = testing::read_text(file);
    CHECK(png.starts_with("\x89PNG"));
    return png;
  };
  const std::string dark = picture("0", "1280,900"), light = picture("1", "1280,900");
  CHECK(dark != light);
  CHECK(picture("1", "480,900") != light);
  const std::string file = folder.file("analysis.pdf");
  CHECK(browse(folder, {"--no-pdf-header-footer", "--print-to-pdf=" + file}).exit_code == 0);
  CHECK(testing::read_text(file).starts_with("%PDF"));
}

}  // namespace tangent::analysis
