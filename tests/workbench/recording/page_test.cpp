#include "tests/support/paths.h"
#include "tests/workbench/recording/recording_fixture.h"

using namespace tangent;
using namespace tangent::test;

TEST_CASE("the queries of the page on recordings find something in one") {
  const testing::TempFolder folder;
  const std::string path = folder.file("a.sqlite");
  RecordedSession recorded(path);
  recorded.run(1500);
  recorded.finish();
  const std::string page = testing::read_text(testing::source_folder() + "/workbench/recording/README.md");
  int queries = 0;
  for (std::size_t at = page.find("```sql\n"); at != std::string::npos; at = page.find("```sql\n", at)) {
    at += 7;
    const std::string query = page.substr(at, page.find("```", at) - at);
    CAPTURE(query);
    const std::vector<std::string> row = ask(path, query);
    REQUIRE(row.size() >= 3);
    CHECK(row[0] != "NULL");
    ++queries;
  }
  CHECK(queries == 5);
  // Every table and column of a recording is one of the page's, and the page has no other.
  CHECK(ask(path, "SELECT count(*) FROM sqlite_schema WHERE type IN ('table', 'view')")[0] == "13");
  const std::string tables =
      ask(path, "SELECT group_concat(name, ' ') FROM sqlite_schema WHERE type IN ('table', 'view')")[0];
  for (std::size_t at = 0; at < tables.size();) {
    const std::size_t end = std::min(tables.find(' ', at), tables.size());
    CHECK(says(page, "`" + tables.substr(at, end - at) + "`"));
    at = end + 1;
  }
}
