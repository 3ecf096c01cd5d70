#include "core/io/atomic_file.h"
#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <sys/stat.h>
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
