// Which channels the plots show: names and units of derived ones, lists that change and are kept.
#include "workbench/gui/model/plot_lists.h"

#include "workbench/gui/model/plot_channels.h"

#include <doctest/doctest.h>

using namespace tangent;

TEST_CASE("a derived channel has a name and a unit, and curves of different units are not subtracted") {
  const auto name = [](const char* text) { return named_channel(text).value().name; };
  const auto unit = [](const char* text) { return named_channel(text).value().unit; };
  CHECK(name("force_x") == "Force x");
  CHECK(name("difference(force_computed, force_felt)") == "Force computed \u2212 Force felt");
  CHECK(name("derivative(difference(force_x, force_y))") == "d/dt (Force x \u2212 Force y)");
  CHECK(name("low_pass(error, 20)") == "Error up to 20 Hz");
  CHECK(name("magnitude(force_x, force_y)") == "|Force x, Force y|");
  CHECK(unit("low_pass(error, 20 Hz)") == "\u00b5m");
  CHECK(unit("derivative(cld_measured)") == "mm/s");
  CHECK(unit("derivative(derivative(cld_measured))") == "mm/s\u00b2");
  CHECK(unit("derivative(iterations)") == "1/s");
  CHECK(named_channel("derivative(cld_measured)").value().scale == 1e3);
  const auto mixed = named_channel("difference(force_x, error)");
  REQUIRE_FALSE(mixed);
  CHECK(mixed.error().what.find("different units") != std::string::npos);
  CHECK_FALSE(ghost_of(named_channel("difference(force_computed, force_felt)").value().of));
  CHECK(ghost_of(named_channel("derivative(force_x)").value().of));
}

TEST_CASE("channels are added and removed by name, each once, and what can't be says why and changes nothing") {
  PlotLists lists;
  const std::uint64_t before = lists.version();
  REQUIRE(lists.add("error", "force_x"));
  REQUIRE(lists.add("error", " force_x"));
  REQUIRE(lists.add("error", "derivative( force_x )"));
  CHECK(lists.of(2) == PlotLists::Texts{"error", "force_x", "derivative(force_x)"});
  CHECK(lists.made() == PlotLists::Texts{"derivative(force_x)"});
  CHECK(lists.version() > before);
  const std::uint64_t after = lists.version();
  CHECK_FALSE(lists.add("pressure", "force_x"));
  CHECK_FALSE(lists.add("error", "speed"));
  CHECK_FALSE(lists.remove("error", "energy"));
  CHECK_FALSE(lists.forget("force_x"));
  CHECK_FALSE(lists.forget("derivative(force_y)"));
  CHECK(lists.version() == after);
  REQUIRE(lists.remove("error", "error"));
  CHECK(lists.of(2).front() == "force_x");
  REQUIRE(lists.forget("derivative(force_x)"));
  CHECK(lists.of(2) == PlotLists::Texts{"force_x"});
  CHECK(lists.made().empty());
  for (int i = 1; i <= 40; ++i) {
    const Status added = lists.add("energy", "low_pass(energy, " + std::to_string(i) + " Hz)");
    CHECK(added.has_value() == (i < static_cast<int>(PlotLists::kMostInPlot)));
  }
  CHECK(lists.of(5).size() == PlotLists::kMostInPlot);
}

TEST_CASE("lists are kept as text - what another version wrote and this one doesn't know is left out") {
  PlotLists lists;
  CHECK(lists.changed().empty());
  REQUIRE(lists.add("cld", "derivative(cld_commanded)"));
  REQUIRE(lists.remove("cld", "cld_measured"));
  REQUIRE(lists.make("magnitude(force_x, force_y)"));
  PlotLists same;
  same.take(lists.changed(), lists.made());
  CHECK(same.changed() == lists.changed());
  CHECK(same.made() == lists.made());
  auto other = lists.changed();
  other["cld"].insert(other["cld"].begin(), "temperature");
  other["sound"] = {"force_x"};
  same.take(other, {"derivative(temperature)", "magnitude(force_x, force_y)"});
  CHECK(same.changed() == lists.changed());
  same.reset();
  CHECK(same.changed().empty());
  CHECK(same.made().size() == 2);
}
