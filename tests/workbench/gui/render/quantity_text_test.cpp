#include "workbench/gui/render/quantity_text.h"

#include "tests/support/approx.h"
#include "workbench/gui/theme/palette.h"

#include <doctest/doctest.h>

#include <limits>

using namespace tangent;
using namespace tangent::test;

TEST_CASE("lengths take the unit that fits") {
  CHECK(length_text(0.0) == "0 mm");
  CHECK(length_text(0.0009803) == "980 \xC2\xB5m");
  CHECK(length_text(0.00098034) == "980 \xC2\xB5m");
  CHECK(length_text(0.001) == "1 mm");
  CHECK(length_text(-0.0021534) == "-2.15 mm");
  CHECK(length_text(0.02) == "20 mm");
  CHECK(length_text(0.99999) == "1.00 m");
  CHECK(length_text(12345.0) == "12.3 km");
  CHECK(length_text(5e-9) == "5 nm");
  CHECK(length_text(2e25) == "2e+22 km");
  CHECK(length_text(-3.456e-12) == "-0.00346 nm");
}

TEST_CASE("scale bars have round lengths that fit") {
  CHECK(round_number_below(0.0349) == approx(0.02));
  CHECK(round_number_below(0.05) == approx(0.05));
  CHECK(round_number_below(9.99) == approx(5.0));
  CHECK(round_number_below(1.0) == approx(1.0));
}

TEST_CASE("iterations beyond the last have its colour") { CHECK(iteration_colour(9, 5) == iteration_colour(4, 5)); }

TEST_CASE("packed colours have ImGui's byte order") {
  CHECK(packed(rgb_hex(0x112233)) == 0xFF332211u);
  CHECK(packed({2.0f, -1.0f, 0.0f, 0.5f}) == 0x800000FFu);
}
