// Trials with a scripted finger that touches, raises and presses.
#include "workbench/experiment/trial_session.h"

#include "tests/workbench/experiment/trial_fixture.h"

namespace tangent::experiment {
namespace {

using test::Bench;

TEST_CASE("a whole comparison experiment: touched, raised, answered, written") {
  Bench bench(test::short_comparison());
  CHECK(bench.phase() == Phase::training);
  CHECK(bench.trials->participant().show_scene);
  bench.answer();
  REQUIRE(bench.trials->finished());
  CHECK(bench.trials->operator_view().fault.empty());
  REQUIRE(bench.trials->end());
  const ReadRows table = bench.table();
  CHECK(table.complaint.empty());
  REQUIRE(table.rows.size() >= 6);
  for (const Fields& fields : table.rows) {
    const auto row = comparison_row(table.columns, fields);
    REQUIRE(row);
    CHECK(row->second.second_touching_s > 0.05);
    CHECK(row->second.second_touching_s < 0.45);
    CHECK(row->second.second_s > row->second.second_touching_s);
    const auto origin = row_origin(table.columns, fields);
    REQUIRE(origin);
    CHECK(origin->interruptions == 0);
    CHECK(origin->sound == "none");
    CHECK(origin->mesh.size() == 16);
    CHECK(origin->preset.size() == 16);
    CHECK(origin->program.size() == 16);
    CHECK(origin->protocol.size() == 16);
  }
}

TEST_CASE("a whole naming experiment: drawn to the start, a ding, named, rest") {
  Bench bench(test::short_naming());
  bench.answer();
  REQUIRE(bench.trials->finished());
  REQUIRE(bench.trials->end());
  const ReadRows table = bench.table();
  REQUIRE(table.rows.size() == 8);
  for (const Fields& fields : table.rows) {
    const auto row = naming_row(table.columns, fields);
    REQUIRE(row);
    CHECK(row->second.answer == "cube");
    CHECK(row->second.touching_s > 0.05);
    CHECK(row->second.touching_s <= row->second.since_touch_s);
  }
}

}  // namespace
}  // namespace tangent::experiment
