// Simulated groups end to end: files, loading, results, page.
#include "workbench/analysis/write_analysis.h"

#include "tests/support/approx.h"
#include "tests/support/paths.h"
#include "workbench/analysis/analysis_figures.h"
#include "workbench/analysis/staircase_warnings.h"
#include "workbench/experiment/paper_results.h"
#include "workbench/experiment/run_simulated.h"
#include "workbench/experiment/simulated_group.h"
#include "workbench/session/own_folder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include <fcntl.h>
#include <unistd.h>

namespace tangent::analysis {

using test::approx;
namespace {

namespace fs = std::filesystem;
using namespace experiment;

std::string text_of(const fs::path& path) {
  std::ostringstream out;
  out << std::ifstream(path, std::ios::binary).rdbuf();
  return out.str();
}
fs::path shipped(const std::string& kind) {
  return fs::path(testing::source_folder()) / "presets" / "experiments" / (kind + ".toml");
}

/// Participants 1 to `count` in `folder`.
void simulate(const fs::path& folder, const std::string& kind, int count, bool pilot = false, int first = 1) {
  const std::string text = text_of(shipped(kind));
  const Protocol protocol = *parse_protocol(text, kind);
  for (int p = first; p < first + count; ++p) {
    Enrolment who{{"P" + std::to_string(p), "known", pilot}, 0, protocol_digest(protocol)};
    who.seed = default_seed(who.mark.participant, who.protocol_digest);
    const auto outcome = run_simulated(folder, protocol, text, who, {});
    REQUIRE_MESSAGE(outcome, (outcome ? "" : outcome.error().message()));
    REQUIRE_FALSE(outcome->stopped);
  }
}
Result<Answers> load(const fs::path& path, const LoadOptions& options = {}) {
  return load_answers(std::vector<fs::path>{path}, options);
}
std::string refusal(const Result<Answers>& answers) { return answers ? "" : answers.error().message(); }

TEST_CASE("a group of the paper's size gives the thresholds that it was made with, and the paper's differences") {
  const auto folder = OwnFolder::make();
  simulate(folder->path(), "discrimination", kPaperDiscriminationParticipants);
  const auto answers = load(folder->path());
  REQUIRE_MESSAGE(answers, refusal(answers));
  CHECK(answers->simulated);
  CHECK(answers->comparisons.size() == 12);
  const ComparisonResults results = comparison_results(answers->comparisons, 20);
  REQUIRE(results.conditions.size() == 4);
  for (const ConditionResult& condition : results.conditions) {
    CAPTURE(condition.condition);
    CHECK(condition.thresholds.size() == 12);
    const auto paper = std::find_if(kPaperThresholds.begin(), kPaperThresholds.end(),
                                    [&](const auto& row) { return row.condition == condition.condition; });
    // the group's own mean varies by half the paper's interval, the rule by a few percent
    CHECK(std::abs(condition.segments.mean - paper->segments) < 2.0 * paper->half_interval + 0.15 * paper->segments);
    CHECK(condition.mean_trials > 25.0);
    CHECK(condition.mean_trials < 60.0);
    CHECK(condition.degrees_low < condition.degrees);
    CHECK(condition.degrees < condition.degrees_high);
  }
  REQUIRE(results.between);
  CHECK(results.between->freedom_between == 3.0);
  CHECK(results.between->freedom_error == 44.0);
  CHECK(results.between->p < 0.001);
  REQUIRE(results.repeated);
  CHECK(results.repeated->freedom_error == 33.0);
  REQUIRE(results.pairs.size() == 6);
  CHECK(results.pairs[1].p < 0.05);  // C1, C3
  CHECK(results.pairs[4].p > 0.05);  // C2, C4: not different in the paper either
}

TEST_CASE("a group of the paper's size names objects as its Table 3 says") {
  const auto folder = OwnFolder::make();
  simulate(folder->path(), "identification", kPaperIdentificationParticipants);
  const auto answers = load(folder->path());
  REQUIRE_MESSAGE(answers, refusal(answers));
  REQUIRE(answers->namings.size() == 18);
  const NamingResults results =
      naming_results(answers->namings, {{"P1", true}, {"P2", false}, {"P3", true}, {"P4", false}});
  REQUIRE(results.parts.size() == 7);
  CHECK(results.parts[0].matrix.total() == 18 * 112);
  CHECK(std::abs(100.0 * results.parts[0].accuracy.ratio - kPaperAccuracyPercent) < 3.0);
  CHECK(std::abs(results.parts[0].information_bits.mean - 1.82) < 0.12);
  CHECK(results.parts[1].matrix.total() == results.parts[2].matrix.total());
  CHECK(results.parts[3].matrix.total() == results.parts[4].matrix.total());
  CHECK(results.parts[5].participants == 2);
  double largest = 0.0;
  for (std::size_t i = 0; i < 7; ++i)
    for (std::size_t j = 0; j < 7; ++j)
      largest = std::max(largest, std::abs(100.0 * results.parts[0].matrix.share(i, j) - kPaperConfusionPercent[i][j]));
  CHECK(largest < 10.0);  // of 288 answers a row: 3.4 deviations of the widest share
  int different = 0;
  for (const NamingTest& test : results.tests)
    different += test.values == "participants, paired" && test.test && test.test->p < 0.01;
  CHECK(different <= 1);  // shading and feedback change nothing in these participants
}

TEST_CASE("the page, its figures and tables say that the participants were simulated") {
  const auto folder = OwnFolder::make();
  const fs::path data = folder->path() / "data", out = folder->path() / "out";
  simulate(data, "discrimination", 2);
  simulate(data, "identification", 2);
  const auto answers = load(data);
  REQUIRE(answers);
  AnalysisOptions options;
  options.folder = out;
  options.command = "workbench analyse <data>";
  options.repeats = 20;
  const auto page = write_analysis(*answers, options);
  REQUIRE_MESSAGE(page, (page ? "" : page.error().message()));
  const std::string html = text_of(*page);
  CHECK(html.find("Nobody felt anything") != std::string::npos);
  CHECK(html.find("workbench analyse &lt;data&gt;") != std::string::npos);
  CHECK(html.find("<script") == std::string::npos);
  int figures = 0, tables = 0, plotted = 0;
  for (const auto& entry : fs::directory_iterator(out)) {
    const std::string name = entry.path().filename().string(), text = text_of(entry.path());
    CAPTURE(name);
    if (name.ends_with(".svg")) {
      ++figures;
      CHECK(text.find("simulated participants") != std::string::npos);
    } else if (text.starts_with("simulated,")) {
      ++tables;
      CHECK(text.find("\nyes,") != std::string::npos);
      CHECK(text.find("\nno,") == std::string::npos);
    } else if (name.ends_with(".csv")) {  // of a figure: numbers alone
      ++plotted;
      CHECK(text.substr(0, text.find('\n')).ends_with(",simulated"));
      CHECK(text.ends_with(",1\n"));
    } else {
      CHECK(name == "analysis.html");
    }
  }
  CHECK(plotted == figures);
  for (const auto& entry : fs::recursive_directory_iterator(data)) {
    if (!entry.is_regular_file() || entry.path().extension() == ".toml") continue;  // the protocol as it was
    if (entry.path().filename() == ".bidsignore") continue;
    CAPTURE(entry.path().string());
    CHECK(text_of(entry.path()).find("simulated") != std::string::npos);
  }
  CHECK(figures == 6);  // thresholds, two of staircases, accuracy, times, contact
  CHECK(tables ==
        14);  // conditions, rule, order, anova, pairs, staircases; parts, five confusions, times of objects, tests
}

TEST_CASE("files that were edited, mixed, doubled, foreign or missing are refused by name") {
  const auto folder = OwnFolder::make();
  const fs::path data = folder->path() / "data";
  simulate(data, "discrimination", 2);
  const fs::path rows = data / "sub-P1" / "beh" / "sub-P1_task-discrimination_beh.tsv";
  const std::string whole = text_of(rows);
  const auto put = [&](const std::string& text) { std::ofstream(rows, std::ios::binary) << text; };

  std::string edited = whole;
  edited.replace(edited.find("\tyes\tno\t"), 8, "\tno\tno\t");
  put(edited);
  CHECK(refusal(load(data)).find("changed by hand") != std::string::npos);
  CHECK(refusal(load(data)).find("sub-P1") != std::string::npos);
  const auto allowed = load(data, {.edited = true});
  REQUIRE(allowed);
  CHECK(allowed->left_out.size() == 1);

  for (const std::size_t left : {whole.size() - 20, whole.find('\n') + 1}) {  // all but one row; the header alone
    put(whole.substr(0, left));
    CHECK(refusal(load(data)).find("was cut at its end") != std::string::npos);
    const auto cut = load(data, {.edited = true});
    REQUIRE(cut);
    CHECK(cut->comparisons.size() == (left > 500 ? 2 : 1));
    CHECK(cut->left_out[0].find("was cut at its end") != std::string::npos);
  }
  std::string impossible = whole;
  impossible.replace(impossible.find("\t4\t"), 3, "\t-1\t");
  put(impossible);
  CHECK(refusal(load(data, {.edited = true})).find(":2") != std::string::npos);
  put(whole);

  fs::copy(data, folder->path() / "again", fs::copy_options::recursive);
  const std::vector<fs::path> twice{data, folder->path() / "again"};
  CHECK(refusal(load_answers(twice, {})).find("too") != std::string::npos);

  const fs::path sidecar = fs::path(rows).replace_extension(".json");
  const std::string json = text_of(sidecar);
  const auto without = [&](const std::string& from, const std::string& to) {
    std::string text = json;
    return text.replace(text.find(from), from.size(), to);
  };
  const std::pair<std::string, const char*> bad_sidecars[] = {
      {"{}", "it has no \"format\""},
      {"[]", "it has no \"format\""},
      {"7", "it has no \"format\""},
      {without("\"format\": 2", "\"format\": \"2\""), "its \"format\" is no whole number"},
      {without("\"pilot\": false", "\"pilot\": 0"), "its \"pilot\" is neither true nor false"},
      {without("\"participant\": \"P1\"", "\"participant\": null"), "its \"participant\" is no text"},
      {without("\"seed\": \"", "\"seed\": \"x"), "its \"seed\" is no whole number"},
      {without("\"starts\": [", "\"starts\": {}, \"were\": ["), "its \"starts\" are no list"}};
  for (const auto& [text, said] : bad_sidecars) {
    std::ofstream(sidecar) << text;
    const std::string why = refusal(load(data));
    CAPTURE(why);
    CHECK(why.find(std::string("is no sidecar of an experiment: ") + said) != std::string::npos);
    CHECK(why.find("exception") == std::string::npos);
  }
  fs::remove(sidecar);
  CHECK_FALSE(load(data));
  std::ofstream(sidecar) << json;

  for (const auto& entry : fs::directory_iterator(data))
    if (entry.path().extension() == ".toml") {
      const std::string text = text_of(entry.path());
      std::ofstream(entry.path(), std::ios::app) << "# a comment\n";
      CHECK(load(data));
      std::string other = text;
      other.replace(other.find("reversals = 11"), 14, "reversals = 13");
      std::ofstream(entry.path()) << other;
      CHECK(refusal(load(data)).find("was changed") != std::string::npos);
      std::ofstream(entry.path()) << text;
    }
  CHECK(load(data));
  CHECK_FALSE(load(folder->path() / "nothing"));
  fs::create_directory(folder->path() / "empty");
  CHECK(refusal(load(folder->path() / "empty")).find("no answers") != std::string::npos);
}

TEST_CASE("an object that the protocol does not have is refused by line, edited or not") {
  const auto folder = OwnFolder::make();
  simulate(folder->path(), "identification", 1);
  const fs::path rows = folder->path() / "sub-P1" / "beh" / "sub-P1_task-identification_beh.tsv";
  std::string text = text_of(rows);
  text.replace(text.find("\tsphere\t"), 8, "\t<script>\t");
  std::ofstream(rows, std::ios::binary) << text;
  CHECK(refusal(load(folder->path(), {.edited = true})).find("<script>") != std::string::npos);
}

TEST_CASE("pilot runs are left out unless asked for, and a person is not enrolled twice in two ways") {
  const auto folder = OwnFolder::make();
  simulate(folder->path(), "discrimination", 1, true);
  CHECK(refusal(load(folder->path())).find("pilot") != std::string::npos);
  const auto pilots = load(folder->path(), {.pilots = true});
  REQUIRE(pilots);
  CHECK(pilots->comparisons.size() == 1);
  CHECK(pilots->found == std::set<std::string>{"P1"});
  const std::string text = text_of(shipped("discrimination"));
  const Protocol protocol = *parse_protocol(text, "p");
  Enrolment who;
  who.mark = {"P1", "known", false};
  who.protocol_digest = protocol_digest(protocol);
  who.seed = default_seed("P1", who.protocol_digest);
  const auto again = run_simulated(folder->path(), protocol, text, who, {});
  REQUIRE_FALSE(again);
  CHECK(again.error().message().find("as a pilot run") != std::string::npos);
  who.mark = {"P1", "known", true};
  who.seed = 5;
  CHECK(run_simulated(folder->path(), protocol, text, who, {}).error().message().find("seed") != std::string::npos);
  for (const char* bad : {"", "a/b", "../x", "P 1", "anna", "P1\n"}) {
    who.mark.participant = bad;
    CHECK_FALSE(run_simulated(folder->path(), protocol, text, who, {}));
  }
}

TEST_CASE("participants come in the order of their numbers, and two kinds of simulated ones are not mixed") {
  const auto folder = OwnFolder::make();
  simulate(folder->path(), "discrimination", 3, false, 9);  // P9, P10, P11
  const auto answers = load(folder->path());
  REQUIRE(answers);
  REQUIRE(answers->comparisons.size() == 3);
  CHECK(answers->comparisons[0].name() == "P9");
  CHECK(answers->comparisons[2].name() == "P11");
  const std::string text = text_of(shipped("discrimination"));
  const Protocol protocol = *parse_protocol(text, "p");
  Enrolment who{{"P1", "feeling", false}, 1, protocol_digest(protocol)};
  REQUIRE(run_simulated(folder->path(), protocol, text, who, [] { return true; }));  // one answer
  const std::string why = refusal(load(folder->path()));
  CHECK(why.find("feeling") != std::string::npos);
  CHECK(why.find("known") != std::string::npos);
}

TEST_CASE("sessions that were joined, doubled or put in another order by hand are refused by line") {
  const auto folder = OwnFolder::make();
  simulate(folder->path(), "identification", 1);
  const fs::path rows = folder->path() / "sub-P1" / "beh" / "sub-P1_task-identification_beh.tsv";
  const std::string whole = text_of(rows);
  std::vector<std::string> lines;
  std::istringstream in(whole);
  for (std::string line; std::getline(in, line);) lines.push_back(line + "\n");
  REQUIRE(lines.size() == 113);
  const auto put = [&](std::size_t from, std::size_t to, const std::string& before, const std::string& after) {
    std::string text = before;
    for (std::size_t i = from; i < to; ++i) text += lines[i];
    std::ofstream(rows, std::ios::binary) << text + after;
  };
  std::string second;
  for (std::size_t i = 57; i < 113; ++i) second += lines[i];
  put(1, 57, lines[0] + second, "");  // the second session before the first
  CHECK(refusal(load(folder->path())).find(":2") != std::string::npos);
  put(0, 57, "", second + second);  // the second session twice
  CHECK(refusal(load(folder->path())).find(":114") != std::string::npos);
  put(0, 57, "", "");  // the first alone
  CHECK(refusal(load(folder->path())).find("56 of at least 112 rows are left") != std::string::npos);
  const auto half = load(folder->path(), {.edited = true});
  REQUIRE(half);
  CHECK(half->namings[0].rows.size() == 56);
}

TEST_CASE("a protocol that was deleted is asked for, and written again when its participant goes on") {
  const auto folder = OwnFolder::make();
  simulate(folder->path(), "discrimination", 1);
  const std::string text = text_of(shipped("discrimination"));
  const fs::path kept = folder->path() / ("protocol-" + protocol_digest(*parse_protocol(text, "p")) + ".toml");
  REQUIRE(fs::remove(kept));
  const std::string why = refusal(load(folder->path()));
  CAPTURE(why);
  for (const std::string& part : {kept.string(), std::string("is missing"), std::string("copy the protocol")})
    CHECK(why.find(part) != std::string::npos);
  simulate(folder->path(), "discrimination", 1);
  CHECK(text_of(kept) == text);
  CHECK(load(folder->path()));
}

/// What is written to the standard error while it exists, gnuplot's words included, into a file.
class ErrorsToFile {
 public:
  explicit ErrorsToFile(const fs::path& path) : before_(::dup(STDERR_FILENO)) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(file, STDERR_FILENO);
    ::close(file);
  }
  ~ErrorsToFile() {
    ::dup2(before_, STDERR_FILENO);
    ::close(before_);
  }
  ErrorsToFile(const ErrorsToFile&) = delete;
  ErrorsToFile& operator=(const ErrorsToFile&) = delete;

