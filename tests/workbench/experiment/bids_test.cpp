// A folder of answers against the rules of BIDS 1.9 that it comes under: names, tables, sidecars, dates.
#include "tests/workbench/experiment/trial_fixture.h"
#include "workbench/experiment/bids_dataset.h"
#include "workbench/experiment/utc_time.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <regex>

namespace tangent::experiment {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::Bench;

constexpr std::int64_t kMonday_s = 1'764'000'000;  // 2025-11-24T16:00:00Z

using TsvTable = std::vector<Fields>;
TsvTable tsv_of(const fs::path& path) {
  TsvTable out;
  std::istringstream in(test::text_in(path));
  for (std::string line; std::getline(in, line);) {
    out.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, '\t');) out.back().push_back(field);
  }
  return out;
}
std::size_t place_of(const TsvTable& table, const std::string& column) {
  return static_cast<std::size_t>(std::find(table[0].begin(), table[0].end(), column) - table[0].begin());
}
double onset_of(const Fields& row, std::size_t place) { return std::stod(row.at(place)); }

/// One at a device, with a second start an hour later, and two simulated ones.
struct Dataset {
  Dataset() : bench(test::short_comparison(), at(kMonday_s)) {
    bench.answer(2);
    bench.trials->note("asked for water");
    bench.trials.reset();
    bench.start(test::short_comparison(), at(kMonday_s + 3600));
    bench.answer(3);
    bench.trials.reset();
    for (const char* name : {"P2", "P3"}) {
      const Protocol protocol = *parse_protocol(test::short_comparison(), "short.toml");
      const Enrolment who{{name, "known", false}, 1, protocol_digest(protocol)};
      REQUIRE(run_simulated(bench.folder(), protocol, test::short_comparison(), who, {}));
    }
    for (const auto& entry : fs::recursive_directory_iterator(bench.folder()))
      if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), bench.folder()));
  }
  static std::function<void(TrialOptions&)> at(std::int64_t utc_s) {
    return [utc_s](TrialOptions& options) { options.utc_s = [utc_s] { return utc_s; }; };
  }
  fs::path operator/(const fs::path& file) const { return bench.folder() / file; }

  Bench bench;
  std::vector<fs::path> files;
};

TEST_CASE("every file of a dataset has a name after BIDS, or .bidsignore has it") {
  const Dataset dataset;
  const std::regex named(
      R"(dataset_description\.json|README|participants\.(tsv|json)|scans\.json|\.bidsignore|sub-([A-Za-z0-9]+)/sub-\2_scans\.tsv|)"
      R"(sub-([A-Za-z0-9]+)/beh/sub-\3_task-[a-z]+_(beh|events)\.(tsv|json))");
  const std::regex ignored(R"(protocol-[0-9a-f]{16}\.toml|.*_(beh|events)\.csv|.*_recordings/.*)");
  int beh = 0;
  for (const fs::path& file : dataset.files) {
    CAPTURE(file.string());
    CHECK((std::regex_match(file.string(), named) || std::regex_match(file.string(), ignored)));
    beh += file.string().ends_with("_beh.tsv");
  }
  CHECK(beh == 3);
  for (const char* pattern : {"protocol-*.toml", "*_beh.csv", "*_events.csv", "*_recordings"})
    CHECK(test::text_in(dataset / ".bidsignore").find(pattern) != std::string::npos);
  const json description = json::parse(test::text_in(dataset / "dataset_description.json"));
  CHECK(description.at("Name").is_string());
  CHECK(description.at("BIDSVersion").is_string());
  CHECK(description.at("DatasetType") == "raw");
  CHECK(description.at("GeneratedBy").at(0).at("Name") == "Tangent Workbench");
}

TEST_CASE("each table has whole rows without empty fields, and each column its meaning at the sidecar's top") {
  const Dataset dataset;
  for (const fs::path& file : dataset.files) {
    if (file.extension() != ".tsv") continue;
    CAPTURE(file.string());
    const TsvTable table = tsv_of(dataset / file);
    REQUIRE(table.size() >= 2);
    CHECK(std::set<std::string>(table[0].begin(), table[0].end()).size() == table[0].size());
    for (const Fields& row : table) {
      REQUIRE(row.size() == table[0].size());
      for (const std::string& field : row) CHECK_FALSE(field.empty());
    }
    const bool scans = file.string().ends_with("_scans.tsv");
    const fs::path described = scans ? dataset / "scans.json" : fs::path(dataset / file).replace_extension(".json");
    const json sidecar = json::parse(test::text_in(described));
    for (const std::string& column : table[0]) {
      if (scans && (column == "filename" || column == "acq_time")) continue;  // BIDS has these
      CAPTURE(column);
      REQUIRE(sidecar.contains(column));
      CHECK(sidecar[column].at("Description").is_string());
    }
    if (file.string().ends_with("_beh.tsv"))
      CHECK(file.string().find("_task-" + sidecar.at("TaskName").get<std::string>()) != std::string::npos);
  }
}

