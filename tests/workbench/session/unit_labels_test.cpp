#include "workbench/session/unit_labels.h"

#include "core/lab/measure/surface_map.h"
#include "core/preset/schema.h"

#include <doctest/doctest.h>

#include <set>
#include <string>

using namespace tangent;

TEST_CASE("labels of a unit go from the largest to the smallest, each once, and one of them is shown unasked") {
  for (const char* si : {"m", "s", "N", "N/m", "rad", "share", "1"}) {
    CAPTURE(si);
    const auto labels = labels_of(si);
    REQUIRE_FALSE(labels.empty());
    std::set<std::string_view> names;
    double before = 1e300;
    bool shown = false;
    for (const UnitLabel& label : labels) {
      CHECK(label.si == si);
      CHECK(label.in_si < before);
      before = label.in_si;
      CHECK(names.insert(label.plain).second);
      CHECK(unit_of_size(si, label.in_si).plain == label.plain);
      for (const char c : label.plain) CHECK(static_cast<unsigned char>(c) < 0x80);
      shown = shown || label.shown_to > 0.0;
    }
    CHECK(shown);
  }
}

TEST_CASE("lengths are shown in mm, small ones in um, times in ms, and what is not listed in SI") {
  CHECK(shown_unit("m", 0.02).name == "mm");
  CHECK(shown_unit("m", 1e-3).name == "\u00b5m");
  CHECK(shown_unit("m", 1.01e-3).name == "mm");
  CHECK(shown_unit("m", 1e-6).plain == "um");
  CHECK(shown_unit("s", 0.005).name == "ms");
  CHECK(shown_unit("rad", 1.0).name == "deg");
  CHECK(shown_unit("1", 1.0).name.empty());
  CHECK(shown_unit("1/s3", 1.0).name == "1/s3");
  CHECK(shown_unit("1/s3", 1.0).in_si == 1.0);
  CHECK(unit_of_size("1/m", 1.0).plain == "1/m");
}

TEST_CASE("a typed unit is one of its quantity") {
  REQUIRE(find_unit("m", "um") != nullptr);
  CHECK(find_unit("m", "um") == find_unit("m", "\u00b5m"));
  CHECK(find_unit("m", "um")->in_si == 1e-6);
  CHECK(find_unit("N/m", "N/mm")->in_si == 1e3);
  CHECK(find_unit("m", "ms") == nullptr);
  CHECK(find_unit("m", "") == nullptr);
  CHECK(find_unit("1", "") == nullptr);
  CHECK(find_unit("A", "A") == nullptr);
}

TEST_CASE("core names quantities by SI units alone") {
  const std::set<std::string_view> not_si{"mm", "um", "\u00b5m", "ms", "deg", "%", "N/mm"};
  for (const PresetKey& key : preset_keys()) CHECK(not_si.count(key.unit) == 0);
  for (std::size_t q = 0; q < kMapQuantityCount; ++q)
    CHECK(not_si.count(info_of(static_cast<MapQuantity>(q)).unit) == 0);
}
