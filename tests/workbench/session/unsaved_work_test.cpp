#include "workbench/session/unsaved_work.h"

#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <sys/wait.h>
#include <unistd.h>

using namespace tangent;
using namespace tangent::testing;

namespace {

UnsavedWork some_work() {
  UnsavedWork work;
  UnsavedPreset preset{"paper", "/tmp/odd \"name\"\n/paper.toml", {}, {}};
  preset.loaded.force.stiffness_n_per_m = 1.0 / 3.0 * 1000.0;
  preset.current = preset.loaded;
  work.steps.push_back({"start", 0, {preset, preset}});
  preset.current.solver.gain_curvature_m = 0.1 + 0.2;
  preset.current.solver.method = Method::paper;
  work.steps.push_back({"solver.gain_curvature_m \u2192 0.3", 0, {preset, work.steps[0].slots[1]}});
  work.steps.push_back({"switch to B", 1, work.steps[1].slots});
  work.steps[2].slots[1].name = "not UTF-8: \xE9";
  work.steps[2].slots[1].path = "/tmp/\xE9.toml";
  work.at = 1;
  work.bookmarks = {{12345, 12.345, "here it \"jumps\"\nand stays"}, {20000, 20.0, ""}};
  return work;
}

/// A process that keeps `work` and dies without closing anything.
void crash_with(const std::filesystem::path& folder, const UnsavedWork& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    UnsavedKeeper keeper(folder);
    const bool kept = keeper.keep(work).has_value();
    ::_exit(kept ? 0 : 1);
  }
  int status = 0;
  REQUIRE(::waitpid(child, &status, 0) == child);
  REQUIRE(WEXITSTATUS(status) == 0);
}

}  // namespace

TEST_CASE("unsaved work reads back as it was written, to the last bit") {
  const auto read = parse_unsaved(format_unsaved(some_work()), "work");
  REQUIRE(read.has_value());
  CHECK(*read == some_work());
}

TEST_CASE("unsaved work that is cut off or altered is refused, and put aside") {
  const std::string text = format_unsaved(some_work());
  for (std::size_t length = 0; length < text.size(); length += 97) {
    const auto read = parse_unsaved(text.substr(0, length), "work");
    if (read) CHECK(read->steps.size() <= 3);
  }
  CHECK_FALSE(parse_unsaved("at = 7\n", "work").has_value());
  CHECK_FALSE(parse_unsaved("at = 0\nsteps = [ 3 ]\n", "work").has_value());
  const TempFolder folder;
  const std::filesystem::path file = folder.write("77.toml", "at = = 1\n");
  CHECK_FALSE(find_left_work(folder.path()).has_value());
  CHECK(std::filesystem::exists(file.string() + ".bad"));
}

TEST_CASE("work is offered after a crash, once, and not while its window is open, nor after that was closed") {
  const TempFolder folder;
  {
    UnsavedKeeper open(folder.path());
    REQUIRE(open.keep(some_work()));
    CHECK_FALSE(find_left_work(folder.path()).has_value());
  }
  CHECK(folder.entry_count() == 0);

  crash_with(folder.path(), some_work());
  UnsavedKeeper mine(folder.path());
  REQUIRE(mine.keep(some_work()));
  const auto left = find_left_work(folder.path());
  REQUIRE(left.has_value());
  CHECK(left->work == some_work());
  forget_left_work(*left);
  CHECK_FALSE(find_left_work(folder.path()).has_value());
}

TEST_CASE("where there is nothing to lose nothing is kept") {
  const TempFolder folder;
  UnsavedWork start;
  start.steps.resize(1);
  UnsavedKeeper keeper(folder.path());
  REQUIRE(keeper.keep(start));
  CHECK(folder.entry_count() == 1);  // the lock
  REQUIRE(keeper.keep(some_work()));
  CHECK(folder.entry_count() == 2);
  REQUIRE(keeper.keep(start));
  CHECK(folder.entry_count() == 1);
  UnsavedKeeper nowhere({});
  CHECK(nowhere.keep(some_work()));
}

TEST_CASE("a window with the process id of a crashed run keeps its work in another file") {
  const TempFolder folder;
  const auto crashed = folder.write(std::to_string(::getpid()) + ".toml", format_unsaved(some_work()));
  UnsavedWork other = some_work();
  other.bookmarks[0].note = "mine";
  {
    UnsavedKeeper keeper(folder.path());
    REQUIRE(keeper.keep(other));
    const auto left = find_left_work(folder.path());
    REQUIRE(left.has_value());
    CHECK(left->work == some_work());
    CHECK(left->file == crashed);
  }
  CHECK(std::filesystem::exists(crashed));  // never taken up, never discarded
}

TEST_CASE("work that a window keeps is not removed as left - where its file goes it is written again") {
  const TempFolder folder;
  UnsavedKeeper keeper(folder.path());
  REQUIRE(keeper.keep(some_work()));
  const auto own = folder.path() / (std::to_string(::getpid()) + ".toml");
  forget_left_work({some_work(), own});
  CHECK(std::filesystem::exists(own));
  std::filesystem::remove(own);
  REQUIRE(keeper.keep(some_work()));
  CHECK(std::filesystem::exists(own));
}

TEST_CASE("unsaved work that can't be read is named, and locks of no file are removed unless they are held") {
  const TempFolder folder;
  const UnsavedKeeper open(folder.path());
  const auto bad = folder.write("77.toml", "at = = 1\n");
  folder.write("77.toml.lock", "");
  folder.write("78.toml.lock", "");
  std::vector<UnreadWork> unread;
  CHECK_FALSE(find_left_work(folder.path(), &unread).has_value());
  REQUIRE(unread.size() == 1);
  CHECK(unread[0].file == bad);
  CHECK(unread[0].aside == bad + ".bad");
  CHECK(folder.entry_count() == 2);  // it, and the lock that is held
}
