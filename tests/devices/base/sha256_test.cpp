#include "devices/base/sha256.h"

#include <doctest/doctest.h>

#include <string>
#include <string_view>
#include <vector>

using namespace tangent;

namespace {

std::string digest_of(std::string_view text) {
  return sha256_text({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

}  // namespace

TEST_CASE("SHA-256 gives the examples of NIST") {
  CHECK(digest_of("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(digest_of("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(digest_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  CHECK(sha256_text(std::vector<std::uint8_t>(1'000'000, 'a')) ==
        "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_CASE("SHA-256 of every length from 0 to 200, around its blocks of 64, is that of another implementation") {
  std::string all;
  for (std::size_t n = 0; n <= 200; ++n) {
    std::vector<std::uint8_t> bytes(n);
    for (std::size_t i = 0; i < n; ++i) bytes[i] = static_cast<std::uint8_t>(7 * i + n);
    all += sha256_text(bytes);
  }
  CHECK(digest_of(all) == "de444fd33c2915b23d3772a4de9aa249a9206ee2f93688a74e332e160c085f41");  // Python's hashlib
}
