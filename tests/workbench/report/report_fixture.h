// Reports of small recordings, and what a reader of the page finds.
#pragma once

#include "tests/support/paths.h"
#include "tests/support/process.h"
#include "tests/workbench/recording/recording_fixture.h"
#include "workbench/report/motion_parts.h"
#include "workbench/report/report.h"
#include "workbench/report/tick_before.h"

#include <nlohmann/json.hpp>

namespace tangent::test {

inline ReportOptions quick_report(std::vector<std::filesystem::path> recordings, const std::filesystem::path& folder) {
  ReportOptions options;
  options.recordings = std::move(recordings);
  options.folder = folder;
  options.command = "workbench report";
  options.gather.most_ticks = 100;
  options.gather.methods.rounds = 2;
  return options;
}

/// A torus explored under the program's values, then by the paper's method with a gain that fails.
inline void record_trouble(const std::filesystem::path& path, const SceneSource& source = torus_source(),
                           bool keep_mesh = true) {
  RecordedSession recorded(path, source, keep_mesh);
  recorded.run(600);
  Preset failing;
  failing.solver.method = Method::paper;
  failing.solver.gain_curvature_m = 0.0;
  REQUIRE(recorded.session->set_preset(failing));
  recorded.run(400);
  recorded.finish();
}

inline std::string page_of(const ReportOptions& options) {
  const auto page = write_report(options);
  REQUIRE_MESSAGE(page, (page ? "" : message_of(page.error())));
  return testing::read_text(*page);
}

inline std::string report_failure(const ReportOptions& options) {
  const auto page = write_report(options);
  return page ? std::string() : message_of(page.error());
}

/// What parse_page.py reads in it.
inline nlohmann::json parsed(const std::filesystem::path& page) {
  const testing::ProcessResult read =
      testing::Process({testing::source_folder() + "/tests/workbench/report/parse_page.py", page.string()},
                       "/usr/bin/python3")
          .wait();
  REQUIRE_MESSAGE(read.exit_code == 0, read.err);
  return nlohmann::json::parse(read.out);
}

}  // namespace tangent::test
