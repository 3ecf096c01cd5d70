#include "core/base/text.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

using namespace tangent;

TEST_CASE("a finite decimal number parses to the nearest double") {
  CHECK(parse_finite_double("0") == 0.0);
  CHECK(parse_finite_double("0.30000000000000004") == 0.30000000000000004);
  CHECK(parse_finite_double("-1.5e-3") == -1.5e-3);
  CHECK(parse_finite_double("+2") == 2.0);
  CHECK(parse_finite_double(".5") == 0.5);
  CHECK(parse_finite_double("1.7976931348623157e308") == std::numeric_limits<double>::max());
  CHECK(parse_finite_double("4.9406564584124654e-324") == std::numeric_limits<double>::denorm_min());
  CHECK(parse_finite_double("1e-400") == 0.0);
}

TEST_CASE("what is not one finite number is refused") {
  for (const char* text :
       {"",    " ",    "nan", "NaN", "-nan", "inf", "-Infinity", "1e999", "-1e999", "1 ",    " 1",  "1x",
        "1,5", "0x10", "--1", "+-1", "++1",  "1e",  "e5",        ".",     "1.2.3",  "1_000", "true"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_finite_double(text).has_value());
  }
  CHECK_FALSE(parse_finite_double(std::string_view("1\0", 2)).has_value());
}

TEST_CASE("scanning stops after the number and tells overflow from infinity") {
  const std::string text = "1.25/3";
  const ScannedDouble read = scan_double(text.data(), text.data() + text.size());
  CHECK(read.status == ScanStatus::ok);
  CHECK(read.value == 1.25);
  CHECK(*read.next == '/');

  const std::string large = "-1e999", infinite = "-inf", none = "abc", not_a_number = "NaN";
  CHECK(scan_double(large.data(), large.data() + large.size()).status == ScanStatus::overflow);
  CHECK(scan_double(none.data(), none.data() + none.size()).status == ScanStatus::malformed);
  CHECK(scan_double(infinite.data(), infinite.data() + infinite.size()).value ==
        -std::numeric_limits<double>::infinity());
  CHECK(std::isnan(scan_double(not_a_number.data(), not_a_number.data() + not_a_number.size()).value));
}

TEST_CASE("a printed double reads back with the same bits") {
  std::mt19937_64 random(7);
  const auto round_trips = [](double value) {
    std::string text;
    append_double(text, value);
    const std::optional<double> back = parse_finite_double(text);
    return back && std::bit_cast<std::uint64_t>(*back) == std::bit_cast<std::uint64_t>(value);
  };
  int failures = 0;
  for (int i = 0; i < 100000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (std::isfinite(value) && !round_trips(value)) ++failures;
  }
  CHECK(failures == 0);
  CHECK(round_trips(-0.0));
  CHECK(round_trips(std::numeric_limits<double>::denorm_min()));
}

TEST_CASE("printing is the shortest text and appends") {
  std::string text = "x=";
  append_double(text, 0.1);
  CHECK(text == "x=0.1");
}
