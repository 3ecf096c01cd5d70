#include "workbench/sweep/line_file.h"

#include "core/base/fnv.h"

#include <fstream>
#include <utility>

namespace tangent::sweep {
namespace {

constexpr std::size_t kDigits = 16;

std::string checksum(std::string_view text) { return Fnv().add(text).text(); }

/// No file of another kind is cut off: its only line is not taken for a torn one of these.
bool begins_as_ours(std::string_view line) {
  const std::string_view digits = line.substr(0, kDigits);
  return digits.find_first_not_of("0123456789abcdef") == std::string_view::npos &&
         (line.size() <= kDigits || line[kDigits] == ' ');
}

}  // namespace

std::optional<std::string_view> checked_text(std::string_view line) {
  if (line.size() < kDigits + 2 || line[kDigits] != ' ') return std::nullopt;
  const std::string_view text = line.substr(kDigits + 1);
  return line.substr(0, kDigits) == checksum(text) ? std::optional(text) : std::nullopt;
}

Status LineFile::damaged(const std::filesystem::path& path, std::uint64_t number, const LineFileRules& rules) {
  return fail("line " + std::to_string(number) + " is damaged", path.string(), rules.damaged);
}

namespace {

/// The bytes of its whole lines.
Result<std::uint64_t> look_through(const std::filesystem::path& path, const LineFile::Take& take,
                                   const LineFileRules& rules) {
  std::ifstream file(path, std::ios::binary);
  const bool opened = file.is_open();
  std::uint64_t bytes = 0;
  std::string line;
  for (std::uint64_t number = 1; std::getline(file, line); ++number) {
    const bool ended = !file.eof();  // no line end: it was being written
    const auto text = ended ? checked_text(line) : std::nullopt;
    if (!text && (number > 1 || begins_as_ours(line)) && (!ended || file.peek() == std::ifstream::traits_type::eof()))
      break;
    const Status ok = text ? take(*text, number) : LineFile::damaged(path, number, rules);
    if (!ok) return tl::unexpected(ok.error());
    bytes += line.size() + 1;
  }
  // What could not be read is no torn end: nothing of it may be cut off.
  if (!opened || file.bad())
    return fail("can't be read", path.string(), "see that its disk and its permissions let it");
  return bytes;
}

}  // namespace

Result<LineFile> LineFile::open(const std::filesystem::path& path, const Take& take, const LineFileRules& rules) {
  Result<AppendedFile> file = AppendedFile::open(path, rules.append);
  if (!file) return tl::unexpected(file.error());
  const Result<std::uint64_t> bytes = look_through(path, take, rules);
  if (!bytes) return tl::unexpected(bytes.error());
  if (Status ok = file->keep(*bytes); !ok) return tl::unexpected(ok.error());
  return LineFile(std::move(*file));
}

Status LineFile::add(std::string_view text) { return file_.add(checksum(text) + " " + std::string(text) + "\n"); }

}  // namespace tangent::sweep
