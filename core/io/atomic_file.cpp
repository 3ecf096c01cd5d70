#include "core/io/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <climits>
#include <csignal>
#include <cstring>
#include <utility>

namespace tangent {
namespace {

constexpr std::size_t kBufferBytes = 1 << 18;
constexpr const char* kRemedy = "check that the directory exists, is writable and has room";

tl::unexpected<Error> system_failure(const char* doing, const std::filesystem::path& target) {
  const int code = errno;
  return fail(std::string("cannot ") + doing + ": " + std::strerror(code), target.string(), kRemedy);
}

// --- For a process that ends by a signal ----------------------------------------------------------------

/// The name of one temporary file, in memory that nobody frees: a signal handler may be reading it. `removed` stays:
/// the process ends.
struct KeptName {
  enum class State { empty, filling, held, removed };
  std::atomic<State> state{State::empty};
  std::array<char, PATH_MAX> name{};
};

std::array<KeptName, 64> temporaries;

/// Which of `temporaries` holds the name, to be given back to `forget`; -1 where there is no room.
int remember(const std::filesystem::path& temporary) {
  const std::string& name = temporary.native();
  for (std::size_t i = 0; i < temporaries.size() && name.size() < PATH_MAX; ++i) {
    KeptName& kept = temporaries[i];
    KeptName::State empty = KeptName::State::empty;
    if (!kept.state.compare_exchange_strong(empty, KeptName::State::filling)) continue;
    std::memcpy(kept.name.data(), name.c_str(), name.size() + 1);
    kept.state = KeptName::State::held;
    return static_cast<int>(i);
  }
  return -1;
}

void forget(int which) {
  KeptName::State held = KeptName::State::held;
  if (which >= 0)
    temporaries[static_cast<std::size_t>(which)].state.compare_exchange_strong(held, KeptName::State::empty);
}

// ---------------------------------------------------------------------------------------------------------

/// "F" of ".F.tmp-PID-ATTEMPT" beside it.
std::string name_before_process(const std::filesystem::path& place) {
  std::string name(1, '.');
  name.append(place.filename().string(), 0, 200);
  return name.append(".tmp-");
}

/// Of PID-ATTEMPT; 0: it is none.
pid_t process_of(std::string_view text) {
  pid_t process = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), process);
  const std::string_view rest(read.ptr, static_cast<std::size_t>(text.data() + text.size() - read.ptr));
  const bool whole =
      rest.size() > 1 && rest.front() == '-' && rest.find_first_not_of("0123456789", 1) == std::string_view::npos;
  return read.ec == std::errc{} && process > 0 && whole ? process : 0;
}

/// What processes left that were killed while they wrote the same file. Theirs is a lock that ends with them: on a
/// shared disk a process of another machine may have the number of none here.
void remove_left_behind(const std::filesystem::path& place) {
  const std::string begin = name_before_process(place);
  std::error_code error;
  const std::filesystem::path folder = place.parent_path().empty() ? "." : place.parent_path();
  for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (!name.starts_with(begin)) continue;
    const pid_t process = process_of(std::string_view(name).substr(begin.size()));
    if (process == 0 || ::kill(process, 0) == 0 || errno != ESRCH) continue;
    const int fd = ::open(at->path().c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW);
    if (fd < 0) continue;
    if (::flock(fd, LOCK_EX | LOCK_NB) == 0) ::unlink(at->path().c_str());
    ::close(fd);
  }
}

/// Opens a new file beside `place`. Its name contains the process id and an attempt number, so that leftovers of a
/// crashed run, or a second writer, only cost another attempt. It is remembered before it is there: a signal may come
/// in between.
int open_beside(const std::filesystem::path& place, mode_t mode, std::filesystem::path& temporary, int& known_as) {
  for (int attempt = 0; attempt < 1000; ++attempt) {
    std::string name = name_before_process(place);
    name.append(std::to_string(::getpid())).append(1, '-').append(std::to_string(attempt));
    temporary = place.parent_path() / name;
    known_as = remember(temporary);
    const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (fd >= 0) {
      (void)::flock(fd, LOCK_EX | LOCK_NB);  // where the disk knows none, the process alone says that it is written
      return fd;
    }
    forget(std::exchange(known_as, -1));
    if (errno != EEXIST) return fd;
  }
  return -1;
}

