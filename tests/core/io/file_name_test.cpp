#include "core/io/file_name.h"

#include <doctest/doctest.h>

#include <string>

using namespace tangent;

TEST_CASE("what is UTF-8 and what is not") {
  for (const char* good : {"", "spot.obj", "m\xC3\xA9sh", "\xE2\x82\xAC", "\xED\x9F\xBF", "\xEE\x80\x80",
                           "\xF0\x9F\x91\x86", "\xF4\x8F\xBF\xBF"}) {
    CAPTURE(good);
    CHECK(is_utf8(good));
  }
  for (const char* bad : {"m\xE9sh", "\x80", "\xC0\xAF", "\xC1\xBF", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xF0\x8F\xBF\xBF",
                          "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xC3", "\xE2\x82", "\xF0\x9F\x91", "\xFF"}) {
    CAPTURE(bad);
    CHECK_FALSE(is_utf8(bad));
  }
}

TEST_CASE("a file's name as text is UTF-8 and reads back, whatever its bytes") {
  for (const std::string name :
       {"spot.obj", "/a b/m\xC3\xA9sh%41.obj", "", "/work/m\xE9sh 100%.obj", "file:odd.obj", "file:%41", "\xFF\xFE"}) {
    CAPTURE(name);
    const std::string text = file_name_text(name);
    CHECK(is_utf8(text));
    CHECK(file_named(text).native() == name);
  }
  std::string every;
  for (int byte = 1; byte < 256; ++byte) every += static_cast<char>(byte);
  CHECK(file_named(file_name_text(every)).native() == every);
  CHECK(file_name_text("m\xE9sh.obj") == "file:m%E9sh.obj");
  CHECK(file_name_text("m\xC3\xA9sh.obj") == "m\xC3\xA9sh.obj");
}

TEST_CASE("text that no name gives is a name, too") {
  CHECK(file_named("file:100%").native() == "100%");
  CHECK(file_named("file:%4").native() == "%4");
  CHECK(file_named("file:%zz").native() == "%zz");
}