TEST_CASE("participants and scans are listed once each, with dates, and what is no file of theirs is not") {
  const Dataset dataset;
  const TsvTable people = tsv_of(dataset / "participants.tsv");
  CHECK(people ==
        TsvTable{{"participant_id", "simulated"}, {"sub-P1", "device"}, {"sub-P2", "known"}, {"sub-P3", "known"}});
  const TsvTable scans = tsv_of(dataset / "sub-P1/sub-P1_scans.tsv");
  CHECK(scans == TsvTable{{"filename", "acq_time", "simulated"},
                          {"beh/sub-P1_task-discrimination_beh.tsv", "2025-11-24T16:00:00Z", "device"}});
  for (const char* name : {"P1", "P2", "P3"}) {
    const TsvTable own = tsv_of(dataset / ("sub-" + std::string(name)) / ("sub-" + std::string(name) + "_scans.tsv"));
    for (std::size_t i = 1; i < own.size(); ++i) {
      CHECK(fs::exists(dataset / ("sub-" + std::string(name)) / own[i][0]));
      CHECK(utc_of(own[i][1]).has_value());
    }
  }
}

TEST_CASE("onsets count from the first start, through a resume, and events tell every interval") {
  const Dataset dataset;
  const TsvTable events = tsv_of(dataset / "sub-P1/beh/sub-P1_task-discrimination_events.tsv");
  CHECK(events[0][0] == "onset");
  CHECK(events[0][1] == "duration");
  std::map<std::string, int> kinds;
  double before_s = 0.0;
  for (std::size_t i = 1; i < events.size(); ++i) {
    CHECK(onset_of(events[i], 0) >= before_s);
    before_s = onset_of(events[i], 0);
    CHECK(events[i][1] == "n/a");
    ++kinds[events[i][2]];
  }
  CHECK(before_s > 3600.0);
  CHECK(kinds ==
        std::map<std::string, int>{
            {"started", 2}, {"armed", 2}, {"training", 2}, {"trial", 5}, {"second", 3}, {"note", 1}, {"ended", 2}});
  const TsvTable rows = tsv_of(dataset / "sub-P1/beh/sub-P1_task-discrimination_beh.tsv");
  const std::size_t onset = place_of(rows, "onset");
  REQUIRE(rows.size() == 4);
  CHECK(onset_of(rows[2], onset) < 60.0);
  CHECK(onset_of(rows[3], onset) > 3600.0);
}

TEST_CASE("a lab's own columns of participants.tsv stay, and a line that was torn by a kill is cut off") {
  const auto folder = OwnFolder::make();
  const fs::path file = folder->path() / "participants.tsv";
  std::ofstream(file) << "participant_id\tage\tsimulated\nsub-P1\t31\tno\nsub-P";
  REQUIRE(list_participant(folder->path(), {"P1", "no", false}));
  REQUIRE(list_participant(folder->path(), {"P2", "known", false}));
  CHECK(test::text_in(file) == "participant_id\tage\tsimulated\nsub-P1\t31\tno\nsub-P2\tn/a\tknown\n");
  std::ofstream(folder->path() / "README") << "ours\n";
  REQUIRE(describe_dataset(folder->path()));
  CHECK(test::text_in(folder->path() / "README") == "ours\n");
}

TEST_CASE("two names that differ by small and capital letters alone are not both enrolled") {
  const auto folder = OwnFolder::make();
  const Protocol protocol = *parse_protocol(test::short_comparison(), "short.toml");
  const auto run = [&](const char* name) {
    const Enrolment who{{name, "known", false}, 1, protocol_digest(protocol)};
    return run_simulated(folder->path(), protocol, test::short_comparison(), who, {});
  };
  REQUIRE(run("P2"));
  const auto twin = run("p2");
  REQUIRE_FALSE(twin);
  CHECK(twin.error().message().find("differs from P2 by small and capital letters alone") != std::string::npos);
  CHECK_FALSE(fs::exists(folder->path() / "sub-p2"));
  CHECK(run("P2"));
}

TEST_CASE("dates are read as they are written, and nothing else is") {
  CHECK(utc_text(kMonday_s) == "2025-11-24T16:00:00Z");
  CHECK(utc_of("2025-11-24T16:00:00Z") == kMonday_s);
  for (const char* wrong : {"", "2025-11-24", "2025-11-24T16:00:00", "2025-11-24T16:00:00Z ", "2025-13-24T16:00:00Z"})
    CHECK_FALSE(utc_of(wrong).has_value());
}

}  // namespace
}  // namespace tangent::experiment
