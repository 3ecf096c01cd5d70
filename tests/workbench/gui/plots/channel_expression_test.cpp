// Derived channels as text: what is read, how it is written again, what is refused.
#include "workbench/gui/plots/channel_expression.h"

#include <doctest/doctest.h>

#include <array>

using namespace tangent;

namespace {

constexpr std::array<std::string_view, 4> kKeys{"a", "b", "c", "d"};

Result<ChannelExpression> parse(std::string_view text) {
  return parse_channel(text, [](std::string_view key) -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < kKeys.size(); ++i)
      if (kKeys[i] == key) return i;
    return std::nullopt;
  });
}

std::string again(std::string_view text) {
  const auto read = parse(text);
  if (!read) return "refused: " + read.error().what;
  return written(*read, [](std::size_t channel) { return std::string(kKeys[channel]); });
}

}  // namespace

TEST_CASE("a channel is written as it was read, blanks aside, and reads as the same again") {
  CHECK(again("  b ") == "b");
  CHECK(again("difference(a,b)") == "difference(a, b)");
  CHECK(again("magnitude( a , b , c )") == "magnitude(a, b, c)");
  CHECK(again("low_pass(a, 20 Hz)") == "low_pass(a, 20 Hz)");
  CHECK(again("low_pass(a,2.5)") == "low_pass(a, 2.5 Hz)");
  const std::string deep = "derivative(low_pass(difference(a, magnitude(b, c)), 0.1 Hz))";
  CHECK(again(deep) == deep);
  CHECK(parse(again(deep)).value() == parse(deep).value());
}

TEST_CASE("what is no channel is refused, and says what would be one") {
  for (const char* text : {"",
                           "e",
                           "a b",
                           "difference",
                           "difference()",
                           "difference(a)",
                           "difference(a, b, c)",
                           "sum(a, b)",
                           "derivative(a, b)",
                           "derivative(a",
                           "derivative a)",
                           "derivative((a))",
                           "low_pass(a)",
                           "low_pass(a, b)",
                           "low_pass(a, 0 Hz)",
                           "low_pass(a, 1e9 Hz)",
                           "low_pass(a, nan Hz)",
                           "magnitude(a)",
                           "magnitude(a, b, c, d)",
                           "derivative(derivative(derivative(derivative(derivative(a)))))",
                           "difference(a, )",
                           ")(",
                           "a)"}) {
    CAPTURE(text);
    const auto read = parse(text);
    REQUIRE_FALSE(read);
    CHECK(read.error().remedy.find("low_pass") != std::string::npos);
  }
  CHECK_FALSE(parse(std::string(100'000, '(')));
}

TEST_CASE("over other channels an expression is the same, and there is none where one of them is missing") {
  const ChannelExpression of = parse("difference(a, derivative(b))").value();
  const auto moved = over_channels(of, [](std::size_t channel) { return std::optional(channel + 2); });
  REQUIRE(moved);
  CHECK(*moved == parse("difference(c, derivative(d))").value());
  CHECK_FALSE(over_channels(
      of, [](std::size_t channel) { return channel == 0 ? std::optional<std::size_t>(0) : std::nullopt; }));
}
