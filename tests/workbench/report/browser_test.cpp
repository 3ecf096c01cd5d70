// The page in a browser: Chromium without a window, where it is installed (Debian's package chromium).
#include "tests/workbench/report/report_fixture.h"

using namespace tangent;
using namespace tangent::test;

namespace {

constexpr const char* kBrowser = "/usr/bin/chromium";

/// Of `folder`/out/report.html. The browser's own files go into the folder, too.
testing::ProcessResult browse(const testing::TempFolder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
                                       "--user-data-dir=" + folder.file("browser")});
  arguments.push_back("file://" + folder.file("out/report.html"));
  return testing::Process(std::move(arguments), kBrowser).wait();
}

}  // namespace

TEST_CASE("a browser shows the page in both themes and prints it") {
  if (!std::filesystem::exists(kBrowser)) {
    MESSAGE("skipped: Chromium is not installed");
    return;
  }
  const testing::TempFolder folder;
  const std::string recording = folder.file("a.sqlite");
  record_trouble(recording);
  page_of(quick_report({recording}, folder.path() / "out"));
  const testing::ProcessResult dom = browse(folder, {"--dump-dom"});
  CHECK(dom.exit_code == 0);
  // What the parser of a browser made of it: all sections, nothing moved out of its table.
  for (const char* part : {"id=\"r1-touched\"", "id=\"r1-time\"", "id=\"r1-why\"", "id=\"r1-methods\"",
                           "id=\"r1-safety\"", "id=\"presets\"", "id=\"environment\""})
    CHECK_MESSAGE(says(dom.out, part), std::string(part));
  const auto picture = [&](const char* theme, const char* name) {
    const std::string file = folder.file(name);
    const testing::ProcessResult shown = browse(folder, {std::string("--blink-settings=preferredColorScheme=") + theme,
                                                         "--window-size=800,600", "--screenshot=" + file});
    CHECK(shown.exit_code == 0);
    return testing::read_text(file);
  };
  const std::string dark = picture("0", "dark.png"), light = picture("1", "light.png");
  CHECK(light.starts_with("\x89PNG"));
  CHECK(dark.starts_with("\x89PNG"));
  CHECK(dark != light);
  const std::string file = folder.file("report.pdf");
  CHECK(browse(folder, {"--no-pdf-header-footer", "--print-to-pdf=" + file}).exit_code == 0);
  CHECK(testing::read_text(file).starts_with("%PDF"));
}
