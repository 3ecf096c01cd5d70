#include "core/base/atomic_file.h"

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

namespace tangent {
namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 18;  // few system calls, little memory

}  // namespace

tl::unexpected<Error> AtomicFile::system_failure(int error) const {
  return fail(std::string("can't be written: ") + std::strerror(error), path_.string(),
              "check folder, permissions and space");
}

Result<AtomicFile> AtomicFile::create(const std::filesystem::path& path) {
  AtomicFile out;
  out.path_ = path;
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) return out.system_failure(EISDIR);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    out.file_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (out.file_ < 0) return out.system_failure(errno);
    return out;
  }
  std::filesystem::path target = path;
  if (std::filesystem::is_symlink(std::filesystem::symlink_status(path, error))) {
    target = std::filesystem::weakly_canonical(path, error);
    if (error) return out.system_failure(error.value());
    out.path_ = target;
  }
  if (!target.has_filename()) return out.system_failure(EISDIR);
  const std::string unique = "." + target.filename().string() + "." + std::to_string(::getpid()) + ".part";
  const std::filesystem::path temporary = target.parent_path() / unique;
  out.file_ = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (out.file_ < 0) return out.system_failure(errno);
  out.temporary_ = temporary;
  return out;
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::exchange(other.temporary_, {})),
      buffer_(std::move(other.buffer_)),
      file_(std::exchange(other.file_, -1)) {}

AtomicFile::~AtomicFile() {
  if (file_ >= 0) ::close(file_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

Status AtomicFile::write(std::string_view text) {
  buffer_ += text;
  if (buffer_.size() < kBufferBytes) return {};
  return flush();
}

Status AtomicFile::flush() {
  std::size_t done = 0;
  while (done < buffer_.size()) {
    const ssize_t got = ::write(file_, buffer_.data() + done, buffer_.size() - done);
    if (got < 0 && errno != EINTR) return system_failure(errno);
    if (got > 0) done += static_cast<std::size_t>(got);
  }
  buffer_.clear();
  return {};
}

Status AtomicFile::commit(bool durable) {
  if (Status status = flush(); !status) return status;
  // A device has nothing to synchronise and may refuse to try.
  if (durable && !temporary_.empty() && ::fsync(file_) != 0) return system_failure(errno);
  const int file = std::exchange(file_, -1);
  if (::close(file) != 0) return system_failure(errno);
  if (temporary_.empty()) return {};
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) return system_failure(errno);
  temporary_.clear();
  return {};
}

Status write_file_atomic(const std::filesystem::path& path, std::string_view contents) {
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return tl::unexpected(file.error());
  if (Status status = file->write(contents); !status) return status;
  return file->commit(true);
}

}  // namespace tangent
