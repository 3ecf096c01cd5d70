// Named pipes in place of files: read, or refused at once; never waited for without an end.
#include "tests/support/process.h"

#include <sys/stat.h>

namespace tangent {
namespace {

using testing::contains;
using testing::run_workbench;
using testing::TempFolder;

TEST_CASE("what is read more than once, or by a library, is refused at once as a pipe, by name") {
  const TempFolder folder;
  const auto pipe = [&](const char* name) {
    REQUIRE(::mkfifo(folder.file(name).c_str(), 0600) == 0);
    return folder.file(name);
  };
  const std::string mesh = pipe("p.obj"), recording = pipe("p.sqlite"), answers = pipe("p_beh.tsv"),
                    poses = folder.write("poses.csv", "t_s,x_m,y_m,z_m\n0,0,0,0.1\n");
  using Command = std::vector<std::string>;
  for (const auto& [command, named] : std::initializer_list<std::pair<Command, std::string>>{
           {{"audit", mesh}, mesh},
           {{"tune", mesh, "--out", folder.file("p.toml")}, mesh},
           {{"solve", mesh, "--poses", poses, "--out", folder.file("t.csv")}, mesh},
           {{"replay", recording}, recording},
           {{"explain", recording}, recording},
           {{"export", recording, "--out", folder.file("e.csv")}, recording},
           {{"report", recording, "--out", folder.file("report")}, recording},
           {{"compare", recording, recording}, recording},
           {{"analyse", answers, "--out", folder.file("analysis")}, "p_beh.json"}}) {
    CAPTURE(command[0]);
    const auto refused = run_workbench(command);
    CHECK(refused.exit_code == 1);
    CHECK(contains(refused.err, named + ": "));
  }
}

}  // namespace
}  // namespace tangent
