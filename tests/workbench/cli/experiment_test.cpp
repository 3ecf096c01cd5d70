#include "tests/support/meshes.h"
#include "tests/support/paths.h"
#include "tests/support/process.h"

#include <filesystem>
#include <fstream>
#include <sstream>

namespace tangent {
namespace {

using testing::contains;
using testing::ProcessResult;
using testing::run_workbench;
using testing::TempFolder;

std::string shipped(const char* name) {
  return (std::filesystem::path(testing::source_folder()) / "presets" / "experiments" / name).string();
}
ProcessResult experiment(const TempFolder& folder, const std::string& participant, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"experiment",    shipped("discrimination.toml"),
                                     "--participant", participant,
                                     "--out",         folder.file("data"),
                                     "--simulated",   "known"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_workbench(std::move(arguments));
}

TEST_CASE("experiment and analyse: from a protocol to a page") {
  const TempFolder folder;
  for (const char* name : {"P1", "P2"}) {
    const ProcessResult run = experiment(folder, name);
    CHECK(run.exit_code == 0);
    CHECK(contains(run.out, "simulated"));
  }
  const ProcessResult again = experiment(folder, "P1");  // nothing is left to do
  CHECK(again.exit_code == 0);
  CHECK(contains(again.out, "were there"));
  const ProcessResult analysed =
      run_workbench({"analyse", folder.file("data"), "--out", folder.file("out"), "--repeats", "20"});
  CHECK(analysed.exit_code == 0);
  CHECK(contains(analysed.out, "2 participants"));
  CHECK(std::filesystem::exists(folder.file("out/analysis.html")));
  CHECK(std::filesystem::exists(folder.file("out/thresholds.svg")));
  CHECK(std::filesystem::exists(folder.file("out/staircases.csv")));
}

TEST_CASE("analyse: power and check take a protocol, and print and write what they find") {
  const TempFolder folder;
  const auto plan = [&](const std::string& protocol, std::vector<std::string> more) {
    std::vector<std::string> arguments{"analyse", protocol, "--out", folder.file("plan")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_workbench(std::move(arguments));
  };
  const ProcessResult power = plan(shipped("identification.toml"), {"--power", "--count", "20"});
  CHECK(power.exit_code == 0);
  CHECK(contains(power.out, "theory"));
  CHECK(std::filesystem::exists(folder.file("plan/power.csv")));
  const ProcessResult check = plan(shipped("identification.toml"), {"--check", "--count", "36"});
  CHECK(check.exit_code == 0);
  CHECK(contains(check.out, "should be"));
  CHECK(std::filesystem::exists(folder.file("plan/check.html")));
  CHECK(plan(shipped("identification.toml"), {"--check", "--power"}).exit_code == 2);
  CHECK(plan(folder.file("none.toml"), {"--power"}).exit_code == 1);
}

TEST_CASE("experiment: the same seed gives the same bytes, another one others") {
  const TempFolder a, b, c;
  REQUIRE(experiment(a, "7", {"--seed", "5"}).exit_code == 0);
  REQUIRE(experiment(b, "7", {"--seed", "5"}).exit_code == 0);
  REQUIRE(experiment(c, "7", {"--seed", "6"}).exit_code == 0);
  const auto rows = [](const TempFolder& folder) {
    std::ostringstream out;
    out << std::ifstream(folder.file("data/sub-7/beh/sub-7_task-discrimination_beh.tsv")).rdbuf();
    return out.str();
  };
  CHECK(rows(a).size() > 5000);
  CHECK(rows(a) == rows(b));
  CHECK(rows(a) != rows(c));
}

TEST_CASE("experiment: a participant who is refused leaves no protocol in the folder") {
  const TempFolder folder;
  REQUIRE(experiment(folder, "P1").exit_code == 0);
  const auto protocols = [&] {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder.file("data")))
      count += entry.path().filename().string().starts_with("protocol-");
    return count;
  };
  REQUIRE(protocols() == 1);
  const auto with_six = [&](const std::string& participant) {
    return run_workbench({"experiment", shipped("six-conditions.toml"), "--participant", participant, "--out",
                          folder.file("data"), "--simulated", "known"});
  };
  const ProcessResult refused = with_six("P1");
  CHECK(refused.exit_code == 1);
  CHECK(contains(refused.err, "was begun with another protocol"));
  CHECK(protocols() == 1);
  CHECK(with_six("P2").exit_code == 0);
  CHECK(protocols() == 2);
}

TEST_CASE("experiment: a person's keys from a pipe, in simulated time") {
  const TempFolder folder;
  const std::string keys =
      "wait 1\nlift\nwait 1\nenter\nwait 2\nlift\nwait 1\nenter\nwait 2\nlift\nwait 1\n1\nenter\nnote "
      "tired\nwait 1\n";
  const std::string command =
      "printf '" + keys + "' | \"$0\" experiment \"$1\" --participant 3 --out \"$2\" " + "--without-waiting --pilot";
  const testing::Process shell({"-c", command, testing::program(), shipped("discrimination.toml"), folder.file("d")},
                               "/bin/sh");
  const ProcessResult run = shell.wait();
  CHECK(contains(run.out, ": 1 trial\n"));
  CHECK(contains(run.err, "goes on from there"));
  std::ostringstream rows, events;
  rows << std::ifstream(folder.file("d/sub-3/beh/sub-3_task-discrimination_beh.tsv")).rdbuf();
  events << std::ifstream(folder.file("d/sub-3/beh/sub-3_task-discrimination_events.tsv")).rdbuf();
  CHECK(contains(rows.str(), "3\tdevice\tyes\t0\t"));
  CHECK(contains(events.str(), "tired"));
}

TEST_CASE(
    "experiment: keys without end, damaged or of another system's line ends neither hang it nor fill the screen") {
  const TempFolder folder;
  const auto keys = [&](const std::string& from, const std::string& participant, const char* most_s = "60") {
    const testing::Process shell({"-c",
                                  from + " | timeout -k 60 " + most_s + " \"$0\" experiment \"$1\" --participant " +
                                      participant + " --out \"$2\" --without-waiting",
                                  testing::program(), shipped("discrimination.toml"), folder.file("d")},
                                 "/bin/sh");
    return shell.wait();
  };
  CHECK(keys("yes enter", "1", "3").exit_code == 124);  // at the first signal: 137 were the last
  const ProcessResult crlf = keys("printf 'wait 1\\r\\nlift\\r\\n'", "2");
  CHECK(contains(crlf.err, "goes on from there"));
  const ProcessResult zeros = keys("printf 'wait 1\\n\\000\\000\\nnote still here\\n'", "3");
  CHECK(zeros.exit_code == 1);
  CHECK(contains(zeros.err, "is no key"));
  CHECK(contains(zeros.err, "write enter"));
  std::ostringstream events;
  events << std::ifstream(folder.file("d/sub-3/beh/sub-3_task-discrimination_events.tsv")).rdbuf();
  CHECK(contains(events.str(), "still here"));
  const ProcessResult line = keys("head -c 1000000 /dev/zero | tr '\\000' x", "4");
  CHECK(contains(line.err, "more than 4096 characters"));
  CHECK(line.err.size() < 1000);
}

TEST_CASE("experiment: a real device can't keep simulated time, and nobody is enrolled for it") {
  const TempFolder folder;
  const ProcessResult run = run_workbench({"experiment", shipped("discrimination.toml"), "--participant", "1", "--out",
                                           folder.file("d"), "--device", "cld", "--without-waiting"});
  CHECK(run.exit_code == 2);
  CHECK(contains(run.err, "real devices keep real time"));
  CHECK_FALSE(std::filesystem::exists(folder.file("d")));
}

TEST_CASE("experiment and analyse: what can't be is said, with the exit codes of every command") {
  const TempFolder folder;
  CHECK(experiment(folder, "anna").exit_code == 2);
  CHECK(experiment(folder, "").exit_code == 2);
  CHECK(contains(experiment(folder, "P99999999999999999999999").err, "has a number above 18446744073709551615"));
  CHECK(contains(experiment(folder, "a/1").err, "letters"));
  CHECK(run_workbench({"experiment", shipped("discrimination.toml"), "--out", folder.file("d")}).exit_code == 2);
  CHECK(experiment(folder, "1", {"--seed", "-1"}).exit_code == 2);
  for (const char* option : {"--record", "--same-day", "--without-waiting", "--device=cld", "--sound=none"})
    CHECK_MESSAGE(experiment(folder, "1", {option}).exit_code == 2, option);
#ifdef TANGENT_HAS_GUI
  CHECK(experiment(folder, "1", {"--window"}).exit_code == 2);  // the window's own program says so
#endif
  const ProcessResult person =
      run_workbench({"experiment", shipped("discrimination.toml"), "--participant", "1", "--out", folder.file("d")});
  CHECK(person.exit_code == 1);  // no key ever comes
  CHECK(contains(person.err, "goes on from there"));
  // Nobody presses a key: `wait` counts ticks, and the keys end after it.
  const testing::Process shell({"-c",
                                "printf 'wait 0.2\\n' | \"$0\" experiment \"$1\" --participant 2 --out \"$2\" "
                                "--device cld",
                                testing::program(), shipped("discrimination.toml"), folder.file("e")},
                               "/bin/sh");
  CHECK(contains(shell.wait().err, "is not there"));
  CHECK(contains(experiment(folder, "P-1").err, "BIDS"));
  folder.write("bad.toml", "[protocol]\nkind = \"discrimination\"\nname = \"x\"\nlength = 4\n");
  const ProcessResult bad = run_workbench(
      {"experiment", folder.file("bad.toml"), "--participant", "1", "--out", folder.file("d"), "--simulated", "known"});
  CHECK(bad.exit_code == 1);
  CHECK(contains(bad.err, "bad.toml:4"));
  const ProcessResult nothing = run_workbench({"analyse", folder.file("nothing"), "--out", folder.file("o")});
  CHECK(nothing.exit_code == 1);
  CHECK(contains(nothing.err, "nothing: is not there"));
  CHECK(contains(run_workbench({"analyse", shipped("discrimination.toml"), "--out", folder.file("o")}).err,
                 "does not end with _beh.tsv"));
  CHECK(run_workbench({"analyse"}).exit_code == 2);
}

TEST_CASE("no force device for trials, and answers where a protocol is planned, are wrong usage") {
  const TempFolder folder;
  const std::string protocol = testing::source_folder() + "/presets/experiments/discrimination.toml";
  const ProcessResult none =
      run_workbench({"experiment", protocol, "--participant", "p1", "--out", folder.file("d"), "--force", "none"});
  CHECK(none.exit_code == 2);
  CHECK(contains(none.err, "every trial needs a force device"));
  for (const char* const what : {"--power", "--check"}) {
    const ProcessResult two = run_workbench({"analyse", protocol, protocol, what, "--out", folder.file("d")});
    CHECK(two.exit_code == 2);
    CHECK(contains(two.err, "takes one protocol, and no answers"));
  }
  CHECK(folder.entry_count() == 0);
}

}  // namespace
}  // namespace tangent
