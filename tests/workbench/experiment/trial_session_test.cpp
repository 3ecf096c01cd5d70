// Trials with a scripted finger that touches, raises and presses.
#include "workbench/experiment/trial_session.h"

#include "tests/workbench/experiment/trial_fixture.h"
#include "workbench/recording/replay.h"

#include <csignal>

#include <sys/resource.h>

namespace tangent::experiment {
namespace {

using test::Bench;

TEST_CASE("a whole comparison experiment: touched, raised, answered, written") {
  Bench bench(test::short_comparison());
  CHECK(bench.phase() == Phase::training);
  CHECK(bench.trials->participant().show_scene);
  bench.answer();
  REQUIRE(bench.trials->finished());
  CHECK(bench.trials->operator_view().fault.empty());
  REQUIRE(bench.trials->end());
  const ReadRows table = bench.table();
  CHECK(table.complaint.empty());
  REQUIRE(table.rows.size() >= 6);
  for (const Fields& fields : table.rows) {
    const auto row = comparison_row(table.columns, fields);
    REQUIRE(row);
    CHECK(row->first.simulated == "device");
    CHECK(row->second.second_touching_s > 0.05);
    CHECK(row->second.second_touching_s < 0.45);
    CHECK(row->second.second_s > row->second.second_touching_s);
    const auto origin = row_origin(table.columns, fields);
    REQUIRE(origin);
    CHECK(origin->interruptions == 0);
    CHECK(origin->sound == "none");
    CHECK(origin->device.find("simulated") != std::string::npos);
    for (const std::string& digest : {origin->mesh, origin->preset, origin->program, origin->protocol})
      CHECK(digest.size() == 16);
  }
  const std::string sidecar_text =
      test::text_in(std::filesystem::path(bench.trials->rows()).replace_extension(".json"));
  for (const char* part : {"\"program\"", "\"preset\"", "\"stimuli\"", "exact arc"})
    CHECK(sidecar_text.find(part) != std::string::npos);
}

TEST_CASE("a whole naming experiment: drawn to the start, a ding, named while touching, no push in between") {
  Bench bench(test::short_naming());
  double most_n = 0.0, most_away_n = 0.0, most_step_n = 0.0;
  Vec3 before(0.0);
  const auto watch = [&] {
    const History& history = bench.trials->session().history();
    for (std::size_t i = history.lower_bound(history.newest().tick.tick - 15); i < history.size(); ++i) {
      const DeviceTelemetry& device = history[i].device;
      const double force_n = glm::length(device.force_command_n);
      most_n = std::max(most_n, force_n);
      if (device.surface_share == 0.0F) most_away_n = std::max(most_away_n, force_n);
      if (device.surface_share < 1.0F)
        most_step_n = std::max(most_step_n, glm::length(device.force_command_n - before));
      before = device.force_command_n;
    }
  };
  bench.every = watch;
  bench.answer();
  REQUIRE(bench.trials->finished());
  CHECK(most_n > 0.5);
  CHECK(most_away_n <= 1.0 + 1e-9);                                      // the pull's limit
  CHECK(most_away_n > 0.05);                                             // there was one
  CHECK(most_step_n < 2.0 * most_n / (1000.0 * kSurfaceFade_s) + 0.05);  // faded out, tick by tick
  REQUIRE(bench.trials->end());
  const ReadRows table = bench.table();
  REQUIRE(table.rows.size() == 8);
  for (const Fields& fields : table.rows) {
    const auto row = naming_row(table.columns, fields);
    REQUIRE(row);
    CHECK(row->second.answer == "cube");
    CHECK(row->second.touching_s > 0.05);
    CHECK(row->second.touching_s <= row->second.since_touch_s);
  }
}

TEST_CASE("a stimulus stays away while the finger is where it would push, and comes once it is raised") {
  Bench bench(test::short_comparison());
  bench.trials->press(TrialKey::stop);
  bench.touch();
  bench.to(Vec3(0.0, 0.0, 0.005));  // 15 mm in
  bench.trials->press(TrialKey::resume);
  bench.run(500);
  CHECK(bench.tick().device.force_command_n == Vec3(0.0));
  CHECK_FALSE(bench.trials->operator_view().touching);
  bench.raise();
  bench.touch();
  CHECK(bench.trials->operator_view().touching);
  CHECK(glm::length(bench.tick().device.force_command_n) > 0.5);
}

TEST_CASE("an unplugged device pauses, is told, and the pair that was cut is begun again and marked") {
  Bench bench(test::short_comparison());
  bench.answer(1);
  bench.step();
  REQUIRE(bench.phase() == Phase::second);
  bench.touch();
  bench.script->fault = DeviceFault::disconnected;
  bench.run(100);
  CHECK(bench.trials->operator_view().paused);
  CHECK(bench.trials->operator_view().fault.find("force device") != std::string::npos);
  CHECK(bench.trials->participant().prompt.find("break") != std::string::npos);
  bench.press(TrialKey::enter);  // not taken
  bench.raise();
  bench.trials->press(TrialKey::resume);
  bench.run(1500);
  REQUIRE(bench.trials->operator_view().fault == "");
  CHECK(bench.phase() == Phase::first);
  CHECK(bench.trials->answers() == 1);
  bench.answer(3);
  REQUIRE(bench.trials->end());
  const ReadRows table = bench.table();
  REQUIRE(table.rows.size() == 3);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(row_origin(table.columns, table.rows[i])->interruptions == (i == 1 ? 1 : 0));
  const std::string events = test::text_in(events_path(bench.trials->rows()));
  for (const char* event : {"started", "paused", "resumed", "ended"}) CHECK(events.find(event) != std::string::npos);
}

TEST_CASE("stopped by the operator: no force at once, notes with their time, and on it goes") {
  Bench bench(test::short_comparison());
  bench.answer(1);
  bench.touch();
  bench.trials->press(TrialKey::stop);
  bench.trials->session().advance(2);
  CHECK(bench.tick().device.force_command_n == Vec3(0.0));
  bench.run(16);
  bench.trials->note("asked for\twater");
  CHECK(bench.trials->operator_view().notes.back().find("asked for\twater") != std::string::npos);
  bench.raise();
  bench.press(TrialKey::resume);
  bench.run(400);
  bench.answer(2);
  CHECK(bench.trials->answers() == 2);
  REQUIRE(bench.trials->end());
  CHECK(test::text_in(events_path(bench.trials->rows())).find("asked for water") != std::string::npos);
}

TEST_CASE("ended and started again, it goes on at the same stimulus, to the same rows") {
  Bench whole(test::short_comparison()), parts(test::short_comparison());
  whole.answer();
  parts.answer(2);
  parts.step();  // half of the third
  const OperatorView before = parts.trials->operator_view();
  parts.trials.reset();
  parts.start(test::short_comparison());
  parts.step();  // training
  parts.step();
  CHECK(parts.trials->operator_view().stimulus == before.stimulus);
  parts.answer();
  const ReadRows a = whole.table(), b = parts.table();
  REQUIRE(a.rows.size() == b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i) {
    const auto one = comparison_row(a.columns, a.rows[i])->second, two = comparison_row(b.columns, b.rows[i])->second;
    CHECK(one.segments == two.segments);
    CHECK(one.reference == two.reference);
    CHECK(row_origin(b.columns, b.rows[i])->interruptions == (i == 2 ? 1 : 0));
  }
  parts.trials.reset();
  const auto again = parts.try_start(test::short_comparison());
  REQUIRE_FALSE(again);
  CHECK(again.error().message().find("answered everything") != std::string::npos);
}

TEST_CASE("nobody is enrolled twice at once, under no name of BIDS, or without a device") {
  Bench bench(test::short_comparison());
  CHECK(bench.try_start(test::short_comparison()).error().message().find("in use") != std::string::npos);
  for (const char* name : {"P-1", "sub--1", "P_1", ""}) {
    const auto refused = bench.try_start(test::short_comparison(),
                                         [&](TrialOptions& options) { options.enrolment.mark.participant = name; });
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message().find("BIDS") != std::string::npos);
  }
  TrialOptions options;
  options.protocol = *parse_protocol(test::short_comparison(), "short.toml");
  options.out = bench.folder() / "nobody";
  options.enrolment.mark.participant = "P2";
  options.session.threaded = false;
  options.session.devices = {"none", "simulated"};
  CHECK(TrialSession::start(options).error().message().find("no force device") != std::string::npos);
  options.session.devices = {"simulated", "none"};
  CHECK(TrialSession::start(options).error().message().find("display") != std::string::npos);  // C3 needs one
  CHECK_FALSE(std::filesystem::exists(options.out));
}

std::string events_of(const Bench& bench) { return test::text_in(events_path(bench.trials->rows())); }
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_CASE("a fresh start arms and resumes nothing, a pause is told with its length") {
  Bench bench(test::short_comparison());
  CHECK_FALSE(has(events_of(bench), "resumed"));
  CHECK(has(events_of(bench), "\tarmed\t"));
  bench.trials->press(TrialKey::stop);
  bench.run(2000);
  bench.press(TrialKey::resume);
  CHECK(has(events_of(bench), "\tpaused\t0\tstopped by the operator"));
  CHECK(has(events_of(bench), "\tresumed\t0\tgoes on after 2.0 s"));
}

void second_person(TrialOptions& options) {
  options.enrolment.mark.participant = "P2";
  options.without_timeout = true;
}

TEST_CASE("a device that is missing is said at the start, before any key, and no longer once it is there") {
  Bench bench(test::short_comparison());
  bench.trials.reset();
  bench.plug.real = bench.plug.absent = true;
  bench.start(test::short_comparison(), second_person);
  CHECK(bench.trials->operator_view().paused);
  CHECK(has(bench.trials->operator_view().fault, "the force device is not there"));
  CHECK(has(events_of(bench), "\tpaused\t0\t"));
  CHECK(has(events_of(bench), "is not there"));
  bench.press(TrialKey::resume);
  CHECK(bench.trials->operator_view().paused);
  bench.script->absent = false;
  bench.run(100);
  CHECK(has(bench.trials->operator_view().fault, "not armed yet"));
  bench.trials->press(TrialKey::resume);
  bench.run(1500);
  CHECK(bench.trials->operator_view().fault == "");
  CHECK_FALSE(bench.trials->operator_view().paused);
}

TEST_CASE("resumed before the device has answered at all, nothing arms") {
  Bench bench(test::short_comparison());
  bench.trials.reset();
  bench.plug.real = true;
  bench.trials = *bench.try_start(test::short_comparison(), second_person);
  bench.trials->press(TrialKey::resume);
  CHECK(bench.trials->operator_view().paused);
  CHECK(has(bench.trials->operator_view().fault, "has not answered yet"));
}

TEST_CASE("the device's own force bounds what the protocol allows, and the start says which of them does") {
  std::string text = test::short_comparison();
  Bench small(text);
  CHECK(has(events_of(small), "force limit 6 N;"));
  text.replace(text.find("limit_n\" = 6.0"), 14, "limit_n\" = 99.0");
  Bench large(text);
  const double own_n = large.trials->session().force_capabilities()->peak_force_n;
  REQUIRE(own_n < 99.0);
  CHECK(has(events_of(large), "the device's own (the protocol allows 99 N)"));
  double most_n = 0.0;
  large.every = [&] { most_n = std::max(most_n, glm::length(large.tick().device.force_command_n)); };
  large.answer(1);
  CHECK(most_n > 0.1);
  CHECK(most_n <= own_n);
}

TEST_CASE("a table that was cut at its end is neither gone on with nor taken for a short one") {
  Bench bench(test::short_comparison());
  bench.answer(3);
  const std::filesystem::path rows = bench.trials->rows(), events = events_path(rows);
  const std::string running = test::text_in(rows);
  const auto without_last = [](std::string text, int lines) {
    for (; lines > 0; --lines) text.resize(text.rfind('\n', text.size() - 2) + 1);
    return text;
  };
  const auto put = [](const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
  };
  // While it runs, or after it was killed: events know that a later trial was begun.
  const auto sidecar = read_sidecar(rows);
  REQUIRE(sidecar);
  CHECK(sidecar->least == RowCounts{0, 0});
  CHECK(*events_complaint(rows, *sidecar, 3) == "");
  CHECK(has(*events_complaint(rows, *sidecar, 1), "was begun after 1 answer"));
  bench.trials.reset();
  const std::string whole = test::text_in(rows), told = test::text_in(events);
  CHECK(whole == running);
  CHECK(read_sidecar(rows)->least.answers == 3);
  put(rows, without_last(whole, 1));
  const auto cut = bench.try_start(test::short_comparison());
  REQUIRE_FALSE(cut);
  CHECK(has(cut.error().message(), "2 of at least 3 rows are left"));
  put(rows, whole);
  put(events, without_last(told, 2));
  const auto fewer = bench.try_start(test::short_comparison());
  REQUIRE_FALSE(fewer);
  CHECK(has(fewer.error().message(), "events.tsv"));
  CHECK(has(*events_complaint(rows, *read_sidecar(rows), 3), "rows are left"));
  std::string gap = told;
  gap.erase(gap.find('\n') + 1, gap.find('\n', gap.find('\n') + 1) - gap.find('\n'));  // its first row
  put(events, gap);
  CHECK(has(*events_complaint(rows, *read_sidecar(rows), 3), "checksum does not hold"));
  std::filesystem::remove(events);
  CHECK(has(*events_complaint(rows, *read_sidecar(rows), 3), "is missing"));
  put(events, told);
  CHECK(bench.try_start(test::short_comparison()));
}

TEST_CASE("a sidecar that was changed is blamed itself, not the table's first row") {
  Bench bench(test::short_comparison());
  bench.answer(1);
  const std::filesystem::path rows = bench.trials->rows(), sidecar = sidecar_path(rows);
  bench.trials.reset();
  std::string text = test::text_in(sidecar);
  std::ofstream(sidecar) << text.replace(text.find("\"seed\": \"5\""), 11, "\"seed\": \"6\"");
  const auto read = read_sidecar(rows);
  REQUIRE_FALSE(read);
  CHECK(has(read.error().message(), "_beh.json"));
  CHECK(has(read.error().message(), "do not fit its digest"));
}

TEST_CASE("the participant's words tell nothing of a stimulus") {
  Bench bench(test::short_comparison());
  std::map<Phase, std::set<std::string>> prompts;
  bench.every = [&] {
    const ParticipantView view = bench.trials->participant();
    if (view.hint.empty()) prompts[view.phase].insert(view.prompt);
    if (view.phase != Phase::training) CHECK_FALSE(view.show_scene);
  };
  bench.answer(5);
  for (const Phase phase : {Phase::first, Phase::second}) {
    CHECK(prompts[phase].size() == 1);
    for (const char* word : {"segments", "arc", "C1", "C3"})
      CHECK(prompts[phase].begin()->find(word) == std::string::npos);
  }
}

/// No file grows beyond this while it exists.
class FileLimit {
 public:
  explicit FileLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    rlimit now = before_;
    now.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &now);
  }
  ~FileLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST_CASE("a full disk: the answer is kept and written once there is room, nothing is shown meanwhile") {
  Bench bench(test::short_comparison());
  bench.answer(1);
  bench.step();
  REQUIRE(bench.phase() == Phase::second);  // the events have it, too
  const std::size_t rows = std::filesystem::file_size(bench.trials->rows());
  {
    const FileLimit full(rows + 20);  // half a row
    bench.step();
    CHECK(bench.trials->operator_view().paused);
    CHECK(bench.trials->operator_view().fault.find("can't be written") != std::string::npos);
    bench.press(TrialKey::resume);
    CHECK(bench.trials->operator_view().paused);
    CHECK(std::filesystem::file_size(bench.trials->rows()) == rows);
  }
  bench.raise();
  bench.press(TrialKey::resume);
  CHECK_FALSE(bench.trials->operator_view().paused);
  CHECK(bench.table().rows.size() == 2);
  bench.run(400);
  bench.answer(3);
  REQUIRE(bench.trials->end());
  const ReadRows table = bench.table();
  CHECK(table.complaint.empty());
  REQUIRE(table.rows.size() == 3);
  CHECK(comparison_row(table.columns, table.rows[2])->second.trial == 2);
  const std::string csv = test::text_in(std::filesystem::path(bench.trials->rows()).replace_extension(".csv"));
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 4);
}

TEST_CASE("each trial's recording replays tick by tick") {
  Bench bench(test::short_comparison(), [](TrialOptions& options) { options.record = true; });
  bench.answer(2);
  const ReadRows table = bench.table();
  REQUIRE(bench.trials->end());
  for (const Fields& fields : table.rows) {
    const std::filesystem::path file =
        bench.trials->rows().parent_path() / row_origin(table.columns, fields)->recording;
    const auto report = replay(file);
    REQUIRE(report);
    CHECK(report->same());
    CHECK(report->checked > 800);
  }
}

}  // namespace
}  // namespace tangent::experiment
