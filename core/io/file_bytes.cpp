#include "core/io/file_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <new>

namespace tangent {
namespace {

// A mesh has fewer than 2^32 corners, each taking at most a few tens of bytes in any format; a larger
// file is not a mesh that could be held.
constexpr std::size_t kMaxFileBytes = std::size_t{1} << 36;

struct Descriptor {
  int fd = -1;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

/// Memory takes it (a system without overcommit apart), and then the machine swaps or ends the program.
bool exceeds_memory(std::size_t bytes) {
  const long pages = ::sysconf(_SC_PHYS_PAGES), page_bytes = ::sysconf(_SC_PAGESIZE);
  return pages > 0 && page_bytes > 0 && bytes / static_cast<std::size_t>(page_bytes) >= static_cast<std::size_t>(pages);
}

}  // namespace

// Read rather than mapped: a mapped file that another program truncates while we parse it (an exporter
// saving again) would end the process with SIGBUS.
Result<FileBytes> read_file_bytes(const std::filesystem::path& path) {
  const auto system_error = [&](const char* doing) {
    const int code = errno;
    return fail(std::string("cannot ") + doing + " the mesh file: " + std::strerror(code), path.string(),
                code == ENOENT ? "check the path" : "check the file's permissions and type");
  };
  // O_NONBLOCK: opening a pipe nobody writes to must fail here, not hang.
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  if (file.fd < 0) return system_error("open");
  struct stat info {};
  if (::fstat(file.fd, &info) != 0) return system_error("inspect");
  if (S_ISDIR(info.st_mode)) return fail("is a directory, not a mesh file", path.string(), "name a file in it");
  if (!S_ISREG(info.st_mode)) return fail("is not a regular file", path.string(), "name a mesh file");
  const std::size_t size = static_cast<std::size_t>(info.st_size);
  if (size == 0) return fail("the file is empty", path.string(), "export the mesh again");
  if (size > kMaxFileBytes) return fail("the file is larger than 64 GiB", path.string(), "use a smaller mesh");
  if (exceeds_memory(size))
    return fail("the file is larger than this machine's memory", path.string(), "use a smaller mesh");

  FileBytes bytes;
  try {
    bytes.data = std::make_unique_for_overwrite<char[]>(size + 2);
  } catch (const std::bad_alloc&) {
    return fail("not enough memory for a file of this size", path.string(), "use a smaller mesh");
  }
  while (bytes.size < size) {
    const ssize_t got = ::read(file.fd, bytes.data.get() + bytes.size, size - bytes.size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return system_error("read");
    if (got == 0) break;  // the file shrank meanwhile: parse what was read
    bytes.size += static_cast<std::size_t>(got);
  }
  bytes.data[bytes.size] = '\n';
  bytes.data[bytes.size + 1] = '\0';
  return bytes;
}

}  // namespace tangent
