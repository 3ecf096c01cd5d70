#include "devices/usb/packet_recorder.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <string>
#include <utility>

namespace tangent {

namespace {

constexpr const char* kRemedy = "name a file that can be written, where there is room";

}  // namespace

Result<std::unique_ptr<PacketRecorder>> PacketRecorder::create(const std::filesystem::path& file) {
  std::FILE* opened = std::fopen(file.c_str(), "w");
  if (opened == nullptr) return fail(std::strerror(errno), file.string(), kRemedy);
  if (std::fputs("# t_s direction status bytes hex\n", opened) < 0 || std::fflush(opened) != 0) {
    const int code = errno;
    std::fclose(opened);
    return fail(std::strerror(code), file.string(), kRemedy);
  }
  return std::unique_ptr<PacketRecorder>(new PacketRecorder(opened, file));
}

PacketRecorder::PacketRecorder(std::FILE* file, std::filesystem::path path)
    : file_(file), path_(std::move(path)), started_ns_(usb_now_ns()) {
  thread_ = std::thread([this] {
    while (!stopping_.load()) {
      write_all();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    write_all();
  });
}

PacketRecorder::~PacketRecorder() {
  stopping_.store(true);
  thread_.join();
  std::fclose(file_);
}

void PacketRecorder::packet(Direction direction, std::int64_t time_ns, std::span<const std::uint8_t> bytes,
                            int status) noexcept {
  Packet p{.time_ns = time_ns,
           .status = status,
           .direction = direction,
           .length = static_cast<std::uint8_t>(std::min(bytes.size(), kUsbPacketBytes))};
  std::copy_n(bytes.begin(), p.length, p.bytes.begin());
  ring_.push(p);
}

void PacketRecorder::write_all() {
  constexpr const char* kDirections[]{"in", "out", "control"};
  Packet p;
  while (ring_.pop(p)) {
    std::fprintf(file_, "%.6f %s %d %d ", static_cast<double>(p.time_ns - started_ns_) * 1e-9,
                 kDirections[static_cast<int>(p.direction)], p.status, p.length);
    for (std::size_t i = 0; i < p.length; ++i) std::fprintf(file_, "%02x", p.bytes[i]);
    std::fputc('\n', file_);
  }
  if (std::fflush(file_) != 0 && failed_ == 0) failed_ = errno;
}

Status PacketRecorder::complete() const {
  if (const int code = failed_) return fail(std::strerror(code), path_.string(), kRemedy);
  if (const std::uint64_t lost = drops(); lost > 0)
    return fail(std::to_string(lost) + " packets are not in it, the disk was too slow", path_.string(),
                "name a file on another disk");
  return {};
}

}  // namespace tangent
