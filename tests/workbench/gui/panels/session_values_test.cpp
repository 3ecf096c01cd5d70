#include "workbench/gui/panels/session_values.h"

#include <doctest/doctest.h>

#include <random>

using namespace tangent;

TEST_CASE("triangles of a session come back as they were, from text that is short where they stand side by side") {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t n = 0; n < 400; ++n)
      if (random() % 8 < static_cast<unsigned>(round % 9)) numbers.push_back(n);
    const ViewValues values{{"n", text_of_ranges(numbers)}};
    CHECK(SavedValues(values).ranges("n", 400) == numbers);
  }
  CHECK(text_of_ranges({0, 1, 2, 3, 7, 9, 10}) == "0-3,7,9-10");
}

TEST_CASE("a list of triangles that is none, or beyond the mesh, is passed over") {
  const ViewValues values{{"far", "5,4000000000-4294967295"},
                          {"back", "9,3"},
                          {"word", "1,two"},
                          {"open", "1-"},
                          {"down", "7-4"},
                          {"signed", "-3"},
                          {"none", ""}};
  const SavedValues saved(values);
  CHECK(saved.ranges("far", 10) == std::vector<std::uint32_t>{5});
  for (const char* name : {"back", "word", "open", "down", "signed", "none", "missing"}) {
    CAPTURE(name);
    CHECK(saved.ranges(name, 100).empty());
  }
}

TEST_CASE("numbers of a session read back as the same doubles, and only where all of them are there and finite") {
  const std::vector<double> given{0.1, -1e-300, 12345.678901234567};
  const ViewValues values{{"all", text_of_numbers(given)}, {"after", "1 2 by hand"}, {"few", "1"}, {"bad", "1 nan"}};
  const SavedValues saved(values);
  CHECK(saved.numbers("all", 3) == given);
  CHECK(saved.numbers("after", 2) == std::vector<double>{1.0, 2.0});
  CHECK_FALSE(saved.numbers("few", 2));
  CHECK_FALSE(saved.numbers("bad", 2));
  CHECK_FALSE(saved.numbers("missing", 1));
  int mode = 1;
  const ViewValues modes{{"mode", "1e300"}};
  SavedValues(modes).take("mode", mode, 3);
  CHECK(mode == 3);
}
