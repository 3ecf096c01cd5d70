#include "devices/falcon/falcon_firmware.h"

#include "devices/base/sha256.h"
#include "tests/support/temp_folder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

using namespace tangent;

TEST_CASE("Falcon firmware: a file that nobody knows is refused with its digest, and taken once that was confirmed") {
  const testing::TempFolder folder;
  const std::string file = folder.write("f.bin", std::string(5000, 'f'));
  const auto unknown = read_falcon_firmware(file, "");
  REQUIRE_FALSE(unknown);
  const std::string digest = sha256_text(std::vector<std::uint8_t>(5000, 'f'));
  CHECK(unknown.error().what.find(digest) != std::string::npos);
  CHECK(unknown.error().remedy.find("--falcon-firmware-sha256 " + digest) != std::string::npos);
  std::string upper = digest;
  std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return std::toupper(c); });
  for (const std::string& confirmed : {digest, upper}) {
    const auto firmware = read_falcon_firmware(file, confirmed);
    REQUIRE(firmware);
    CHECK(firmware->bytes == std::vector<std::uint8_t>(5000, 'f'));
    CHECK(firmware->sha256 == digest);
    CHECK_FALSE(firmware->published);
  }
}

TEST_CASE("Falcon firmware: one byte off what was confirmed is another file") {
  const testing::TempFolder folder;
  std::string bytes(8492, '\0');
  const std::string digest = sha256_text(std::vector<std::uint8_t>(8492, 0));
  REQUIRE(read_falcon_firmware(folder.write("a.bin", bytes), digest));
  bytes[8491] = 1;
  const auto other = read_falcon_firmware(folder.write("b.bin", bytes), digest);
  REQUIRE_FALSE(other);
  CHECK(other.error().what.find("is not the file that was confirmed") != std::string::npos);
  CHECK_FALSE(read_falcon_firmware(folder.write("c.bin", bytes), digest.substr(0, 63)));
}

TEST_CASE("Falcon firmware: a missing file, a folder and a file of another size say what is wrong") {
  const testing::TempFolder folder;
  CHECK_FALSE(read_falcon_firmware(folder.file("none.bin"), ""));
  CHECK_FALSE(read_falcon_firmware(folder.path(), ""));
  for (const std::size_t size : {std::size_t{0}, std::size_t{1023}, std::size_t{65537}}) {
    const auto wrong = read_falcon_firmware(folder.write("w.bin", std::string(size, 'x')), "");
    REQUIRE_FALSE(wrong);
    CHECK(wrong.error().what.find("has " + std::to_string(size) + " bytes") != std::string::npos);
  }
}
