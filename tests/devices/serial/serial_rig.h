// The other end of a serial line: a pseudo-terminal, the reference firmware, and a mass on a hand's spring. Steps when
// told to; how it lies is chosen. A folder stands for /dev.
#pragma once

#include "devices/serial/firmware/tangent_firmware.h"
#include "devices/serial/serial_messages.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace tangent::serial_test {

/// Waits for another thread; the limit only ends a test that hangs.
template <class Condition>
bool eventually(Condition&& condition, double limit_s = 60.0) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(limit_s);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(20));
  }
  return true;
}

/// An empty folder in place of /dev, removed at the end.
class DevFolder {
 public:
  DevFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "tangent-dev-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path_ = name;
    std::filesystem::create_directories(path_ / "serial/by-id");
  }
  ~DevFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  DevFolder(const DevFolder&) = delete;
  DevFolder& operator=(const DevFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// `id`: the name of its link in serial/by-id; empty: none.
  void attach(const std::string& name, const std::string& id, const std::string& terminal) {
    detach(name, id);
    std::filesystem::create_symlink(terminal, path_ / name);
    if (!id.empty()) std::filesystem::create_symlink("../../" + name, path_ / "serial/by-id" / id);
  }
  void detach(const std::string& name, const std::string& id) {
    std::filesystem::remove(path_ / name);
    if (!id.empty()) std::filesystem::remove(path_ / "serial/by-id" / id);
  }

 private:
  std::filesystem::path path_;
};

enum class Lie {
  none,
  not_measured,
  outside,
  not_unit,
  time_stands,
  time_backwards,
  time_ahead,
  wrong_crc,
  half_frames,
  garbage,
  silence,
  flood,
  deaf,
  reset,
  leap,
  sensor_fails,
};

inline tangent_description three_axes() {
  tangent_description is{};
  is.firmware_version = 0x0102;
  is.serial = 77;
  is.pushes_along = 7;
  is.senses_rotation = 7;
  is.buttons = 2;
  is.peak_mn = 5000;
  is.continuous_mn = 2000;
  is.step_nm = 10000;
  is.mass_g = 100;
  is.stiffness_n_per_m = 2000;
  is.damping_mn_s_per_m = 5000;
  for (std::uint32_t& half : is.workspace_um) half = 50000;
  is.telemetry_hz = 1000;
  is.watchdog_ms = 20;
  is.homing_ms = 1000;
  return is;
}

class SerialRig {
 public:
  explicit SerialRig(const tangent_description& is = three_axes()) : is_(is) { start_firmware(); }
  ~SerialRig() { unplug(); }
  SerialRig(const SerialRig&) = delete;
  SerialRig& operator=(const SerialRig&) = delete;

  Lie lie = Lie::none;
  bool old_display = false;  ///< knows no force messages
  std::uint8_t version = 1;  ///< of the force messages, as it says
  std::uint32_t buttons = 0;
  std::uint64_t bytes_in = 0, bytes_out = 0;  ///< since it was plugged in
  std::array<double, 3> force_n{};            ///< that the motors push with
  std::array<double, 3> position_m{};
  tangent_firmware firmware{};

  void plug_in(DevFolder& dev, const std::string& name = "ttyACM0", const std::string& id = "") {
    master_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    REQUIRE(master_ >= 0);
    REQUIRE(grantpt(master_) == 0);
    REQUIRE(unlockpt(master_) == 0);
    char terminal[128];
    REQUIRE(ptsname_r(master_, terminal, sizeof terminal) == 0);
    // Held open, so that what the host sets there lasts, and what it sends is not lost when it closes.
    slave_ = open(terminal, O_RDWR | O_NOCTTY | O_CLOEXEC);
    REQUIRE(slave_ >= 0);
    bytes_in = bytes_out = 0;
    dev.attach(name, id, terminal);
  }
  void unplug() {
    if (master_ < 0) return;
    close(slave_);
    close(master_);
    master_ = slave_ = -1;
  }
  void start_firmware() {
    const tangent_board board{this, measure, push, home, send};
    tangent_init(&firmware, &board, &is_);
  }

  /// Takes what came from the host so far; whether there was any.
  bool listen() {
    std::array<std::uint8_t, 4096> bytes;
    const ssize_t got = read(master_, bytes.data(), bytes.size());
    if (got <= 0) return false;
    bytes_in += static_cast<std::uint64_t>(got);
    if (old_display)
      answer_as_display();
    else if (lie != Lie::deaf)
      tangent_receive(&firmware, bytes.data(), static_cast<std::size_t>(got));
    return true;
  }
  /// One millisecond of mass and firmware.
  void step() {
    now_us_ += 1000;
    if (lie == Lie::reset) {
      start_firmware();
      now_us_ = 0;
      lie = Lie::none;
    }
    move(1e-3);
    tangent_step(&firmware, now_us_);
  }

