#include "workbench/experiment/row_file.h"

#include "tests/support/full_disk.h"
#include "tests/support/killed_process.h"
#include "tests/support/paths.h"
#include "workbench/experiment/participant.h"
#include "workbench/experiment/trial_rows.h"
#include "workbench/session/own_folder.h"

#include <doctest/doctest.h>

#include <fstream>
#include <optional>
#include <sstream>

#include <unistd.h>

namespace tangent::experiment {
namespace {

namespace fs = std::filesystem;

std::string whole_text(const fs::path& path) {
  std::ostringstream out;
  out << std::ifstream(path, std::ios::binary).rdbuf();
  return out.str();
}
void put(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

const Fields kColumns{"a", "b"};

std::string three_rows(const fs::path& path) {
  fs::remove(path);
  auto file = RowFile::open(path, kColumns, "me");
  REQUIRE(file);
  for (const char* value : {"1", "2", "3"}) REQUIRE(file->add({value, "x"}));
  return whole_text(path);
}

TEST_CASE("rows come back, and a file goes on where it was") {
  const auto folder = OwnFolder::make();
  REQUIRE(folder);
  const fs::path path = folder->path() / "t.tsv";
  const std::string whole = three_rows(path);
  {
    auto file = RowFile::open(path, kColumns, "me");
    REQUIRE(file);
    CHECK(file->rows() == std::vector<Fields>{{"1", "x"}, {"2", "x"}, {"3", "x"}});
    REQUIRE(file->add({"4", "y"}));
  }
  CHECK(whole_text(path).substr(0, whole.size()) == whole);
  const auto read = read_rows(path, "me");
  REQUIRE(read);
  CHECK(read->columns == kColumns);
  CHECK(read->rows.size() == 4);
  CHECK(read->complaint.empty());
}

TEST_CASE("a file that was cut after any byte keeps every whole row") {
  const auto folder = OwnFolder::make();
  const fs::path path = folder->path() / "t.tsv";
  const std::string whole = three_rows(path);
  for (std::size_t cut = 0; cut < whole.size(); ++cut) {
    put(path, whole.substr(0, cut));
    auto file = RowFile::open(path, kColumns, "me");
    REQUIRE(file);
    const auto lines =
        static_cast<std::size_t>(std::count(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(cut), '\n'));
    CHECK(file->rows().size() == (lines > 0 ? lines - 1 : 0));
    REQUIRE(file->add({"9", "z"}));
    CHECK(read_rows(path, "me")->complaint.empty());
  }
}

TEST_CASE("any row that is edited, left out, doubled or moved is told, and so is another identity") {
  const auto folder = OwnFolder::make();
  const fs::path path = folder->path() / "t.tsv";
  const std::string whole = three_rows(path);
  std::vector<std::string> lines;
  std::istringstream in(whole);
  for (std::string line; std::getline(in, line);) lines.push_back(line + "\n");
  const auto refused = [&](const std::string& text) {
    put(path, text);
    const auto file = RowFile::open(path, kColumns, "me");
    const auto read = read_rows(path, "me");
    return !file && read && !read->complaint.empty();
  };
  std::string edited = whole;
  edited[edited.find("2\tx")] = '7';
  CHECK(refused(edited));
  CHECK(refused(lines[0] + lines[1] + lines[3]));
  CHECK(refused(lines[0] + lines[2] + lines[3]));
  CHECK(refused(lines[0] + lines[1] + lines[1] + lines[2]));
  CHECK(refused(lines[0] + lines[2] + lines[1] + lines[3]));
  put(path, whole);
  CHECK_FALSE(RowFile::open(path, kColumns, "somebody else"));
  CHECK_FALSE(RowFile::open(path, {"a", "c"}, "me"));
  CHECK(RowFile::open(path, kColumns, "me"));
}

TEST_CASE("what is no table is refused by name: empty, foreign, fields missing, a folder, in use") {
  const auto folder = OwnFolder::make();
  const fs::path path = folder->path() / "t.tsv";
  put(path, "t_s,x_m\n1,2\n");
  CHECK_FALSE(RowFile::open(path, kColumns, "me"));
  CHECK_FALSE(read_rows(path, "me"));
  put(path, three_rows(path) + "1\n");
  const auto read = read_rows(path, "me");
  REQUIRE_FALSE(read);
  CHECK(read.error().where.find(":5") != std::string::npos);
  CHECK_FALSE(RowFile::open(folder->path(), kColumns, "me"));
  CHECK_FALSE(RowFile::open(folder->path() / "no" / "t.tsv", kColumns, "me"));
  three_rows(path);
  auto one = RowFile::open(path, kColumns, "me");
  REQUIRE(one);
  const auto two = RowFile::open(path, kColumns, "me");
  REQUIRE_FALSE(two);
  CHECK(two.error().message().find("in use") != std::string::npos);
}

TEST_CASE("a full disk is an error, and what was written stays") {
  const auto folder = OwnFolder::make();
  REQUIRE(folder);
  const fs::path path = folder->path() / "t.tsv";
  const std::string before = three_rows(path);
  auto file = RowFile::open(path, kColumns, "me");
  REQUIRE(file);
  {
    const testing::FullDisk full(fs::file_size(path) + 3);
    CHECK_FALSE(file->add({"4", "x"}));
    CHECK(whole_text(path) == before);
  }
  CHECK(file->add({"4", "x"}));
  const auto read = read_rows(path, "me");
  REQUIRE(read);
  CHECK(read->rows == std::vector<Fields>{{"1", "x"}, {"2", "x"}, {"3", "x"}, {"4", "x"}});
}

Protocol protocol() {
  return *read_protocol(fs::path(testing::source_folder()) / "presets" / "experiments" / "discrimination.toml");
}
KnownComparer comparer() {
  KnownComparer out;
  for (const char* name : {"C1", "C2", "C3", "C4"}) out.functions[name] = {40.0, 0.3, 0.02};
  return out;
}
Fields names(std::span<const ColumnMeaning> columns) {
  Fields out;
  for (const auto& column : columns) out.emplace_back(column.name);
  return out;
}

TEST_CASE("trials of both kinds read back as they were, columns in any order") {
  auto run = ComparisonRun::start(protocol(), 1, 3);
  const RunMark mark{"P01", "known", true};
  Fields columns = names(comparison_columns());
  take_part(*run, comparer(), 1, [&](const ComparisonRow& row) {
    const Fields fields = fields_of(mark, row);
    REQUIRE(fields.size() == columns.size());
    const auto back = comparison_row(columns, fields);
    REQUIRE(back);
    CHECK(back->first == mark);
    CHECK(back->second == row);
    const Fields turned(fields.rbegin(), fields.rend()), turned_columns(columns.rbegin(), columns.rend());
    CHECK(comparison_row(turned_columns, turned)->second == row);
  });
  NamingRow row;
  row.object = "cone";
  row.answer = "cube";
  row.tactile = true;
  row.facing = Facing::left;
  row.touching_s = 1.0 / 3.0;
  const auto back = naming_row(names(naming_columns()), fields_of(mark, row));
  REQUIRE(back);
  CHECK(back->second == row);
  Fields bad = fields_of(mark, row);
  bad[5] = "two";
  const auto refused = naming_row(names(naming_columns()), bad);
  REQUIRE_FALSE(refused);
  CHECK(refused.error().message().find("two") != std::string::npos);
}

/// A participant in a process of its own, which is killed after a while; none: it ends by itself.
void take_rows_until_killed(const fs::path& path, std::optional<unsigned> after_us) {
  tangent::testing::run_until_killed(after_us, [&] {
    auto file = RowFile::open(path, names(comparison_columns()), "me");
    if (!file) return 1;
    std::vector<ComparisonRow> rows;
    for (const Fields& fields : file->rows())
      rows.push_back(comparison_row(names(comparison_columns()), fields)->second);
    auto run = ComparisonRun::start(protocol(), 1, 3, rows);
    if (!run) return 2;
    take_part(*run, comparer(), 1, [&](const ComparisonRow& row) {
      if (!file->add(fields_of({"P01", "known", false}, row))) _exit(3);
    });
    return 0;
  });
}

TEST_CASE("killed at any moment, a run loses no answer and ends with the same rows") {
  const auto folder = OwnFolder::make();
  const fs::path path = folder->path() / "killed.tsv", whole = folder->path() / "whole.tsv";
  take_rows_until_killed(whole, std::nullopt);
  const auto expected = read_rows(whole, "me");
  REQUIRE(expected);
  SplitMix random(2);
  std::size_t before = 0;
  const char* asked = std::getenv("TANGENT_KILLS");
  const int kills = asked != nullptr ? std::atoi(asked) : 40;
  for (int i = 0; i < kills; ++i) {
    take_rows_until_killed(path, static_cast<unsigned>(random.below(12'000)));
    const auto now = read_rows(path, "me");
    if (!now) continue;  // killed before the header was whole
    REQUIRE(now->complaint.empty());
    CHECK(now->rows.size() >= before);
    before = now->rows.size() == expected->rows.size() ? 0 : now->rows.size();
    if (before == 0) fs::remove(path);
  }
  take_rows_until_killed(path, std::nullopt);
  const auto end = read_rows(path, "me");
  REQUIRE(end);
  REQUIRE(end->rows.size() == expected->rows.size());
  const auto onset =
      static_cast<std::size_t>(std::find(end->columns.begin(), end->columns.end(), "onset") - end->columns.begin());
  for (std::size_t i = 0; i < end->rows.size(); ++i) {
    Fields a = end->rows[i], b = expected->rows[i];
    a[onset] = b[onset] = "";
    CHECK(a == b);
  }
}

}  // namespace
}  // namespace tangent::experiment