/// Makes a rename durable; ignored where directories can't be synced.
void sync_directory(const std::filesystem::path& directory) {
  const int fd = ::open(directory.empty() ? "." : directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  ::fsync(fd);
  ::close(fd);
}

}  // namespace

Result<AtomicFile> AtomicFile::create(const std::filesystem::path& target) {
  if (target.empty()) return fail("no file name to write to", "", "name a file");
  AtomicFile file;
  file.target_ = target;
  file.place_ = target;
  struct stat info {};
  const bool exists = ::stat(target.c_str(), &info) == 0;
  if (exists && S_ISDIR(info.st_mode)) return fail("is a directory", target.string(), "name a file in it");
  if (exists && ::access(target.c_str(), W_OK) != 0) return system_failure("write", target);

  if (exists && !S_ISREG(info.st_mode)) {
    file.fd_ = ::open(target.c_str(), O_WRONLY | O_CLOEXEC);
    if (file.fd_ < 0) return system_failure("write", target);
    return file;
  }
  std::error_code ignored;  // a link that can't be resolved is replaced itself
  if (std::filesystem::is_symlink(target, ignored)) {
    const std::filesystem::path followed = std::filesystem::weakly_canonical(target, ignored);
    if (!followed.empty()) file.place_ = followed;
  }
  const mode_t mode = exists ? info.st_mode & 07777 : 0666;
  remove_left_behind(file.place_);
  file.fd_ = open_beside(file.place_, mode, file.temporary_, file.known_as_);
  if (file.fd_ < 0) {
    const auto failure = system_failure("create a temporary file beside it", target);
    file.temporary_.clear();
    return failure;
  }
  if (exists) (void)::fchmod(file.fd_, mode);  // restores the old file's mode, which the umask may have reduced
  return file;
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : target_(std::move(other.target_)),
      place_(std::move(other.place_)),
      temporary_(std::move(other.temporary_)),
      known_as_(std::exchange(other.known_as_, -1)),
      buffer_(std::move(other.buffer_)),
      fd_(std::exchange(other.fd_, -1)),
      status_(std::move(other.status_)) {
  other.temporary_.clear();
}

AtomicFile::~AtomicFile() {
  if (fd_ >= 0) ::close(fd_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  forget(known_as_);
}

Status AtomicFile::write(std::string_view bytes) {
  buffer_ += bytes;
  if (buffer_.size() >= kBufferBytes) flush();
  return status_;
}

void AtomicFile::flush() {
  std::string_view left = buffer_;
  while (!left.empty() && status_) {
    const ssize_t written = ::write(fd_, left.data(), left.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      record_failure("write");
    } else {
      left.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  buffer_.clear();
}

Status AtomicFile::commit(bool durable) {
  flush();
  const bool in_place = temporary_.empty();
  // EINVAL, ENOTSUP: this file system has nothing to sync, so nothing was lost.
  if (durable && status_ && !in_place && ::fsync(fd_) != 0 && errno != EINVAL && errno != ENOTSUP) {
    record_failure("sync");
  }
  // close reports late errors of network file systems
  if (::close(std::exchange(fd_, -1)) != 0) record_failure("close");
  if (!status_ || in_place) return status_;
  if (::rename(temporary_.c_str(), place_.c_str()) != 0) {
    record_failure("put the new file in place");
    return status_;
  }
  temporary_.clear();
  forget(std::exchange(known_as_, -1));
  if (durable) sync_directory(place_.parent_path());
  return status_;
}

void AtomicFile::record_failure(const char* doing) {
  if (status_) status_ = system_failure(doing, target_);
}

void remove_temporary_files() noexcept {
  for (KeptName& kept : temporaries) {
    KeptName::State held = KeptName::State::held;
    if (kept.state.compare_exchange_strong(held, KeptName::State::removed)) ::unlink(kept.name.data());
  }
}

Status write_file_atomic(const std::filesystem::path& target, std::string_view content, bool durable) {
  Result<AtomicFile> file = AtomicFile::create(target);
  if (!file) return tl::unexpected<Error>(file.error());
  if (const Status written = file->write(content); !written) return written;
  return file->commit(durable);
}

}  // namespace tangent
