// Heat of a force device's motors: the safety gate's thermal limit, and the memory of it between two sessions with the
// same device. SI units.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>

namespace tangent {

/// Thermal limit of the motors. They heat with the square of the force and dissipate what the continuous force Fc
/// produces, so a store integrates |F|^2 - Fc^2 and is full after kPeakHold_s of peak force. From half full on, the
/// allowed force falls linearly from peak to continuous, so that it never jumps. Plain arithmetic; servo thread.
class ForceBudget {
 public:
  static constexpr double kPeakHold_s = 2.0;  ///< assumed, conservative: makers rarely state it

  /// Largest force allowed now. All in N; continuous 0: not known, only the peak limits.
  double allowed(double peak, double continuous) const noexcept;
  /// `force` (N) was applied for `dt_s`.
  void spend(double force, double peak, double continuous, double dt_s) noexcept;
  double store_n2s() const noexcept { return store_n2s_; }
  void set_store(double store_n2s) noexcept { store_n2s_ = store_n2s; }

 private:
  double store_n2s_ = 0.0;
};

/// Motors stay hot when their device is closed. Kept by the device's name and serial number while the program runs;
/// they cool meanwhile as under no force. Any thread; locks.
class HeatMemory {
 public:
  /// Times: of a monotonic clock, ns.
  void keep(const std::string& device, double store_n2s, std::int64_t now_ns);
  /// The store now; 0 for a device that was not kept.
  double recall(const std::string& device, double continuous_n, std::int64_t now_ns) const;

 private:
  struct Kept {
    double store_n2s = 0.0;
    std::int64_t at_ns = 0;
  };
  mutable std::mutex mutex_;
  std::map<std::string, Kept> kept_;
};

/// The program's own.
HeatMemory& motor_heat();

}  // namespace tangent
