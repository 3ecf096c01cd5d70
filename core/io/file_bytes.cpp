#include "core/io/file_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <array>
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

/// Up to `end` from `begin` on, or to the end of the file; -1 where that fails, with errno.
ssize_t read_part(int fd, char* bytes, std::size_t begin, std::size_t end) {
  std::size_t at = begin;
  while (at < end) {
    const ssize_t got = ::pread(fd, bytes + at, end - at, static_cast<off_t>(at));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return -1;
    if (got == 0) break;
    at += static_cast<std::size_t>(got);
  }
  return static_cast<ssize_t>(at - begin);
}

}  // namespace

// Read rather than mapped: a mapped file that another program truncates while we parse it (an exporter
// saving again) would end the process with SIGBUS.
Result<FileBytes> read_file_bytes(const std::filesystem::path& path, const RunBoth& run_both) {
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
  std::array<ssize_t, 2> got{};
  std::array<int, 2> problem{};
  run_halves(run_both, size, [&](std::size_t first, std::size_t last) {
    const std::size_t half = first == 0 ? 0 : 1;
    got[half] = read_part(file.fd, bytes.data.get(), first, last);
    problem[half] = errno;
  });
  for (std::size_t half = 0; half < 2; ++half) {
    errno = problem[half];
    if (got[half] < 0) return system_error("read");
  }
  bytes.size = static_cast<std::size_t>(got[0]);
  if (bytes.size == size / 2) bytes.size += static_cast<std::size_t>(got[1]);  // less: the file shrank meanwhile
  bytes.data[bytes.size] = '\n';
  bytes.data[bytes.size + 1] = '\0';
  return bytes;
}

}  // namespace tangent
