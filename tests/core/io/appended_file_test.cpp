#include "core/io/appended_file.h"

#include "tests/support/full_disk.h"
#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

using namespace tangent;
using tangent::testing::contains;
using tangent::testing::FullDisk;
using tangent::testing::read_text;
using tangent::testing::TempFolder;

TEST_CASE("lines are added after those that are kept, and what is torn is cut off") {
  const TempFolder folder;
  const std::filesystem::path path = folder.write("f", "one\ntwo\ntor");
  auto file = AppendedFile::open(path, {});
  REQUIRE(file);
  REQUIRE(file->keep(8));
  CHECK(file->add("three\n"));
  CHECK(file->add_durably("four\n"));
  CHECK(file->flush());
  CHECK(read_text(path) == "one\ntwo\nthree\nfour\n");
}

TEST_CASE("on a full disk nothing of a line stays, and it can be added again") {
  const TempFolder folder;
  const std::filesystem::path path = folder.file("f");
  auto file = AppendedFile::open(path, {.not_whole = "make room"});
  REQUIRE(file);
  REQUIRE(file->add("one\n"));
  for (const bool durably : {false, true}) {
    const std::string before = read_text(path);
    const std::string line = std::string(100, 'x') + "\n";
    {
      const FullDisk full(before.size() + 50);
      const Status added = durably ? file->add_durably(line) : file->add(line);
      REQUIRE_FALSE(added);
      CHECK(added.error().where == path.string());
      CHECK(added.error().remedy == "make room");
      CHECK(read_text(path) == before);
    }
    CHECK((durably ? file->add_durably(line) : file->add(line)));
    CHECK(read_text(path) == before + line);
  }
}

TEST_CASE("one that is locked is in use until its owner closes it, also where that one removes it") {
  const TempFolder folder;
  const std::filesystem::path path = folder.file("f");
  const AppendRules alone{.not_whole = {}, .in_use = "wait"};
  for (const bool removes : {false, true}) {
    auto first = AppendedFile::open(path, alone);
    REQUIRE(first);
    const auto second = AppendedFile::open(path, alone);
    REQUIRE_FALSE(second);
    CHECK(second.error().message() == path.string() + ": is in use by another program; wait");
    CHECK(AppendedFile::open(path, {}));  // who asks for no lock shares it
    if (removes) std::filesystem::remove(path);
    if (removes) CHECK(AppendedFile::open(path, alone));  // a new file of that name is another one
    { const AppendedFile closed = std::move(*first); }
    CHECK(AppendedFile::open(path, alone));
  }
}

TEST_CASE("what is no file is refused by name, and a folder that is not there, too") {
  const TempFolder folder;
  CHECK(contains(AppendedFile::open(folder.path(), {}).error().message(), "is no file"));
  CHECK(contains(AppendedFile::open("/dev/null", {}).error().message(), "/dev/null: is no file"));
  CHECK(contains(AppendedFile::open(folder.path() / "no" / "f", {}).error().message(), "can't be written"));
}

TEST_CASE("where a write fails before anything was said of what is there, that stays") {
  const TempFolder folder;
  const std::filesystem::path path = folder.write("f", "one\ntwo\n");
  auto file = AppendedFile::open(path, {});
  REQUIRE(file);
  const FullDisk full(10);
  CHECK_FALSE(file->add("three\n"));
  CHECK(read_text(path) == "one\ntwo\n");
}
