#include "core/io/input_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>

#include <fcntl.h>
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

}  // namespace

Result<std::string> read_input_file(const std::filesystem::path& path, std::size_t max_bytes) {
  constexpr std::size_t kFirst = std::size_t{1} << 16, kLargestRead = std::size_t{1} << 20;
  const InputDescriptor file(path);
  if (!file.open())
    return fail(std::string("can't be opened: ") + std::strerror(errno), path.string(), "check the path");
  std::string text;
  TextCheck check;
  std::size_t size = 0;
  for (;;) {
    if (size == text.size()) text.resize(size == 0 ? kFirst : std::min(2 * size, max_bytes + 1));
    const ssize_t got = file.read(text.data() + size, std::min(text.size() - size, kLargestRead));
    if (got < 0) return fail(std::string("can't be read: ") + std::strerror(errno), path.string(), "check the path");
    if (got == 0) break;
    const std::string_view more(text.data() + size, static_cast<std::size_t>(got));
    if (Status status = check.take(more, path.string()); !status) return tl::unexpected(status.error());
    size += more.size();
    if (size > max_bytes)
      return fail("is larger than " + std::to_string(max_bytes >> 20) + " MiB", path.string(),
                  "check that it is the right file");
  }
  if (size == 0) return fail("the file is empty", path.string(), "check that it was written to its end");
  text.resize(size);
  return text;
}

}  // namespace tangent
