#include "workbench/sweep/line_file.h"

#include "core/base/fnv.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace tangent::sweep {
namespace {

constexpr std::size_t kDigits = 16;

std::string checksum(std::string_view text) { return Fnv().add(text).text(); }

std::string why_not() { return std::strerror(errno); }

bool write_whole(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

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

LineFile::LineFile(LineFile&& other) noexcept
    : path_(std::move(other.path_)),
      remedies_(std::move(other.remedies_)),
      file_(std::exchange(other.file_, -1)),
      bytes_(other.bytes_) {}

LineFile& LineFile::operator=(LineFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(remedies_, other.remedies_);
  std::swap(file_, other.file_);
  std::swap(bytes_, other.bytes_);
  return *this;
}

LineFile::~LineFile() {
  if (file_ >= 0) ::close(file_);
}

Status LineFile::damaged(const std::filesystem::path& path, std::uint64_t number, const LineFileRemedies& remedies) {
  return fail("line " + std::to_string(number) + " is damaged", path.string(), remedies.damaged);
}

/// The bytes of its whole lines.
Result<std::uint64_t> LineFile::look_through(const Take& take) const {
  std::ifstream file(path_, std::ios::binary);
  std::uint64_t bytes = 0;
  std::string line;
  for (std::uint64_t number = 1; std::getline(file, line); ++number) {
    const bool ended = !file.eof();  // no line end: it was being written
    const auto text = ended ? checked_text(line) : std::nullopt;
    if (!text && (number > 1 || begins_as_ours(line)) && (!ended || file.peek() == std::ifstream::traits_type::eof()))
      break;
    const Status ok = text ? take(*text, number) : damaged(path_, number, remedies_);
    if (!ok) return tl::unexpected(ok.error());
    bytes += line.size() + 1;
  }
  return bytes;
}

Result<LineFile> LineFile::open(const std::filesystem::path& path, const Take& take, LineFileRemedies remedies) {
  LineFile out;
  out.path_ = path;
  out.remedies_ = std::move(remedies);
  std::error_code error;
  if (std::filesystem::exists(path, error)) {
    if (!std::filesystem::is_regular_file(path, error))
      return fail("is no file", path.string(), "remove it, or choose another name");
    const Result<std::uint64_t> bytes = out.look_through(take);
    if (!bytes) return tl::unexpected(bytes.error());
    out.bytes_ = *bytes;
  }
  out.file_ = ::open(path.c_str(), O_CREAT | O_WRONLY | O_APPEND | O_CLOEXEC, 0666);
  if (out.file_ < 0)
    return fail("can't be written: " + why_not(), path.string(), "choose a folder that may be written");
  if (::ftruncate(out.file_, static_cast<off_t>(out.bytes_)) != 0)
    return fail("its torn end can't be cut off: " + why_not(), path.string());
  return out;
}

Status LineFile::add(std::string_view text) {
  const std::string line = checksum(text) + " " + std::string(text) + "\n";
  if (write_whole(file_, line)) return bytes_ += line.size(), Status{};
  const std::string why = why_not();
  // Half a line would stand before the next. Where it can't be cut off now, the next start does.
  static_cast<void>(::ftruncate(file_, static_cast<off_t>(bytes_)) == 0);
  return fail("can't be written: " + why, path_.string(), remedies_.not_whole);
}

Status LineFile::flush() {
  if (::fdatasync(file_) == 0 || errno == EINVAL) return {};
  return fail("can't be written: " + why_not(), path_.string(), remedies_.not_whole);
}

}  // namespace tangent::sweep
