#include "core/io/input_file.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <unistd.h>

namespace tangent {

Result<std::string> read_input_file(const std::filesystem::path& path, std::size_t max_bytes) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return fail(std::string("can't be opened: ") + std::strerror(errno), path.string(), "check the path");
  std::string text;
  std::size_t size = 0;
  int error = 0;
  while (size <= max_bytes) {
    if (size == text.size()) text.resize(size == 0 ? std::size_t{1} << 16 : 2 * size);
    const ssize_t got = ::read(file, text.data() + size, text.size() - size);
    if (got == 0) break;
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) {
      error = errno;
      break;
    }
    size += static_cast<std::size_t>(got);
  }
  ::close(file);
  if (error != 0) return fail(std::string("can't be read: ") + std::strerror(error), path.string(), "check the path");
  if (size == 0) return fail("the file is empty", path.string(), "check that it was written to its end");
  if (size > max_bytes) {
    return fail("is larger than " + std::to_string(max_bytes >> 20) + " MiB", path.string(),
                "check that it is the right file");
  }
  text.resize(size);
  return text;
}

}  // namespace tangent
