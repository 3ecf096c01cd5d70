#include "core/io/appended_file.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tangent {
namespace {

constexpr int kOpenAttempts = 16;  // each but the last met a file that its owner removed just then

std::string reason() { return std::strerror(errno); }

// EINVAL: this file system has nothing to sync, so nothing was lost.
bool sync(int file) { return ::fdatasync(file) == 0 || errno == EINVAL; }

bool knows_no_locks(int error) { return error == ENOLCK || error == EOPNOTSUPP || error == ENOSYS; }

/// Whether the path still names the open file: who had it before may have removed it meanwhile.
bool is_at(int file, const std::filesystem::path& path) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(file, &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

}  // namespace

bool write_whole(int file, std::string_view text) noexcept {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

AppendedFile::AppendedFile(AppendedFile&& other) noexcept
    : path_(std::move(other.path_)),
      rules_(std::move(other.rules_)),
      file_(std::exchange(other.file_, -1)),
      bytes_(other.bytes_),
      torn_(other.torn_) {}

AppendedFile::~AppendedFile() {
  if (file_ >= 0) ::close(file_);
}

Result<AppendedFile> AppendedFile::open(const std::filesystem::path& path, AppendRules rules) {
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    return fail("is no file", path.string(), "remove it, or choose another name");
  AppendedFile out;
  out.path_ = path;
  out.rules_ = std::move(rules);
  for (int attempt = 0; attempt < kOpenAttempts; ++attempt) {
    if (out.file_ >= 0) ::close(out.file_);
    out.file_ = ::open(path.c_str(), O_CREAT | O_WRONLY | O_APPEND | O_CLOEXEC | O_NONBLOCK, 0666);
    if (out.file_ < 0)
      return fail("can't be written: " + reason(), path.string(), "choose a folder that may be written");
    if (out.rules_.in_use.empty()) return out.with_what_is_there();
    if (::flock(out.file_, LOCK_EX | LOCK_NB) != 0 && !knows_no_locks(errno)) break;
    if (is_at(out.file_, path)) return out.with_what_is_there();
  }
  return fail("is in use by another program", path.string(), out.rules_.in_use);
}

/// Where a write fails before `keep` what was there stays.
AppendedFile AppendedFile::with_what_is_there() {
  struct stat opened {};
  if (::fstat(file_, &opened) == 0) bytes_ = static_cast<std::uint64_t>(opened.st_size);
  return std::move(*this);
}

Status AppendedFile::keep(std::uint64_t bytes) {
  bytes_ = bytes;
  if (::ftruncate(file_, static_cast<off_t>(bytes)) == 0) return {};
  return fail("its torn end can't be cut off: " + reason(), path_.string(), rules_.not_whole);
}

/// Half a line would stand before the next. Where it can't be cut off now, the next write or start does.
Status AppendedFile::take_back() {
  const std::string why = reason();
  torn_ = ::ftruncate(file_, static_cast<off_t>(bytes_)) != 0;
  return fail("can't be written: " + why, path_.string(), rules_.not_whole);
}

Status AppendedFile::mend() {
  if (!torn_) return {};
  Status kept = keep(bytes_);
  torn_ = !kept;
  return kept;
}

Status AppendedFile::add(std::string_view lines) {
  if (Status ok = mend(); !ok) return ok;
  if (!write_whole(file_, lines)) return take_back();
  bytes_ += lines.size();
  return {};
}

Status AppendedFile::add_durably(std::string_view lines) {
  if (Status ok = mend(); !ok) return ok;
  if (!write_whole(file_, lines) || !sync(file_)) return take_back();
  bytes_ += lines.size();
  return {};
}

Status AppendedFile::flush() {
  if (sync(file_)) return {};
  return fail("can't be written: " + reason(), path_.string(), rules_.not_whole);
}

}  // namespace tangent
