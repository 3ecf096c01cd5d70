#include "workbench/session/own_folder.h"

#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <optional>
#include <string>

using namespace tangent;
using namespace tangent::testing;

TEST_CASE("a folder of one's own is new, open to nobody else, and gone at the end with all that is in it") {
  const TempFolder temporary;
  const char* before = std::getenv("TMPDIR");
  const std::optional<std::string> kept = before != nullptr ? std::optional<std::string>(before) : std::nullopt;
  ::setenv("TMPDIR", temporary.path().c_str(), 1);
  {
    const auto one = OwnFolder::make(), two = OwnFolder::make();
    REQUIRE(one);
    REQUIRE(two);
    CHECK(one->path() != two->path());
    CHECK(one->path().parent_path() == temporary.path());
    CHECK(std::filesystem::status(one->path()).permissions() == std::filesystem::perms::owner_all);
    std::filesystem::create_directories(one->path() / "a" / "b");
    CHECK(temporary.entry_count() == 2);
  }
  CHECK(temporary.entry_count() == 0);
  kept ? ::setenv("TMPDIR", kept->c_str(), 1) : ::unsetenv("TMPDIR");
}
