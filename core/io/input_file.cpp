#include "core/io/input_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <string_view>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tangent {
namespace {

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

class InputDescriptor {
 public:
  explicit InputDescriptor(const std::filesystem::path& path) : fd_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
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
  /// As ::read(), but starts again where a signal cuts it off.
  ssize_t read(char* to, std::size_t size) const {
    for (;;) {
      const ssize_t got = ::read(fd_, to, size);
      if (got >= 0 || errno != EINTR) return got;
    }
  }

 private:
  int fd_;
};

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

Result<std::string> read_input_file(const std::filesystem::path& path, std::size_t max_bytes,
                                    std::size_t max_piped_bytes) {
  constexpr std::size_t kFirst = std::size_t{1} << 16, kLargestRead = std::size_t{1} << 20;
  const InputDescriptor file(path);
  if (!file.open())
    return fail(std::string("can't be opened: ") + std::strerror(errno), path.string(), "check the path");
  const std::optional<std::size_t> promised = file.size();
  if (promised > max_bytes) return too_much(path, false, max_bytes, max_piped_bytes);
  const std::size_t most = promised ? max_bytes : std::min(max_bytes, max_piped_bytes);
  std::string text;
  TextCheck check;
  std::size_t size = 0;
  for (;;) {
    if (size == text.size()) text.resize(size == 0 ? kFirst : std::min(2 * size, most + 1));
    const ssize_t got = file.read(text.data() + size, std::min(text.size() - size, kLargestRead));
    if (got < 0) return fail(std::string("can't be read: ") + std::strerror(errno), path.string(), "check the path");
    if (got == 0) break;
    const std::string_view more(text.data() + size, static_cast<std::size_t>(got));
    if (Status status = check.take(more, path.string()); !status) return tl::unexpected(status.error());
    size += more.size();
    if (size > most) return too_much(path, !promised, max_bytes, max_piped_bytes);
  }
  if (size == 0) return fail("the file is empty", path.string(), "check that it was written to its end");
  text.resize(size);
  return text;
}

}  // namespace tangent
