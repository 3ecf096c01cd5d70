// workbench devices --check: a bring-up by lines of a pipe, in simulated time.
#include "tests/support/paths.h"
#include "tests/support/process.h"
#include "tests/support/temp_folder.h"
#include "workbench/cli/answer_keys.h"
#include "workbench/cli/command.h"

#include <nlohmann/json.hpp>

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

namespace tangent {
namespace {

using testing::contains;
using testing::ProcessResult;
using testing::TempFolder;

/// `lines`: a command of the shell that writes them.
ProcessResult check_by_lines(const std::string& lines, const std::string& name, const std::string& out) {
  const std::string command = lines + " | \"$0\" devices --check \"$1\" --without-waiting --limit-n 0.2 --out \"$2\"";
  return testing::Process({"-c", command, testing::program(), name, out}, "/bin/sh").wait();
}

}  // namespace

TEST_CASE("devices --check: every simulated device passes, with a protocol and a page") {
  for (const char* name : {"simulated", "ideal", "scheduled", "tilt"}) {
    CAPTURE(name);
    const TempFolder folder;
    const ProcessResult run = check_by_lines("yes yes", name, folder.file("p.json"));
    CHECK(run.exit_code == 0);
    CHECK(run.err.empty());
    CHECK(contains(run.out, "Direction of force: proved"));
    CHECK(contains(run.out, "All that is needed was proved. Left open:\n  Watchdog: not proved"));
    const auto json = nlohmann::json::parse(testing::read_text(folder.file("p.json")));
    CHECK(json["all_proved"] == true);
    CHECK(json["kind"] == name);
    CHECK(json["measured"]["pushes"].size() == 9);
    CHECK(contains(testing::read_text(folder.file("p.md")), "# Bring-up of simulated force device"));
  }
}

TEST_CASE("devices --check: a refusal, a stop and the end of the input leave with 1 and a protocol") {
  struct Way {
    const char* lines;
    const char* says;
  };
  for (const Way& way : {Way{"printf 'no\\n'", "Homing: failed. it was refused"},
                         Way{"printf 'yes\\nyes\\nstop\\n'", "At rest: failed. stopped by the person"},
                         Way{"printf 'yes\\nyes'", "failed. stopped by the person"}}) {
    const std::string says = way.says;
    CAPTURE(says);
    const TempFolder folder;
    const ProcessResult run = check_by_lines(way.lines, "simulated", folder.file("p.json"));
    CHECK(run.exit_code == 1);
    CHECK(contains(run.out, way.says));
    CHECK(contains(run.out, "Not all proved"));
    CHECK(std::filesystem::exists(folder.file("p.json")));
  }
}

TEST_CASE("devices --check: a line that is no answer stops it, and says what there is") {
  const TempFolder folder;
  const ProcessResult run = check_by_lines("printf 'yes\\nperhaps\\nyes\\n'", "simulated", folder.file("p.json"));
  CHECK(run.exit_code == 1);
  CHECK(contains(run.err, "perhaps"));
  CHECK(contains(run.err, "write yes, no, skip or stop"));
}

TEST_CASE("devices --check: wrong usage leaves with 2") {
  const auto wrong = [](std::vector<std::string> more) {
    std::vector<std::string> arguments{"devices"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return testing::run_workbench(std::move(arguments)).exit_code;
  };
  CHECK(wrong({"--check", "none"}) == 2);
  CHECK(wrong({"--check", "nothing-like-it"}) == 2);
  CHECK(wrong({"--check"}) == 2);
  CHECK(wrong({"--out", "p.json"}) == 2);
  CHECK(wrong({"--check", "simulated", "--limit-n", "nan"}) == 2);
  CHECK(wrong({"--check", "simulated", "--limit-n", "0"}) == 2);
}

TEST_CASE("devices --check: keys and lines") {
  CHECK(answer_of_line("yes\r") == AnswerKey::yes);
  CHECK(answer_of_line("skip") == AnswerKey::skip);
  CHECK_FALSE(answer_of_line("YES"));
  CHECK_FALSE(answer_of_line(""));
  CHECK(answer_of_key('y') == AnswerKey::yes);
  CHECK(answer_of_key('n') == AnswerKey::no);
  CHECK(answer_of_key(' ') == AnswerKey::stop);
  CHECK(answer_of_key('\x1b') == AnswerKey::stop);
  CHECK_FALSE(answer_of_key('x'));
}

}  // namespace tangent
