#include "tests/devices/usb/emulation/usbfs_shim.h"

#include <cerrno>
#include <cstdarg>
#include <map>
#include <mutex>
#include <vector>

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

namespace tangent::emulation {

namespace {

struct Node {
  UsbfsBoard* board = nullptr;
  int open_error = 0;
};

struct Handle {
  UsbfsBoard* board = nullptr;
  int reader = -1, writer = -1;
};

constexpr std::size_t kPipe = 4096;

// Never destroyed: other threads may still close files while the process ends.
std::mutex& guard() {
  static auto* m = new std::mutex;
  return *m;
}
std::map<std::string, Node>& nodes() {
  static auto* m = new std::map<std::string, Node>;
  return *m;
}
std::map<int, Handle>& handles() {
  static auto* m = new std::map<int, Handle>;
  return *m;
}

using CloseCall = int (*)(int);
CloseCall real_close() {
  static const auto call = reinterpret_cast<CloseCall>(dlsym(RTLD_NEXT, "close"));
  return call;
}

void fill(int writer) {
  static const std::vector<char> page(kPipe);
  while (::write(writer, page.data(), page.size()) > 0) {}
}

void drain(int reader) {
  std::vector<char> page(kPipe);
  while (::read(reader, page.data(), page.size()) > 0) {}
}

/// -1 with errno, or the handle; -2: no node of ours.
int open_node(const char* path) {
  const std::scoped_lock lock(guard());
  const auto found = nodes().find(path);
  if (found == nodes().end()) return -2;
  if (found->second.open_error != 0) {
    errno = found->second.open_error;
    return -1;
  }
  UsbfsBoard* board = found->second.board;
  if (board == nullptr) {
    errno = ENODEV;
    return -1;
  }
  int ends[2];
  if (::pipe2(ends, O_NONBLOCK | O_CLOEXEC) != 0) return -1;
  ::fcntl(ends[1], F_SETPIPE_SZ, static_cast<int>(kPipe));
  fill(ends[1]);
  const Handle handle{board, ends[0], ends[1]};
  handles()[ends[1]] = handle;
  board->on_ready = [handle](bool ready) { ready ? drain(handle.reader) : fill(handle.writer); };
  return ends[1];
}

UsbfsBoard* board_of(int fd) {
  const std::scoped_lock lock(guard());
  const auto found = handles().find(fd);
  return found == handles().end() ? nullptr : found->second.board;
}

}  // namespace

void attach_board(const std::string& path, UsbfsBoard& board, int open_error) {
  const std::scoped_lock lock(guard());
  nodes()[path] = {&board, open_error};
}

void detach_board(const std::string& path) {
  const std::scoped_lock lock(guard());
  const auto found = nodes().find(path);
  if (found == nodes().end()) return;
  for (auto& [fd, handle] : handles()) {
    if (handle.board != found->second.board || handle.reader < 0) continue;
    real_close()(handle.reader);
    handle.reader = -1;
  }
  if (found->second.board != nullptr) found->second.board->on_ready = nullptr;
  nodes().erase(found);
}

}  // namespace tangent::emulation

// --- In front of the C library -------------------------------------------------------------------------

namespace {

template <class Call>
Call next(const char* name) {
  return reinterpret_cast<Call>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

__attribute__((visibility("default"))) int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const auto mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(arguments, mode_t) : mode_t{0};
  va_end(arguments);
  const int fd = tangent::emulation::open_node(path);
  if (fd != -2) return fd;
  static const auto real = next<int (*)(const char*, int, ...)>("open");
  return real(path, flags, mode);
}

__attribute__((visibility("default"))) int __open_2(const char* path, int flags) {
  const int fd = tangent::emulation::open_node(path);
  if (fd != -2) return fd;
  static const auto real = next<int (*)(const char*, int)>("__open_2");
  return real(path, flags);
}

__attribute__((visibility("default"))) int ioctl(int fd, unsigned long request, ...) noexcept {
  va_list arguments;
  va_start(arguments, request);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  if (tangent::emulation::UsbfsBoard* board = tangent::emulation::board_of(fd)) {
    const int code = board->ioctl(request, argument);
    if (code >= 0) return code;
    errno = -code;
    return -1;
  }
  static const auto real = next<int (*)(int, unsigned long, ...)>("ioctl");
  return real(fd, request, argument);
}

__attribute__((visibility("default"))) int close(int fd) {
  using namespace tangent::emulation;
  {
    const std::scoped_lock lock(guard());
    const auto found = handles().find(fd);
    if (found != handles().end()) {
      found->second.board->on_ready = nullptr;
      found->second.board->vanish_handle();
      if (found->second.reader >= 0) real_close()(found->second.reader);
      handles().erase(found);
    }
  }
  return real_close()(fd);
}
}
