#include "devices/falcon/falcon_firmware.h"

#include "devices/base/sha256.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <system_error>

namespace tangent {

namespace {

struct PublishedFirmware {
  std::size_t bytes;
  const char* sha256;
};

/// Digest of firmware/nvent_firmware.bin in the public repository libnifalcon/libnifalcon, computed from its file. That
/// this file is what Novint shipped could not be checked.
constexpr std::array<PublishedFirmware, 1> kPublished{
    {{8492, "1119e39c39fab1f37678ea62dfc715b23dd86ee7f13d78f88f707d9f09b896a1"}}};
constexpr std::uintmax_t kSmallest = 1024, kLargest = 65536;

bool same_digits(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  });
}

}  // namespace

Result<FalconFirmware> read_falcon_firmware(const std::filesystem::path& file, const std::string& confirmed_sha256) {
  std::error_code failed;
  const std::uintmax_t size = std::filesystem::file_size(file, failed);
  if (failed)
    return fail(failed.message(), file.string(), "name the Falcon's firmware file, from its maker's installation");
  if (size < kSmallest || size > kLargest)
    return fail("has " + std::to_string(size) + " bytes, a Falcon's firmware has 1 to 64 KiB", file.string(),
                "name the firmware file alone, not an archive or a program");
  FalconFirmware firmware;
  std::ifstream in(file, std::ios::binary);
  firmware.bytes.assign(std::istreambuf_iterator<char>(in), {});
  if (!in || firmware.bytes.size() != size) return fail("can't be read", file.string(), "check its permissions");
  firmware.sha256 = sha256_text(firmware.bytes);
  firmware.published = std::any_of(kPublished.begin(), kPublished.end(), [&](const PublishedFirmware& known) {
    return known.bytes == firmware.bytes.size() && firmware.sha256 == known.sha256;
  });
  if (firmware.published || same_digits(firmware.sha256, confirmed_sha256)) return firmware;
  return fail(confirmed_sha256.empty() ? "is no firmware that we know: SHA-256 " + firmware.sha256
                                       : "is not the file that was confirmed: SHA-256 " + firmware.sha256,
              file.string(), "if it came with your Falcon, confirm it: --falcon-firmware-sha256 " + firmware.sha256);
}

}  // namespace tangent
