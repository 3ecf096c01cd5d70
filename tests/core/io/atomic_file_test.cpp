#include "core/io/atomic_file.h"
#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <string>
#include <utility>

using namespace tangent;
using tangent::testing::read_text;
using tangent::testing::TempFolder;

TEST_CASE("a committed file holds what was written and leaves nothing beside it") {
  const TempFolder folder;
  const auto target = folder.path() / "out.csv";
  REQUIRE(write_file_atomic(target, "first"));
  CHECK(read_text(target) == "first");
  REQUIRE(write_file_atomic(target, "second, longer"));
  CHECK(read_text(target) == "second, longer");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("until commit the old content stays, and without commit for good") {
  const TempFolder folder;
  const std::filesystem::path target = folder.write("out.csv", "old");
  {
    Result<AtomicFile> file = AtomicFile::create(target);
    REQUIRE(file);
    CHECK(file->write(std::string(3'000'000, 'x')));
    CHECK(read_text(target) == "old");
  }
  CHECK(read_text(target) == "old");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("more than a buffer's worth arrives whole") {
  const TempFolder folder;
  std::string expected;
  Result<AtomicFile> file = AtomicFile::create(folder.path() / "big");
  REQUIRE(file);
  for (int i = 0; i < 200000; ++i) {
    const std::string line = std::to_string(i) + "\n";
    expected += line;
    CHECK(file->write(line));
  }
  REQUIRE(file->commit());
  CHECK(read_text(folder.path() / "big") == expected);
}

TEST_CASE("two writers of one file don't disturb each other: the last commit wins") {
  const TempFolder folder;
  const auto target = folder.path() / "out";
  Result<AtomicFile> one = AtomicFile::create(target), two = AtomicFile::create(target);
  REQUIRE(one);
  REQUIRE(two);
  CHECK(one->write("one"));
  CHECK(two->write("two"));
  REQUIRE(two->commit());
  CHECK(read_text(target) == "two");
  REQUIRE(one->commit());
  CHECK(read_text(target) == "one");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("what can't be written is an error that names the target") {
  const TempFolder folder;
  const auto missing = folder.path() / "no" / "such" / "out.csv";
  const Status status = write_file_atomic(missing, "x");
  REQUIRE_FALSE(status);
  CHECK(status.error().where == missing.string());
  CHECK_FALSE(status.error().what.empty());
  CHECK_FALSE(status.error().remedy.empty());
  CHECK_FALSE(write_file_atomic(folder.path(), "x"));
  CHECK_FALSE(write_file_atomic("", "x"));
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("a full device is an error, reported once and again") {
  if (!std::filesystem::exists("/dev/full")) return;
  Result<AtomicFile> file = AtomicFile::create("/dev/full");
  REQUIRE(file);
  CHECK(file->write("x"));  // buffered
  CHECK_FALSE(file->commit());
  CHECK_FALSE(write_file_atomic("/dev/full", std::string(1'000'000, 'x')));
}

TEST_CASE("a device is written through, not replaced") {
  REQUIRE(write_file_atomic("/dev/null", "x"));
  CHECK(std::filesystem::is_character_file("/dev/null"));
}

TEST_CASE("a link stays a link and the file it names gets the content") {
  const TempFolder folder;
  const std::filesystem::path real = folder.write("real", "old");
  const auto link = folder.path() / "link";
  std::filesystem::create_symlink("real", link);
  REQUIRE(write_file_atomic(link, "new"));
  CHECK(std::filesystem::is_symlink(link));
  CHECK(read_text(real) == "new");
}

TEST_CASE("replacing a file keeps its permissions") {
  const TempFolder folder;
  const std::filesystem::path target = folder.write("secret", "old");
  std::filesystem::permissions(target, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  REQUIRE(write_file_atomic(target, "new"));
  CHECK(std::filesystem::status(target).permissions() ==
        (std::filesystem::perms::owner_read | std::filesystem::perms::owner_write));
}

TEST_CASE("a write-protected target is refused") {
  if (::geteuid() == 0) {
    MESSAGE("skipped: root may write everything");
    return;
  }
  const TempFolder folder;
  const std::filesystem::path target = folder.write("locked", "old");
  std::filesystem::permissions(target, std::filesystem::perms::owner_read);
  CHECK_FALSE(write_file_atomic(target, "new"));
  CHECK(read_text(target) == "old");
}

TEST_CASE("what a killed process left is removed by the next that writes the same file, and nothing else") {
  const TempFolder folder;
  const std::filesystem::path target = folder.path() / "out.mat", other = folder.path() / "other.mat";
  const pid_t killed = ::fork();
  if (killed == 0) {
    const Result<AtomicFile> one = AtomicFile::create(target), two = AtomicFile::create(other);
    ::_exit(one && two ? 0 : 1);  // as after kill -9: nobody tidies up
  }
  int status = 0;
  REQUIRE(::waitpid(killed, &status, 0) == killed);
  REQUIRE(status == 0);
  REQUIRE(folder.entry_count() == 2);
  const std::string dead = std::to_string(killed);
  folder.write(".out.mat.tmp-" + dead, "no attempt");
  folder.write(".out.mat.tmp-" + dead + "-1x", "nobody's");
  folder.write(".out.mat.tmp-1-0", "of one that lives");
  const std::string held = folder.write(".out.mat.tmp-" + dead + "-7", "of one on another machine");
  const int fd = ::open(held.c_str(), O_RDONLY | O_CLOEXEC);
  REQUIRE(::flock(fd, LOCK_EX) == 0);
  REQUIRE(write_file_atomic(target, "whole"));
  CHECK(folder.entry_count() == 6);  // other's, the four, and the file
  CHECK(!std::filesystem::exists(folder.path() / (".out.mat.tmp-" + dead + "-0")));
  ::close(fd);
  REQUIRE(write_file_atomic(target, "again"));
  CHECK(folder.entry_count() == 5);
  REQUIRE(write_file_atomic(other, "whole"));
  CHECK(folder.entry_count() == 5);
}

TEST_CASE("a process that is about to end by a signal removes what it has half written, and nothing else") {
  const TempFolder folder;
  REQUIRE(write_file_atomic(folder.path() / "done", "done"));
  {
    Result<AtomicFile> first = AtomicFile::create(folder.path() / "a"),
                       second = AtomicFile::create(folder.path() / "b");
    REQUIRE(first);
    REQUIRE(second);
    const AtomicFile moved = std::move(*second);
    CHECK(folder.entry_count() == 3);
    remove_temporary_files();
    CHECK(folder.entry_count() == 1);
    remove_temporary_files();
  }
  CHECK(read_text(folder.path() / "done") == "done");
  CHECK(folder.entry_count() == 1);
}
