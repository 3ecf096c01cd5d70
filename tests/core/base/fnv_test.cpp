#include "core/base/fnv.h"

#include <doctest/doctest.h>

using namespace tangent;

TEST_CASE("the checksum is FNV-1a: its authors' values, and numbers as eight bytes, the lowest first") {
  CHECK(Fnv().text() == "cbf29ce484222325");
  CHECK(Fnv().add("a").text() == "af63dc4c8601ec8c");
  CHECK(Fnv().add("foo").add("bar").text() == "85944171f73967e8");
  CHECK(Fnv().add_bits(std::uint64_t{0x6867666564636261}).value() == Fnv().add("abcdefgh").value());
  CHECK(Fnv().add_bits(-0.0).value() != Fnv().add_bits(0.0).value());
  CHECK(hex_text(0x0123456789abcdefu) == "0123456789abcdef");
}
