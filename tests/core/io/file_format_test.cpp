#include "core/io/file_format.h"

#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <array>

using namespace tangent;
using tangent::testing::contains;

namespace {

// A file format that has changed twice: a key was renamed, then moved into a table.
void rename_stiffness(toml::table& root) {
  if (const toml::node* old = root.get("k")) {
    root.insert("stiffness", old->value<double>().value());
    root.erase("k");
  }
}
void move_stiffness(toml::table& root) {
  if (const toml::node* old = root.get("stiffness")) {
    root.insert("force", toml::table{{"stiffness", old->value<double>().value()}});
    root.erase("stiffness");
  }
}
constexpr std::array<MigrationStep, 3> kSteps{only_number, rename_stiffness, move_stiffness};
constexpr FileFormats kFormats{"spring", kSteps};

Result<toml::table> read(const char* text) {
  auto root = parse_toml(text, "s.toml", "correct it");
  REQUIRE(root);
  if (const Status status = migrate(*root, kFormats, "s.toml"); !status) return tl::unexpected(status.error());
  return root;
}

}  // namespace

TEST_CASE("a file of any older format becomes one of the newest, step by step") {
  for (const char* text : {"k = 3.0\n", "format = 0\nk = 3.0\n", "format = 1\nk = 3.0\n",
                           "format = 2\nstiffness = 3.0\n", "format = 3\n[force]\nstiffness = 3.0\n"}) {
    CAPTURE(text);
    const auto root = read(text);
    REQUIRE(root);
    CHECK(root->size() == 1);  // the format itself is gone
    CHECK((*root)["force"]["stiffness"].value<double>() == 3.0);
  }
}

TEST_CASE("steps before a file's format are not taken") {
  const auto root = read("format = 2\nk = 3.0\n");
  REQUIRE(root);
  CHECK((*root)["k"].value<double>() == 3.0);
  CHECK_FALSE(root->contains("force"));
}

TEST_CASE("a newer format, and none that can be, say what, where and what to do") {
  CHECK(read("\nformat = 4\n").error().message() ==
        "s.toml:2 format: this file has format 4, this program reads up to 3; use the program that wrote it or a newer "
        "one, or write the spring file again with this one");
  CHECK(contains(read("format = 9223372036854775807\n").error().message(), "this program reads up to 3"));
  for (const char* text : {"format = -1\n", "format = 1.5\n", "format = true\n", "format = []\n"})
    CHECK(contains(read(text).error().message(), "s.toml:1 format: is not a format of a spring file"));
}

TEST_CASE("what is written has the newest format") {
  CHECK(kFormats.line() == "format = 3\n");
  CHECK(read(kFormats.line().c_str())->empty());
}
