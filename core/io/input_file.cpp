#include "core/io/input_file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <optional>
#include <string_view>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

namespace tangent {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // a signal handler sets it

/// Sees the text as it comes in, so that a file without end fails at what no text has.
class TextCheck {
 public:
  Status take(std::string_view more, const std::string& path) {
    for (std::size_t begin = 0; begin < more.size();) {
      const std::size_t end = std::min(more.find('\n', begin), more.size());
      length_ += end - begin;
      if (more.substr(begin, end - begin).find('\0') != std::string_view::npos)
        return fail("holds a zero byte, so it is not a text", where(path), "check that it is the right file");
      if (length_ > kLongestLine)
        return fail("a line of more than " + std::to_string(kLongestLine) + " characters", where(path),
                    "check that it is the right file");
      if (end < more.size()) {
        ++line_;
        length_ = 0;
      }
      begin = end + 1;
    }
    return {};
  }

 private:
  std::string where(const std::string& path) const { return path + ":" + std::to_string(line_); }

  std::size_t line_ = 1, length_ = 0;
};

/// A file that is read without ever waiting in the system: a pipe's first writer may never come, and a signal would
/// only start the wait again.
class InputDescriptor {
 public:
  InputDescriptor(const std::filesystem::path& path, int wait_for_writer_ms)
      : fd_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)),
        unwritten_(fd_ >= 0 && is_named_pipe()),
        wait_ms_(wait_for_writer_ms) {}
  ~InputDescriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  InputDescriptor(const InputDescriptor&) = delete;
  InputDescriptor& operator=(const InputDescriptor&) = delete;

  bool open() const { return fd_ >= 0; }
  /// Of a regular file; none: a pipe or a device, which doesn't say.
  std::optional<std::size_t> size() const {
    struct stat info {};
    if (::fstat(fd_, &info) != 0 || !S_ISREG(info.st_mode)) return std::nullopt;
    return static_cast<std::size_t>(info.st_size);
  }
  /// As ::read(), but starts again where a signal cuts it off, and waits where there is nothing yet. ETIMEDOUT: for a
  /// writer that didn't come; EINTR: end_waiting_for_input() was called.
  ssize_t read(char* to, std::size_t size) {
    for (;;) {
      const ssize_t got = ::read(fd_, to, size);
      if (got < 0 && errno != EINTR && errno != EAGAIN) return got;
      if (got > 0 || (got == 0 && !unwritten_)) return got;
      if (got < 0 && errno == EAGAIN) unwritten_ = false;  // a writer is there, and silent
      if (has_something()) {
        unwritten_ = false;
      } else if (unwritten_ && wait_ms_ <= 0) {
        errno = ETIMEDOUT;
        return -1;
      }
      if (!interrupted) continue;
      errno = EINTR;
      return -1;
    }
  }

 private:
  /// A pipe in the file system, which may wait for its first writer; one between two programs has had it.
  bool is_named_pipe() const {
    constexpr long kBetweenPrograms = 0x50495045;  // PIPEFS_MAGIC
    struct stat info {};
    struct statfs system {};
    return ::fstat(fd_, &info) == 0 && S_ISFIFO(info.st_mode) && ::fstatfs(fd_, &system) == 0 &&
           system.f_type != kBetweenPrograms;
  }
  /// Bytes, the end after a writer, or an error: looked for a tenth of a second at most, which wait_ms_ is then less
  /// by.
  bool has_something() {
    constexpr int kSlice_ms = 100;
    pollfd wanted{fd_, POLLIN, 0};
    const int found = ::poll(&wanted, 1, std::min(kSlice_ms, std::max(0, unwritten_ ? wait_ms_ : kSlice_ms)));
    if (found == 0) wait_ms_ -= kSlice_ms;
    return found > 0;
  }

  int fd_;
  bool unwritten_;  ///< a named pipe that no writer has been seen at
  int wait_ms_;     ///< for one, still
};

/// Of a read that failed with the system's number `code`.
tl::unexpected<Error> unreadable(const std::filesystem::path& path, int code) {
  if (code == EINTR) return fail("was interrupted before its end", path.string(), "nothing was read");
  if (code == EISDIR) return fail("is a folder", path.string(), "name a file");
  if (code == ETIMEDOUT)
    return fail("is a pipe that no program has opened for writing", path.string(),
                "start the program that writes it, or name a file: what a pipe brought is read once");
  return fail(std::string("can't be read: ") + std::strerror(code), path.string(), "check the path");
}

tl::unexpected<Error> too_much(const std::filesystem::path& path, bool piped, std::size_t max_bytes,
                               std::size_t max_piped_bytes) {
  if (!piped || max_bytes <= max_piped_bytes)
    return fail("is larger than " + std::to_string(max_bytes >> 20) + " MiB", path.string(),
                "check that it is the right file");
  return fail("has brought more than " + std::to_string(max_piped_bytes >> 20) + " MiB and no end", path.string(),
              "check that the program that writes it ends, or write a file of up to " +
                  std::to_string(max_bytes >> 20) + " MiB");
}

}  // namespace

Result<std::string> read_input_file(const std::filesystem::path& path, std::size_t max_bytes, const PipeLimits& piped) {
  constexpr std::size_t kFirst = std::size_t{1} << 16, kLargestRead = std::size_t{1} << 20;
  InputDescriptor file(path, piped.wait_for_writer_ms);
  if (!file.open())
    return fail(std::string("can't be opened: ") + std::strerror(errno), path.string(), "check the path");
  const std::optional<std::size_t> promised = file.size();
  if (promised > max_bytes) return too_much(path, false, max_bytes, piped.max_bytes);
  const std::size_t most = promised ? max_bytes : std::min(max_bytes, piped.max_bytes);
  std::string text;
  TextCheck check;
  std::size_t size = 0;
  for (;;) {
    if (size == text.size()) text.resize(size == 0 ? kFirst : std::min(2 * size, most + 1));
    const ssize_t got = file.read(text.data() + size, std::min(text.size() - size, kLargestRead));
    if (got < 0) return unreadable(path, errno);
    if (got == 0) break;
    const std::string_view more(text.data() + size, static_cast<std::size_t>(got));
    if (Status status = check.take(more, path.string()); !status) return tl::unexpected(status.error());
    size += more.size();
    if (size > most) return too_much(path, !promised, max_bytes, piped.max_bytes);
  }
  if (size == 0) return fail("the file is empty", path.string(), "check that it was written to its end");
  text.resize(size);
  return text;
}

void end_waiting_for_input() noexcept { interrupted = true; }
void allow_waiting_for_input() noexcept { interrupted = false; }

}  // namespace tangent