 private:
  static SerialRig& self(void* context) { return *static_cast<SerialRig*>(context); }
  static int measure(void* context, tangent_reading* reading) {
    SerialRig& rig = self(context);
    for (std::size_t i = 0; i < 3; ++i)
      reading->position_m[i] = ((rig.is_.pushes_along >> i) & 1) != 0 ? static_cast<float>(rig.position_m[i]) : 0.0f;
    reading->buttons = rig.buttons;
    if (rig.lie == Lie::sensor_fails) reading->position_m[0] = NAN;
    return 1;
  }
  static void push(void* context, const float* force) {
    for (std::size_t i = 0; i < 3; ++i) self(context).force_n[i] = static_cast<double>(force[i]);
  }
  static int home(void*) { return 1; }
  static void send(void* context, const std::uint8_t* bytes, std::size_t count) {
    self(context).send_or_lie(bytes, count);
  }

  void move(double dt) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double pull = 200.0 * (0.0 - position_m[i]) - 10.0 * velocity_[i] + force_n[i];
      velocity_[i] += dt / 0.1 * pull;
      position_m[i] += dt * velocity_[i];
    }
  }

  void answer_as_display() {
    const auto say = [this](const CldFrame& frame) { write_frame(frame); };
    say(to_frame(CldInfo{.firmware_version = 0x0100,
                         .serial = 5,
                         .travel_nm = 20000000,
                         .step_pm = 800000,
                         .bandwidth_centihz = 1200,
                         .telemetry_hz = 1000,
                         .watchdog_ms = 50},
                 display_sequence_++));
    say(to_frame(CldRefused{.type = 0x10, .sequence = 1, .reason = 2}, display_sequence_++));
  }
  void write_all(const std::uint8_t* bytes, std::size_t count) {
    std::size_t done = 0;
    const bool all = eventually([&] {
      const ssize_t taken = write(master_, bytes + done, count - done);
      if (taken > 0) done += static_cast<std::size_t>(taken);
      return done == count;
    });
    REQUIRE(all);
    bytes_out += count;
  }
  void write_frame(const CldFrame& frame) {
    std::array<std::uint8_t, kCldLargestFrame> bytes{};
    write_all(bytes.data(), encode_frame(frame, bytes));
  }

  /// Frames of the firmware go out as they are, or changed.
  void send_or_lie(const std::uint8_t* bytes, std::size_t count) {
    CldFrame frame;
    CldParser parser;
    parser.feed({bytes, count}, [&](const CldFrame& f) { frame = f; });
    if (auto info = to_force_info(frame)) {
      info->version = version;
      return write_frame(to_frame(*info, frame.sequence));
    }
    const auto telemetry = to_force_telemetry(frame);
    if (!telemetry || lie == Lie::none) return write_all(bytes, count);
    std::vector<std::uint8_t> raw(bytes, bytes + count);
    if (lie == Lie::silence) return;
    if (lie == Lie::wrong_crc) raw.back() ^= 1u;
    if (lie == Lie::half_frames) raw.resize(raw.size() / 2);
    if (lie == Lie::garbage)
      for (std::uint8_t& byte : raw) byte = static_cast<std::uint8_t>(random_());
    if (lie == Lie::wrong_crc || lie == Lie::half_frames || lie == Lie::garbage)
      return write_all(raw.data(), raw.size());
    if (lie == Lie::flood) return flood(*telemetry);
    write_frame(to_frame(changed(*telemetry), frame.sequence));
  }
  ForceTelemetry changed(ForceTelemetry t) {
    if (lie == Lie::not_measured) t.position_nm[2] = kNotMeasured;
    if (lie == Lie::outside) t.position_nm[1] = 150'000'000;
    if (lie == Lie::leap) t.position_nm[1] += 30'000'000;
    if (lie == Lie::not_unit) t.orientation = {100, 200, 300, 400};
    if (lie == Lie::time_stands) t.time_us = frozen_us_ != 0 ? frozen_us_ : t.time_us;
    if (lie == Lie::time_stands) frozen_us_ = t.time_us;
    if (lie == Lie::time_backwards) t.time_us = 0u - t.time_us;
    if (lie == Lie::time_ahead) t.time_us += 10'000'000;
    return t;
  }
  void flood(ForceTelemetry t) {
    for (int i = 0; i < 200; ++i) {
      write_frame(to_frame(t, firmware.next_sequence++));
      ++t.time_us;
    }
  }

  tangent_description is_;
  int master_ = -1, slave_ = -1;
  std::uint32_t now_us_ = 1000000, frozen_us_ = 0;
  std::uint16_t display_sequence_ = 0;
  std::array<double, 3> velocity_{};
  std::mt19937 random_{7};
};

}  // namespace tangent::serial_test
