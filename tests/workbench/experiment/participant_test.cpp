#include "workbench/experiment/participant.h"
#include "tests/support/approx.h"
#include "tests/support/paths.h"

#include <doctest/doctest.h>

#include <cmath>

namespace tangent::experiment {

using test::approx;
namespace {

Protocol naming_protocol() {
  return *read_protocol(std::filesystem::path(testing::source_folder()) / "presets" / "experiments" /
                        "identification.toml");
}

TEST_CASE("one who names by a table takes each object for another as often as it says") {
  const Protocol protocol = naming_protocol();
  const Identification& design = *protocol.identification();
  KnownNamer namer;
  for (std::size_t i = 0; i < 7; ++i) {
    namer.shares.emplace_back(7, 0.0);
    namer.shares[i][i] = 0.75;
    namer.shares[i][(i + 1) % 7] = 0.25;
  }
  double right = 0.0, other = 0.0, trials = 0.0, seconds = 0.0, touching = 0.0;
  for (std::uint64_t p = 1; p <= 40; ++p) {
    std::vector<NamingRow> rows;
    for (int session = 0; session < 2; ++session) {
      auto run = NamingRun::start(protocol, p, p, rows);
      REQUIRE(run);
      take_part(*run, design, namer, p, [&](const NamingRow& row) { rows.push_back(row); });
    }
    REQUIRE(rows.size() == 112);
    for (const NamingRow& row : rows) {
      trials += 1.0;
      right += row.right;
      const auto at = std::find(design.objects.begin(), design.objects.end(), row.object) - design.objects.begin();
      other += row.answer == design.objects[static_cast<std::size_t>(at + 1) % 7];
      seconds += row.since_touch_s;
      touching += row.touching_s;
    }
  }
  CHECK(right / trials == approx(0.75).epsilon(0.03));
  CHECK(right + other == trials);
  CHECK(touching / seconds == approx(0.7).epsilon(0.05));
}

}  // namespace
}  // namespace tangent::experiment
