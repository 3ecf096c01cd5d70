#include "devices/serial/serial_port.h"

#include <fcntl.h>
#include <grp.h>
#include <linux/serial.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

namespace tangent {

namespace {

struct Baud {
  int rate;
  speed_t code;
};
constexpr Baud kBauds[] = {{115200, B115200},   {230400, B230400},   {460800, B460800},   {500000, B500000},
                           {921600, B921600},   {1000000, B1000000}, {1500000, B1500000}, {2000000, B2000000},
                           {3000000, B3000000}, {4000000, B4000000}};

/// The group that may open it, "dialout" on Debian.
std::string group_of(const std::string& path) {
  struct stat about {};
  if (stat(path.c_str(), &about) != 0) return "dialout";
  std::array<char, 4096> text{};
  group entry{}, *found = nullptr;
  if (getgrgid_r(about.st_gid, &entry, text.data(), text.size(), &found) != 0 || found == nullptr) return "dialout";
  return found->gr_name;
}

/// No echo, no lines, no signals by characters; no hang-up at the end, which resets boards of the Arduino kind.
int make_raw(int fd, speed_t speed) noexcept {
  termios line{};
  if (tcgetattr(fd, &line) != 0) return errno;
  cfmakeraw(&line);
  line.c_cflag |= CLOCAL | CREAD;
  line.c_cflag &= ~static_cast<tcflag_t>(HUPCL | CRTSCTS);
  line.c_cc[VMIN] = line.c_cc[VTIME] = 0;
  if (cfsetspeed(&line, speed) != 0 || tcsetattr(fd, TCSANOW, &line) != 0) return errno;
  return tcflush(fd, TCIOFLUSH) == 0 ? 0 : errno;
}

/// Converters of FTDI hold what they read for 16 ms otherwise. Where a port does not know this, nothing is lost.
void ask_for_low_latency(int fd) noexcept {
  serial_struct about{};
  if (ioctl(fd, TIOCGSERIAL, &about) != 0) return;
  about.flags |= ASYNC_LOW_LATENCY;
  static_cast<void>(ioctl(fd, TIOCSSERIAL, &about));
}

/// Other programs can't open it from now on (TIOCEXCL, which root ignores), nor lock it (flock).
int lock(int fd) noexcept {
  if (flock(fd, LOCK_EX | LOCK_NB) != 0) return errno == EWOULDBLOCK ? EBUSY : errno;
  return ioctl(fd, TIOCEXCL) == 0 ? 0 : errno;
}

}  // namespace

const std::vector<int>& serial_bauds() {
  static const std::vector<int> rates = [] {
    std::vector<int> all;
    for (const Baud& baud : kBauds) all.push_back(baud.rate);
    return all;
  }();
  return rates;
}

Error serial_error(int error_number, const std::string& path) {
  switch (error_number) {
    case EACCES:
    case EPERM: {
      const std::string group = group_of(path);
      return {"you may not open it: it belongs to the group " + group, path,
              "sudo adduser \"$USER\" " + group + ", then log in again"};
    }
    case EBUSY:
      return {"another program uses it", path,
              "close that program; on a desktop it may be ModemManager (devices/60-tangent-workbench.rules)"};
    case ENOENT:
    case ENODEV:
    case ENXIO:
    case EIO:
      return {"no such serial port", path, "plug the device in, or name its port with --serial-port"};
    case ENOTTY:
      return {"is no serial port", path, "name one, as /dev/ttyACM0, with --serial-port"};
    default:
      return {std::string("can't be opened: ") + std::strerror(error_number), path, "plug it in again"};
  }
}

int SerialPort::open(const char* path, int baud) noexcept {
  close();
  const auto* speed = std::find_if(std::begin(kBauds), std::end(kBauds), [&](const Baud& b) { return b.rate == baud; });
  if (speed == std::end(kBauds)) return EINVAL;
  fd_ = ::open(path, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (fd_ < 0) return errno;
  int error = isatty(fd_) != 0 ? lock(fd_) : ENOTTY;
  locked_ = error == 0;
  if (error == 0) error = make_raw(fd_, speed->code);
  if (error != 0) {
    close();
    return error;
  }
  ask_for_low_latency(fd_);
  return 0;
}

void SerialPort::close() noexcept {
  if (fd_ < 0) return;
  if (std::exchange(locked_, false)) static_cast<void>(ioctl(fd_, TIOCNXCL));
  ::close(fd_);
  fd_ = -1;
}

int SerialPort::read(std::span<std::uint8_t> out) noexcept {
  const ssize_t got = ::read(fd_, out.data(), out.size());
  if (got > 0) return static_cast<int>(got);
  if (got < 0 && errno != EAGAIN && errno != EINTR) return -1;
  pollfd look{fd_, POLLIN, 0};  // nothing to read and an end of file look alike
  return poll(&look, 1, 0) > 0 && (look.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0 ? -1 : 0;
}

int SerialPort::write(std::span<const std::uint8_t> bytes) noexcept {
  const ssize_t taken = ::write(fd_, bytes.data(), bytes.size());
  if (taken >= 0) return static_cast<int>(taken);
  return errno == EAGAIN || errno == EINTR ? 0 : -1;
}

int SerialPort::unsent() const noexcept {
  int bytes = 0;
  return ioctl(fd_, TIOCOUTQ, &bytes) == 0 ? bytes : 0;
}

void SerialPort::drop_unsent() noexcept { static_cast<void>(tcflush(fd_, TCOFLUSH)); }

}  // namespace tangent