 private:
  int before_;
};

TEST_CASE("a single answer makes a page in which nothing is drawn that is not there") {
  const auto folder = OwnFolder::make();
  for (const std::string kind : {"discrimination", "identification"}) {
    CAPTURE(kind);
    const std::string text = text_of(shipped(kind));
    const Protocol protocol = *parse_protocol(text, kind);
    const fs::path data = folder->path() / kind, errors = folder->path() / "errors";
    const Enrolment who{{"P1", "known", false}, 1, protocol_digest(protocol)};
    REQUIRE(run_simulated(data, protocol, text, who, [] { return true; }));
    const auto answers = load(data);
    REQUIRE_MESSAGE(answers, refusal(answers));
    REQUIRE(answers->left_out.size() == 1);
    CHECK(answers->left_out[0].ends_with("not finished, 1 answer"));
    AnalysisOptions options;
    options.folder = folder->path() / ("out-" + kind);
    options.repeats = 20;
    Result<fs::path> page;
    {
      const ErrorsToFile caught(errors);
      page = write_analysis(*answers, options);
    }
    REQUIRE_MESSAGE(page, (page ? "" : page.error().message()));
    CHECK(text_of(errors) == "");
    CHECK(text_of(*page).find("1 participant, 1 answer.") != std::string::npos);
  }
  CHECK(thresholds_figure(ComparisonResults{}, false).script.empty());
}

TEST_CASE("an analysis that is stopped within a calibration leaves nothing behind") {
  const auto folder = OwnFolder::make();
  const fs::path data = folder->path() / "data", fresh = folder->path() / "new", old = folder->path() / "old";
  simulate(data, "discrimination", 1);
  fs::create_directory(old);
  const auto answers = load(data);
  REQUIRE(answers);
  for (const fs::path& out : {fresh / "out", old}) {
    int asked = 0;
    AnalysisOptions options;
    options.folder = out;
    options.repeats = 100'000;
    options.stop = [&] { return ++asked > 10; };
    const auto page = write_analysis(*answers, options);
    REQUIRE_FALSE(page);
    CHECK(page.error().message().find("stopped, nothing is written") != std::string::npos);
    CHECK(asked < 50);
  }
  CHECK_FALSE(fs::exists(fresh));
  CHECK(fs::exists(old));
  CHECK(fs::is_empty(old));
}

TEST_CASE("one who guesses is warned of, and one alone has no interval") {
  const auto folder = OwnFolder::make();
  simulate(folder->path(), "discrimination", 2);
  auto answers = load(folder->path());
  REQUIRE(answers);
  ParticipantAnswers<ComparisonRow>& guesser = answers->comparisons[1];
  KnownComparer guesses;
  for (const auto& condition : guesser.protocol.discrimination()->conditions)
    guesses.functions[condition.name] = {1e-3, 0.05, 0.0};
  guesser.rows.clear();
  auto run = ComparisonRun::start(guesser.protocol, 2, guesser.enrolment.seed);
  take_part(*run, guesses, 8, [&](const ComparisonRow& row) { guesser.rows.push_back(row); });
  const ComparisonResults results = comparison_results(answers->comparisons, 20);
  REQUIRE(results.staircases.size() == 8);
  for (const StaircaseResult& one : results.staircases) {
    CAPTURE(one.participant + " " + one.condition);
    CHECK(one.warnings.empty() == (one.participant == "P1"));
  }
  CHECK(staircases_with_warnings(results) == 4);
  for (const ConditionResult& condition : results.conditions) {
    CHECK(condition.warned == 1);
    CHECK(condition.low >= 3.0);  // the fewest that are shown
    CHECK(condition.degrees_high <= 51.68 / 2.0 + 0.01);
  }
  // What the figure draws is what the table says.
  const Figure figure = thresholds_figure(results, true);
  for (std::size_t c = 0; c < 4; ++c) CHECK(figure.data[0].table.rows[c][2] == results.conditions[c].low);
  std::vector<std::string> warned;
  AnalysisOptions options;
  options.folder = folder->path() / "out";
  options.repeats = 20;
  options.warn = [&](const std::string& text) { warned.push_back(text); };
  const auto page = write_analysis(*answers, options);
  REQUIRE(page);
  CHECK(warned.size() >= 4);
  CHECK(warned[0].find("staircase of P2 under C") != std::string::npos);
  CHECK(text_of(*page).find("4 of 8 staircases have a warning") != std::string::npos);
  answers->comparisons.pop_back();
  for (const ConditionResult& alone : comparison_results(answers->comparisons, 20).conditions)
    for (const double end : {alone.low, alone.high, alone.degrees_low, alone.degrees_high}) CHECK(std::isnan(end));
}

TEST_CASE("guessing: the chance of so many right answers") {
  CHECK(guessing_probability(0, 5) == 1.0);
  CHECK(guessing_probability(5, 5) == approx(1.0 / 32.0));
  CHECK(guessing_probability(3, 4) == approx(5.0 / 16.0));
}

TEST_CASE("tests of names are over participants, paired, and say how many, and the paper's stand beside them") {
  const auto folder = OwnFolder::make();
  simulate(folder->path(), "identification", 6);
  auto answers = load(folder->path());
  REQUIRE(answers);
  // One participant is slower in everything; all are half a second slower without display.
  for (auto& one : answers->namings)
    for (NamingRow& row : one.rows) {
      row.since_touch_s =
          (one.name() == "P3" ? 30.0 : 8.0) + (row.tactile ? 0.0 : 0.5 + 0.001 * double(one.name()[1] % 3));
      row.right = true;
    }
  const NamingResults results = naming_results(answers->namings, {{"P1", true}, {"P2", true}, {"P3", false}});
  const auto find = [&](const std::string& question, const std::string& values) {
    const auto found = std::find_if(results.tests.begin(), results.tests.end(), [&](const NamingTest& test) {
      return test.question == question && test.values.starts_with(values);
    });
    REQUIRE(found != results.tests.end());
    return *found;
  };
  const std::string times = "response time of right answers: tactile less force alone";
  const NamingTest paired = find(times, "participants, paired"), apart = find(times, "answers as independent");
  CHECK(paired.count == 6);
  REQUIRE(paired.test);
  CHECK(paired.test->freedom == 5.0);
  CHECK(paired.test->difference == approx(-0.5).epsilon(0.02));
  CHECK(paired.test->p < 1e-6);
  CHECK(apart.count == 6 * 112);
  REQUIRE(apart.test);
  CHECK(apart.test->p > 0.2);  // lost among participants
  const NamingTest groups = find("response time of right answers: experienced less inexperienced", "participants");
  CHECK(groups.count == 3);
  CHECK_FALSE(groups.test);  // one alone on one side
}

TEST_CASE("experience is read from participants.tsv") {
  const auto folder = OwnFolder::make();
  const fs::path file = folder->path() / "participants.tsv";
  std::ofstream(file) << "participant_id\tage\texperience\nsub-P1\t20\tyes\nP2\t30\tno\n\nP1\t20\tyes\n";
  const std::set<std::string> all{"P1", "P2", "P3"};
  const auto read = read_experience(file, all);
  REQUIRE(read);
  CHECK(*read == std::map<std::string, bool>{{"P1", true}, {"P2", false}});
  std::ofstream(file) << "participant_id\texperience\nP1\tmaybe\n";
  CHECK(read_experience(file, all).error().message().find("maybe") != std::string::npos);
  std::ofstream(file) << "name\n";
  CHECK_FALSE(read_experience(file, all));
  std::ofstream(file) << "participant_id\texperience\nP1\tyes\n\nsub-P1\tno\n";
  const auto both = read_experience(file, all);
  REQUIRE_FALSE(both);
  CHECK(both.error().where == file.string() + ":4");
  CHECK(both.error().what.find("line 2") != std::string::npos);
  std::ofstream(file) << "participant_id\texperience\nP1\tyes\nP9\tno\n";
  const auto foreign = read_experience(file, all);
  REQUIRE_FALSE(foreign);
  CHECK(foreign.error().where == file.string() + ":3");
  CHECK(foreign.error().what.find("\"P9\" is not in the data") != std::string::npos);
}

/// Tukey's test on groups that are made: how often it finds a difference that is there.
TEST_CASE("power: a difference between two conditions is found as often as theory says") {
  // Participants' log thresholds differ by one deviation, twelve of them: paired t, 0.05. Theory (noncentral t): 0.89.
  int found = 0;
  constexpr int kGroups = 400;
  SplitMix random(3);
  for (int g = 0; g < kGroups; ++g) {
    std::vector<double> a, b;
    for (int p = 0; p < 12; ++p) {
      const auto normal = [&] {
        double sum = -6.0;
        for (int i = 0; i < 12; ++i) sum += random.unit();
        return sum;
      };
      const double own = normal();
      a.push_back(own);
      b.push_back(own + 1.0 + normal());
    }
    found += paired_t_test(a, b)->p < 0.05;
  }
  MESSAGE("found in ", found, " of ", kGroups);
  CHECK(std::abs(found / static_cast<double>(kGroups) - 0.886) < 0.05);
}

}  // namespace
}  // namespace tangent::analysis
